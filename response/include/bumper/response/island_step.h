#pragma once

#include <memory>
#include <span>

#include "bumper/base/api.h"
#include "bumper/response/collision_step.h"

namespace BUMPER_API bumper {

class Island;

/// A vehicle of an island, in a frame of its own: its walls are those of CollisionStep.
struct IslandMember {
  VehicleParameters vehicle;
  PlanarMotion motion;
  CollisionStep::Walls walls;
};

/// Where a member's frame lies in the plane of a pair.
struct PairFrame {
  Vector2 origin = Vector2::Zero();  ///< m
  double yaw = 0.0;                  ///< of its x axis, rad

  /// A motion in the member's frame as one in the plane.
  [[nodiscard]] PlanarMotion inPlane(const PlanarMotion& motion) const;
  /// A direction of the plane in the member's frame.
  [[nodiscard]] Vector2 turnedBack(const Vector2& v) const {
    return Placement(Vector2::Zero(), yaw).turnedBack(v);
  }
  /// An impulse that acts on the member at `arm`, both in the plane, in the member's frame.
  [[nodiscard]] PlanarImpulse onMember(const Vector2& linear, const Vector2& arm) const {
    return {.linear = turnedBack(linear), .angular = cross(arm, linear)};
  }
};

/// Two members that may touch each other.
struct IslandPair {
  int first = 0;  ///< their numbers among the members
  int second = 0;
  PairFrame firstFrame;
  PairFrame secondFrame;
  const ResponseSettings* settings = nullptr;  ///< not owned, never null
};

/// An impact of two members, in the plane of the pair, where the first one's position is that at
/// its time. The second takes the opposite impulse.
struct PairImpact : StepImpact {
  int pair = 0;  ///< its number among the pairs
};

/// One step of vehicles that may hit each other, and of the walls near each of them: all impacts in
/// the order of their times. Independent of any engine.
///
/// At each time of impact, walls and pairs that approach are answered by their laws, the fastest
/// pair first, until nothing approaches; where that takes too many, all contacts of the vehicles
/// that touch are solved together: the nearest motion, in the measure of kinetic energy, that
/// approaches nowhere. The result does not depend on anything but the order of the members and
/// pairs; give them in one that does not depend on who asks. Holds only scratch memory.
class IslandStep {
 public:
  IslandStep();
  ~IslandStep();
  IslandStep(const IslandStep&) = delete;
  IslandStep& operator=(const IslandStep&) = delete;
  IslandStep(IslandStep&& other) noexcept;
  IslandStep& operator=(IslandStep&& other) noexcept;

  /// `motion` and `h` as for CollisionStep::resolve(). Walls and settings must be of
  /// Method::bumper. Pairs that overlap are eased apart, no faster than
  /// CollisionStep::maxRecoverySpeed.
  void resolve(std::span<const IslandMember> members, std::span<const IslandPair> pairs, double h);

  /// Of resolve(), valid until the next call: the effect on one member, whose `impacts` are those
  /// with walls, and whose `impulse` is that of all; and the impacts between members.
  [[nodiscard]] StepOutcome outcome(std::size_t member) const;
  [[nodiscard]] std::span<const PairImpact> pairImpacts() const;

  /// As CollisionStep::speculativeContacts(), for one member and its walls.
  std::span<const SpeculativeContact> speculativeContacts(std::size_t member,
                                                          const PlanarMotion& motion,
                                                          const PlanarMotion& after,
                                                          double distance, double h);

 private:
  std::unique_ptr<Island> island_;
};

}  // namespace bumper
