#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "bumper/response/contact_point.h"

namespace bumper {

/// A point in which outline and wall may meet within a step: what an engine's own solver has to
/// know so that nothing pushes the vehicle through. In the frame of the motion that it was found
/// for.
struct SpeculativeContact {
  int wall = -1;                               ///< WallSegment::id
  const ResponseSettings* settings = nullptr;  ///< the wall's; not owned
  Vector2 normal = Vector2::Zero();            ///< unit, out of the wall into the vehicle
  /// Mass centre to the point of the outline, m, as the vehicle stands at the step's end.
  Vector2 arm = Vector2::Zero();
  double gap = 0.0;  ///< between them at the step's end, along the normal, m; negative: so deep
  /// The least speed that the point must have along the normal, m/s: so that it does not pass the
  /// wall, or is no deeper than it would be if nothing else pushed, by more than a micrometre.
  double leastSpeed = 0.0;
};

/// The nearest of these, by gap; holds a few, and no more than `most`.
class SpeculativeContacts {
 public:
  static constexpr std::size_t most = 8;

  void clear() { count_ = 0; }
  void add(const SpeculativeContact& contact);
  [[nodiscard]] std::span<const SpeculativeContact> all() const {
    return {contacts_.data(), count_};
  }

 private:
  std::array<SpeculativeContact, most> contacts_{};
  std::size_t count_ = 0;
};

/// Adds the points in which an outline may meet one wall: its corners and the wall's face, the
/// wall's ends or post and its sides. `start` is the vehicle's motion at the step's start, `end`
/// that at its end if nothing but this wall and others like it acts: what pushes besides is the
/// engine's to say. `touch` is what findTouch() says at the start, or null; `distance`, m, is the
/// largest gap of interest.
///
/// Demands are linear about the pose at the end. So they are without effect on a vehicle that
/// nothing pushes, at whatever speed and yaw rate; and turning further lifts a corner off the wall.
void addSpeculativeContacts(const Outline& outline, const PlanarMotion& start,
                            const PlanarMotion& end, const WallSegment& wall, const Overlap* touch,
                            double distance, double step, SpeculativeContacts& contacts);

}  // namespace bumper
