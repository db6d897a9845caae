// Neighbouring hits of two vehicles have neighbouring results.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <optional>

#include "bumper/response/outline.h"
#include "bumper/response/pair.h"
#include "car.h"
#include "pair_scan.h"

namespace bumper::tests {
namespace {

// Without yaw rates the first impact is all that the rule decides.
TEST(PairContinuity, FirstImpactOfVehiclesThatDoNotTurn) {
  ScanResult all;
  for (const VehicleParameters& first : {car, motorcycle, lorry}) {
    for (const VehicleParameters& second : {car, motorcycle, lorry}) {
      for (const double speed : {5.0, 15.0, 30.0}) {
        for (const double yaw : {0.0, 35.0}) {
          Meeting meeting{
              .first = first, .second = second, .speed = speed, .firstYaw = yaw, .whole = false};
          const double room = Outline(first).radius() + Outline(second).radius();
          for (const double offset : {0.0, 0.3, 0.6, -0.5}) {
            meeting.offset = offset * room;
            all += scan(meeting, &Meeting::heading, 0.0, 360.0, 0.5);
          }
          for (const double heading : {0.0, 63.0, 170.0}) {
            meeting.heading = heading;
            all += scan(meeting, &Meeting::offset, -room, room, 0.01);
          }
        }
      }
    }
  }
  EXPECT_EQ(all.jumps, 0) << all.worst << " at " << all.where;
  std::printf("[ figures  ] %d neighbours\n", all.cells);
}

// Corners that turn sweep past each other: up to the offset at which they miss, the overlap becomes
// a sliver while they still close at metres a second. Its impulse has to fade with it.
TEST(PairContinuity, TheEdgeBetweenHitAndMissOfCornersThatTurn) {
  const auto changeAt = [](double offset, double heading) {
    constexpr double degree = 0.017453292519943295;
    const PairState first{.vehicle = car, .motion = {.yawRate = 6.0}};
    const PairState second{.vehicle = car,
                           .motion = {.position = {8.0, offset},
                                      .yaw = heading * degree,
                                      .velocity = {-30.0, 0.0},
                                      .yawRate = 6.0}};
    const std::optional<PairHit> hit = respondPair(first, second, {}, 1.0);
    return hit ? hit->response.after.yawRate - hit->response.before.yawRate : 0.0;
  };
  int edges = 0;
  for (double heading = 0.0; heading < 360.0; heading += 2.0) {
    for (double offset = 4.4; offset < 4.8; offset += 0.02) {
      double hits = offset;
      double misses = offset + 0.02;
      if (changeAt(hits, heading) == 0.0 || changeAt(misses, heading) != 0.0) continue;
      while (misses - hits > 1e-12) {
        const double middle = 0.5 * (hits + misses);
        (changeAt(middle, heading) != 0.0 ? hits : misses) = middle;
      }
      ++edges;
      // 1 °/s
      EXPECT_LE(std::abs(changeAt(hits, heading)), 0.0175) << heading << "°, " << offset << " m";
    }
  }
  EXPECT_GT(edges, 30);
}

}  // namespace
}  // namespace bumper::tests
