#include "long_run.h"

#include <sys/resource.h>

#include <cmath>
#include <string>

#include "synthetic_run.h"

namespace bumper::testing {

void addLongRun(RecordingWriter& writer, std::size_t vehicles, int seconds, int perSecond) {
  for (std::size_t k = 0; k < vehicles; ++k) {
    writer.addVehicle("car " + std::to_string(k), saloon());
  }
  for (int step = 0; step <= seconds * perSecond; ++step) {
    const double time = static_cast<double>(step) / perSecond;
    for (std::size_t k = 0; k < vehicles; ++k) {
      RecordedPose pose;
      pose.time = time;
      const double turn = 0.1 * time + static_cast<double>(k);
      pose.position = {10.0 * time, std::sin(turn), 0.5 + 0.01 * std::sin(7.0 * turn)};
      pose.orientation = Eigen::AngleAxisd(turn, Eigen::Vector3d(0.01, 0.02, 1.0).normalized());
      pose.velocity = {10.0, std::cos(turn), 0.07 * std::cos(7.0 * turn)};
      pose.yawRate = 0.1 * std::cos(0.3 * turn);
      writer.addPose(k, pose);
    }
    if (step % perSecond != 0) continue;
    ImpactEvent event;
    event.time = time;
    event.vehicle = "car 0";
    event.normal = Eigen::Vector3d::UnitY();
    event.deltaV = time;
    writer.addImpact(event);
  }
  writer.close();
}

std::uint64_t peakMemory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024U;
}

}  // namespace bumper::testing
