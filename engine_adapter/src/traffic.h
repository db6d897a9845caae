#pragma once

#include <ode/ode.h>

#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

namespace bumper {

struct Vehicle;

/// What Traffic knows of one vehicle.
struct Traveller {
  Vehicle* vehicle = nullptr;
  // What ODE keeps of the chassis. These addresses do not change while the body lives.
  const dReal* position = nullptr;
  const dReal* velocity = nullptr;
  double radius = 0.0;  ///< of a circle around the chassis' position that holds the outline, m

  double x = 0.0, y = 0.0;    ///< where it was last looked at, m
  double looked = 0.0;        ///< … and when, s
  double speedLimit = 0.0;    ///< that it keeps until it is looked at again, m/s
  double apartUntil = 0.0;    ///< so long no other vehicle can reach it, s
  double companySpeed = 0.0;  ///< the limit of the fastest that may set it moving in this step
  long cellX = 0, cellY = 0;
  bool isListed = false;
  bool isQueued = false;
  Traveller* next = nullptr;  ///< in the same bucket
  Traveller** link = nullptr;
};

/// Which vehicles may meet in a step. Each keeps a speed limit; two whose gap both cannot close by
/// then need not be looked at until a time. One that breaks its limit, or was moved, is looked at
/// again, and with it the times of those around it. A grid of the plane lists who is around.
class Traffic {
 public:
  void add(Traveller& traveller);
  static void remove(Traveller& traveller);

  /// Whether it certainly meets no other in the coming step of `h` seconds. `now` is the time, s.
  [[nodiscard]] static bool isApart(const Traveller& traveller, double now, double h);

  /// Looks at those that may not be apart, and at those around them that they may set moving:
  /// finds all pairs that may meet in the step, in an order of no meaning, each once.
  void look(std::span<Traveller* const> some, double now, double h);
  using Pair = std::pair<Traveller*, Traveller*>;
  [[nodiscard]] std::span<const Pair> pairs() const { return pairs_; }

 private:
  [[nodiscard]] Traveller*& bucketOf(long x, long y);
  void place(Traveller& traveller);
  void refresh(Traveller& traveller, double now);
  void meet(Traveller& one, Traveller& other, double now, double h);
  void enqueue(Traveller& traveller);

  static constexpr std::size_t bucketCount = 4096;

  std::vector<Traveller*> buckets_;  // the first of each; none before there are vehicles
  double cell_ = 32.0;               // m
  std::vector<Traveller*> queue_;
  std::vector<Pair> pairs_;
};

inline bool Traffic::isApart(const Traveller& traveller, double now, double h) {
  if (!(now + h <= traveller.apartUntil)) return false;
  const double x = traveller.position[0] - traveller.x;
  const double y = traveller.position[1] - traveller.y;
  const double speed2 =
      traveller.velocity[0] * traveller.velocity[0] + traveller.velocity[1] * traveller.velocity[1];
  const double limit = traveller.speedLimit;
  const double way = limit * (now - traveller.looked);
  return speed2 <= limit * limit && x * x + y * y <= way * way + 1e-6;
}

}  // namespace bumper
