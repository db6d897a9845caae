#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "bumper/response/contact_point.h"

namespace bumper {

/// A point of the outline that may come to a wall within a step, or is in it: what an engine's own
/// solver has to know so that nothing pushes the vehicle through. In the frame of the motion that
/// it was found for.
struct SpeculativeContact {
  int wall = -1;                               ///< WallSegment::id
  const ResponseSettings* settings = nullptr;  ///< the wall's; not owned
  Vector2 normal = Vector2::Zero();            ///< unit, out of the wall into the vehicle
  Vector2 arm = Vector2::Zero();               ///< mass centre to the outline's point, m
  double gap = 0.0;                            ///< m along the normal; negative: so deep inside
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

/// Adds the points in which an outline that moves as `motion` says may meet one wall: its corners
/// and the wall's face, the wall's ends or post and its sides. `touch` is what findTouch() says, or
/// null; `distance`, m, is the largest gap of interest. A point that the motion leads past the
/// wall's end, or the end past the outline, within `step` seconds is left out: nothing is there.
void addSpeculativeContacts(const Outline& outline, const PlanarMotion& motion,
                            const WallSegment& wall, const Overlap* touch, double distance,
                            double step, SpeculativeContacts& contacts);

/// The least speed along its normal that a contact's point must have in a step of `step` seconds,
/// m/s: negative, so fast it may come nearer. `yawRate` bends a corner's way by up to half its
/// square times the arm times the step's: that much, and a micrometre, is allowed beyond the wall.
/// What is deeper than that is moved out as penetrations are.
double leastNormalSpeed(const SpeculativeContact& contact, double yawRate, double step);

}  // namespace bumper
