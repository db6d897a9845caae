// A car that is no ODE body: Bumper's response alone, in an engine of one's own with steps of any
// size. Both of the paper's ways give the same motion.
//
//   any_engine

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "own_car.h"

namespace {

using namespace bumper;
using namespace bumper::examples;

// Frames that take as long as they take: 4 to 20 ms, s.
double stepOf(int frame) { return 0.012 + 0.008 * std::sin(2.4 * frame); }

}  // namespace

int main() {
  const VehicleParameters car{.mass = 1500.0,
                              .yawInertia = 2600.0,
                              .massCentreToFront = 2.1,
                              .massCentreToRear = 2.5,
                              .width = 1.8,
                              .massCentreHeight = 0.55};
  const ResponseSettings settings;  // the paper's
  std::vector<WallSegment> walls(2);
  walls[0].start = {0.0, 0.0};
  walls[0].end = {40.0, 0.0};
  walls[0].normal = {0.0, 1.0};
  walls[1].start = {40.0, 0.0};
  walls[1].end = {40.0, 30.0};
  walls[1].normal = {-1.0, 0.0};
  for (WallSegment& wall : walls) wall.settings = &settings;

  const double angle = 20.0 * std::numbers::pi / 180.0;
  const PlanarMotion start{.position = {5.0, 9.0},
                           .yaw = -angle,
                           .velocity = 26.8224 * Vector2(std::cos(angle), -std::sin(angle)),
                           .yawRate = 0.0};
  OwnCar byForce(car, start);
  OwnCar byReset(car, start);
  std::puts("  time s      x m      y m   yaw °   speed m/s   yaw rate °/s");
  double time = 0.0;
  double most = 0.0;
  for (int frame = 0; time < 3.0; ++frame) {
    const double h = stepOf(frame);
    byForce.stepByForce(walls, h);
    byReset.stepByReset(walls, h);
    time += h;
    const PlanarMotion a = byForce.motion();
    const PlanarMotion b = byReset.motion();
    most = std::max({most, (a.position - b.position).norm(), (a.velocity - b.velocity).norm(),
                     std::abs(a.yaw - b.yaw), std::abs(a.yawRate - b.yawRate)});
    if (frame % 25 != 0) continue;
    constexpr double degree = std::numbers::pi / 180.0;
    std::printf("%8.3f %8.3f %8.3f %7.1f %11.3f %14.2f\n", time, a.position.x(), a.position.y(),
                a.yaw / degree, a.velocity.norm(), a.yawRate / degree);
  }
  std::printf("force over the impact's time against state reset: they differ by %.1e at most\n",
              most);
}
