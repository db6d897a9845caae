// True jumps of whole encounters of two vehicles, stepped by 5 ms to their end: scans over the
// second one's heading by 0.5° and its offset by 1 cm, with and without yaw rates before. A jump is
// what stays of the difference of neighbours down to 1e-9 of a degree or metre, in °/s or in
// thousandths of the speed. As a Markdown table:
//
//     pair_jumps [COARSER]
//
// COARSER widens the scans' steps, 4 by default; 1 takes an hour.

#include <array>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "bumper/response/outline.h"
#include "car.h"
#include "pair_scan.h"

int main(int argc, char** argv) {
  using namespace bumper;
  using namespace bumper::tests;
  const double coarser = argc > 1 ? std::atof(argv[1]) : 4.0;
  const std::array<std::pair<const char*, VehicleParameters>, 3> kinds{
      {{"car", car}, {"motorcycle", motorcycle}, {"lorry", lorry}}};
  const std::array<std::pair<double, double>, 4> yawRates{
      {{0.0, 0.0}, {2.0, -3.0}, {6.0, 6.0}, {-6.0, 4.0}}};
  std::printf("| first | second | m/s | yaw rates, rad/s | neighbours | jumps | worst |\n");
  std::printf("|---|---|---|---|---|---|---|\n");
  for (const auto& [firstName, first] : kinds) {
    for (const auto& [secondName, second] : kinds) {
      for (const double speed : {30.0, 15.0, 5.0}) {
        for (const auto& [firstRate, secondRate] : yawRates) {
          Meeting meeting{.first = first,
                          .second = second,
                          .speed = speed,
                          .firstYawRate = firstRate,
                          .secondYawRate = secondRate};
          const double room = Outline(first).halfWidth + Outline(second).radius();
          ScanResult all;
          for (const double offset : {0.0, 0.37, 0.8}) {
            meeting.offset = offset * room;
            all += scan(meeting, &Meeting::heading, 0.0, 360.0, 0.5 * coarser);
          }
          for (const double heading : {0.0, 63.0, 170.0}) {
            meeting.heading = heading;
            all += scan(meeting, &Meeting::offset, -room, room, 0.01 * coarser);
          }
          std::printf("| %s | %s | %g | %g, %g | %d | %d | %.3g: %s |\n", firstName, secondName,
                      speed, firstRate, secondRate, all.cells, all.jumps, all.worst,
                      all.where.c_str());
          std::fflush(stdout);
        }
      }
    }
  }
}
