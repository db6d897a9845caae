// Neighbouring hits of two vehicles have neighbouring results.

#include <gtest/gtest.h>

#include <cstdio>

#include "bumper/response/outline.h"
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

}  // namespace
}  // namespace bumper::tests
