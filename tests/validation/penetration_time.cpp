// The evidence for the default penetration time, as a Markdown table:
//
//     penetration_time
//
// Smoothness: the steepest change of yaw rate over 0.1° of heading, 60 mph, one flat wall. The test
// rail: the speed that the hit on the end wall leaves, by both laws; the paper says that it
// effectively stops the car. Small overlap: six published tests, with the contact point taken from
// the outline (25 % overlap, front bumper) instead of from the reconstruction.

#include <ode/ode.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "bumper/response/collision_step.h"
#include "bumper/scenes/paper_scenes.h"
#include "test_rail_run.h"

namespace {

using namespace bumper;

constexpr double degree = std::numbers::pi / 180.0;
constexpr double sixtyMph = 26.8224;  // m/s

double yawRateAfter(double heading, double penetrationTime) {
  const VehicleParameters car{.mass = 1500.0,
                              .yawInertia = 2600.0,
                              .massCentreToFront = 2.1,
                              .massCentreToRear = 2.5,
                              .width = 1.8,
                              .massCentreHeight = 0.55};
  ResponseSettings settings;
  settings.penetrationTime = penetrationTime;
  PlanarMotion motion;
  motion.velocity = {sixtyMph, 0.0};
  // The wall just touches the outline.
  const Vector2 normal(-std::sin(heading), -std::cos(heading));
  double deepest = 1e9;
  for (const Vector2& corner : Outline(car).corners()) {
    deepest = std::min(deepest, corner.dot(normal));
  }
  const Vector2 foot = (deepest + 1e-7) * normal;
  const Vector2 along = turnedLeft(normal);
  const Segment wall{
      .start = foot - 50.0 * along, .end = foot + 50.0 * along, .normal = normal, .id = 0};
  CollisionStep step;
  const Surface surface{.settings = &settings};
  return step.resolve(car, motion, {{&wall, 1}, {&surface, 1}}, 0.0).after.yawRate / degree;
}

double steepest(double penetrationTime) {
  double most = 0.0;
  double last = yawRateAfter(0.1 * degree, penetrationTime);
  for (int i = 2; i < 1800; ++i) {
    const double next = yawRateAfter(0.1 * i * degree, penetrationTime);
    most = std::max(most, std::abs(next - last));
    last = next;
  }
  return most;
}

double speedLeftAtTheEndWall(double penetrationTime, Law law) {
  ResponseSettings settings;
  settings.penetrationTime = penetrationTime;
  settings.law = law;
  const Recording run = examples::runTestRail(testRail(), settings);
  for (const RecordedImpact& each : run.impacts()) {
    const ImpactEvent event = each.event();
    if (event.approachSpeed > 15.0) return event.speedAfter;
  }
  return std::nan("");
}

// rms of the relative error in yaw rate over the published rows.
double smallOverlapError(double penetrationTime) {
  constexpr double front = 2.375;  // m, the Fusion's, of which five of the six rows are
  constexpr double width = 1.829;  // m
  std::ifstream file(std::string(BUMPER_TEST_DATA) + "/small_overlap_tests.csv");
  std::string line;
  std::getline(file, line);
  double squares = 0.0;
  int rows = 0;
  while (std::getline(file, line)) {
    std::vector<double> values;
    std::istringstream cells(line);
    std::string cell;
    for (int column = 0; column < 14 && std::getline(cells, cell, ','); ++column) {
      values.push_back(column < 3 ? 0.0 : std::stod(cell));
    }
    const double speed = values[5];
    const Vector2 normal = -Vector2(std::cos(values[8] * degree), std::sin(values[8] * degree));
    const ContactBody car{.inverseMass = 1.0 / values[3],
                          .inverseYawInertia = 1.0 / values[4],
                          .arm = {front - speed * penetrationTime, (0.5 - 0.125) * width},
                          .velocity = {speed, 0.0}};
    const ContactSolution solution = solveRestitution(
        contactMobility(car, {}, normal), contactVelocity(car, {}, normal), values[9],
        {.kind = Friction::Kind::fraction_of_critical, .value = 0.01 * values[10]});
    const double yawRate =
        onVehicle(solution.impulse, normal, car.arm).angular * car.inverseYawInertia / degree;
    squares += std::pow(yawRate / values[13] - 1.0, 2);
    ++rows;
  }
  return std::sqrt(squares / rows);
}

}  // namespace

int main() {
  dInitODE2(0);
  std::printf(
      "| penetration time | steepest yaw rate, °/s per 0.1° | left at the end wall, restitution | "
      "energy | small overlap: yaw rate off by |\n|---|---|---|---|---|\n");
  for (const double time : {0.0, 0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.075}) {
    std::printf("| %.1f ms | %.0f | %.1f m/s | %.1f m/s | %.0f %% |\n", 1e3 * time, steepest(time),
                speedLeftAtTheEndWall(time, Law::restitution),
                speedLeftAtTheEndWall(time, Law::energy), 100.0 * smallOverlapError(time));
  }
  dCloseODE();
}
