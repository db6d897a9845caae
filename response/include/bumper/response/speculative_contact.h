#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "bumper/base/api.h"
#include "bumper/response/contact_point.h"

namespace BUMPER_API bumper {

/// A point where outline and wall may meet within a step: a constraint for an engine's own solver,
/// so that no load pushes the vehicle through. In the frame of the motion that it was found for.
struct SpeculativeContact {
  int wall = -1;                     ///< Segment::id
  int surface = 0;                   ///< Segment::surface
  Vector2 normal = Vector2::Zero();  ///< unit, out of the wall into the vehicle
  /// Mass centre to the point of the outline, m, as the vehicle stands at the step's end.
  Vector2 arm = Vector2::Zero();
  Vector2 velocity = Vector2::Zero();  ///< of the point in this step without other loads, m/s
  double gap = 0.0;  ///< between them at the step's end, along the normal, m; negative: penetration
  double room = 0.0;  ///< by how much the gap may still decrease, m, > 0

  /// The minimum speed that the point must have along the normal in the step, m/s.
  [[nodiscard]] double leastSpeed(double step) const { return normal.dot(velocity) - room / step; }
};

/// The points where an outline may meet walls: its corners on wall faces, wall ends and posts on
/// its sides. The two nearest are kept for each corner and each third of a side, so that all parts
/// of the outline are covered, however many pieces a wall has.
///
/// The constraint is linearized about the pose at the step's end. So it has no effect on a vehicle
/// without other loads, at any speed and yaw rate; and turning further lifts a corner off the wall.
class SpeculativeContacts {
 public:
  /// The number kept for each corner, each third of a side, and for contacts at wall ends.
  static constexpr std::size_t perPlace = 2;
  static constexpr std::size_t most = perPlace * (4 + 4 * 3 + 1);

  /// For a step of `step` seconds. `start` is the vehicle's motion at its start, `end` that at its
  /// end if nothing but walls acts. `distance`, m, is the largest gap of interest.
  void begin(const Outline& outline, const PlanarMotion& start, const PlanarMotion& end,
             double distance, double step);
  /// `wall` is where it is at the end, and so is `touch`, the result of findTouch() at the start,
  /// or null. `depth` is the penetration allowed, m.
  void addWall(const Segment& wall, const Overlap* touch, double depth);
  [[nodiscard]] std::span<const SpeculativeContact> all() const {
    return {contacts_.data(), count_};
  }

 private:
  void add(std::size_t place, SpeculativeContact contact, double depth);
  void addEnd(const Segment& wall, const Vector2& wallEnd, double depth);

  Outline outline_{VehicleParameters{}};
  Placement from_;
  Placement to_;
  PlanarMotion carrying_;  // from one to the other, as an engine does
  double distance_ = 0.0;
  std::array<SpeculativeContact, most> contacts_{};
  std::array<std::size_t, most> places_{};
  std::size_t count_ = 0;
};

/// A point where two outlines may meet within a step, in the plane of the pair.
struct SpeculativePairContact {
  Vector2 normal = Vector2::Zero();    ///< unit, out of the second into the first
  Vector2 arm = Vector2::Zero();       ///< from the first's mass centre at the step's end, m
  Vector2 otherArm = Vector2::Zero();  ///< from the second's to that place at the step's start, m
  Vector2 velocity = Vector2::Zero();  ///< of the first relative to the second, m/s
  double gap = 0.0;                    ///< as above
  double room = 0.0;
};

/// An outline in a step: its motion at the start, and at the end without other loads.
struct OutlineInStep {
  Outline outline;
  PlanarMotion start;
  PlanarMotion end;
};

/// One or two such points, along the side that separates the outlines best at the step's end; none
/// if they are further apart than `distance`, m. `depth` is the overlap allowed, m.
struct SpeculativePairContacts {
  std::array<SpeculativePairContact, 2> contacts{};
  std::size_t count = 0;

  [[nodiscard]] std::span<const SpeculativePairContact> all() const {
    return {contacts.data(), count};
  }
};
SpeculativePairContacts speculativePairContacts(const OutlineInStep& first,
                                                const OutlineInStep& second, double distance,
                                                double depth, double step);

}  // namespace bumper
