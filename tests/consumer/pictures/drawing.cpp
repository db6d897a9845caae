#include "drawing.h"

#include <bumper/render/snapshot.h>
#include <bumper/scenes/paper_scenes.h>

#include <cstdlib>
#include <numbers>
#include <string>

namespace {

using namespace bumper;

Recording run(const std::string& defect) {
  constexpr double degree = std::numbers::pi / 180.0;
  Recording recording;
  const std::size_t car = recording.addVehicle("car", {.mass = 1226.0,
                                                       .yawInertia = 1539.0,
                                                       .massCentreToFront = 2.05,
                                                       .massCentreToRear = 2.35,
                                                       .width = 1.7,
                                                       .massCentreHeight = 0.56});
  const double heading = (defect == "turn" ? -9.0 : -10.0) * degree;
  for (int k = 0; k <= 20; ++k) {
    RecordedPose pose;
    pose.time = 0.01 * k;
    pose.position = {-3.0 + 0.15 * k, 1.6 - 0.01 * k, 0.56};
    pose.orientation = Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ());
    pose.velocity = {15.0, -1.0, 0.0};
    recording.addPose(car, pose);
  }
  if (defect == "mark") return recording;
  ImpactEvent event;
  event.time = 0.2;
  event.vehicle = "car";
  event.contact = {2.0, 0.0, 0.56};
  event.normal = Eigen::Vector3d::UnitY();
  event.deltaV = 4.0;
  recording.addImpact(event);
  return recording;
}

}  // namespace

bumper::Image drawRun() {
  const char* variable = std::getenv("BREAK");
  const std::string defect = variable == nullptr ? "" : variable;
  const Recording recording = run(defect);
  const SnapshotOptions options{.width = 1280, .height = 720};
  Scene wall = straightWall({-40.0, 0.0}, {40.0, 0.0}, 1.0);
  if (defect == "wall") {
    // Across the wall, one pixel's worth of metres.
    const auto here = projectToSnapshot(wall, recording, options, {0.0, 0.0, 0.0});
    const auto there = projectToSnapshot(wall, recording, options, {0.0, 1.0, 0.0});
    const double pixel = 1.0 / (there.value() - here.value()).norm();
    for (Eigen::Vector3d& vertex : wall.vertices) vertex.y() -= pixel;
  }
  return renderSnapshot(wall, recording, options);
}
