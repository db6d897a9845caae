#pragma once

#include <ode/ode.h>

#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "bumper/response/outline.h"

namespace bumper {

struct Vehicle;

/// What Traffic knows of one vehicle.
struct Traveller {
  Vehicle* vehicle = nullptr;
  // The chassis' BodyNumbers.
  const dReal* position = nullptr;
  const dReal* rotation = nullptr;
  const dReal* velocity = nullptr;
  const dReal* turning = nullptr;
  const dReal* force = nullptr;
  double forceAllowed = 0.0;  ///< on the chassis, N
  Outline outline{VehicleParameters{}};
  Vector2 massCentre = Vector2::Zero();  ///< from the chassis' position, in its axes, m
  double radius = 0.0;  ///< of a circle around that position that holds the outline, m

  double x = 0.0, y = 0.0;                  ///< where it was last looked at, m
  double looked = 0.0;                      ///< … and when, s
  double velocityX = 0.0, velocityY = 0.0;  ///< … and how fast it was, m/s,
  double yawRate = 0.0;                     ///< rad/s
  double allowance = 0.0;     ///< by how much its velocity may change until the next look, m/s
  double apartUntil = 0.0;    ///< so long no other vehicle can reach it, s
  double companySpeed = 0.0;  ///< of the fastest that may set it moving in this step, m/s
  long cellX = 0, cellY = 0;
  bool isListed = false;
  bool isQueued = false;
  Traveller* next = nullptr;  ///< in the same bucket
  Traveller** link = nullptr;

  /// It has to be looked at anew.
  void forget() { apartUntil = 0.0; }
};

/// Which vehicles may meet in a step. Each keeps its velocity within an allowance; two whose gap
/// cannot close so need not be looked at for a time. One that changes its velocity more, or was
/// moved, is looked at again, and with it the times of those around it. A grid of the plane lists
/// who is around.
class Traffic {
 public:
  void add(Traveller& traveller);
  void remove(Traveller& traveller);

  /// Whether it certainly meets no other in the coming step of `h` seconds. `now` is the time, s.
  [[nodiscard]] static bool isApart(const Traveller& traveller, double now, double h);

  /// Looks at those that may not be apart, and at those around them that they may set moving:
  /// finds all pairs that may meet in the step, in an order of no meaning, each once.
  void look(std::span<Traveller* const> some, double now, double h);
  using Pair = std::pair<Traveller*, Traveller*>;
  [[nodiscard]] std::span<const Pair> pairs() const { return pairs_; }

  /// By forces on the chassis that are known before a step, m/s². More may close a gap in one step.
  static constexpr double accelerationAllowed = 200.0;

 private:
  [[nodiscard]] Traveller*& bucketOf(long x, long y);
  static void unlist(Traveller& traveller);
  void place(Traveller& traveller);
  void refresh(Traveller& traveller, double now, double h);
  void meet(Traveller& one, Traveller& other, double now, double h);
  void enqueue(Traveller& traveller);

  static constexpr std::size_t bucketCount = 4096;
  // By how much a yaw rate may change until the next look, rad/s.
  static constexpr double turningAllowance = 0.5;

  std::vector<Traveller*> buckets_;  // the first of each; none before there are vehicles
  double cell_ = 32.0;               // m
  std::vector<Traveller*> queue_;
  std::vector<Pair> pairs_;
};

inline bool Traffic::isApart(const Traveller& traveller, double now, double h) {
  if (!(now + h <= traveller.apartUntil)) return false;
  const double x = traveller.position[0] - traveller.x;
  const double y = traveller.position[1] - traveller.y;
  const double age = now - traveller.looked;
  const double wayX = x - age * traveller.velocityX;
  const double wayY = y - age * traveller.velocityY;
  const double changeX = traveller.velocity[0] - traveller.velocityX;
  const double changeY = traveller.velocity[1] - traveller.velocityY;
  const double allowed = traveller.allowance;
  return changeX * changeX + changeY * changeY <= allowed * allowed &&
         wayX * wayX + wayY * wayY <= allowed * allowed * age * age + 1e-6 &&
         traveller.force[0] * traveller.force[0] + traveller.force[1] * traveller.force[1] <=
             traveller.forceAllowed * traveller.forceAllowed &&
         std::abs(traveller.turning[2] - traveller.yawRate) <= turningAllowance;
}

}  // namespace bumper
