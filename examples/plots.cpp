#include "plots.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <sstream>
#include <string>

#include "bumper/response/contact_point.h"
#include "bumper/response/error.h"
#include "bumper/scenes/walls.h"

namespace bumper::examples {

namespace {

constexpr double degrees = 180.0 / std::numbers::pi;

constexpr const char* look = R"(
set terminal pngcairo size 1200,600 font 'sans,13' background rgb 'white'
set border 3 lc rgb '#404040'
set tics nomirror
set grid lc rgb '#dddddd' lw 1 lt 1
set key top right
)";

std::string quoted(const std::filesystem::path& path) {
  std::string text = "'";
  for (const char c : path.string()) text += c == '\'' ? std::string("''") : std::string(1, c);
  return text + "'";
}

void runPlotter(const std::string& script, const std::filesystem::path& png) {
  std::FILE* plotter = popen("gnuplot", "w");
  bool sound = plotter != nullptr;
  if (sound) {
    sound = std::fwrite(script.data(), 1, script.size(), plotter) == script.size();
    sound = pclose(plotter) == 0 && sound;
  }
  if (!sound) throw Error("gnuplot could not draw " + png.string());
}

// The outline of a vehicle at a pose as a closed line.
void outlineAt(std::ostream& out, const RecordedVehicle& vehicle, double time) {
  const std::optional<RecordedPose> pose = poseAt(vehicle, time);
  if (!pose) return;
  const std::array<Vector2, 4> corners = Outline(vehicle.parameters).corners();
  for (std::size_t k = 0; k <= corners.size(); ++k) {
    const Vector2 corner =
        pose->position.head<2>() + rotated(corners[k % 4], heading(pose->orientation));
    out << corner.x() << ' ' << corner.y() << '\n';
  }
  out << '\n';
}

}  // namespace

bool havePlotter() { return std::system("gnuplot --version >/dev/null 2>&1") == 0; }

void plotYawRate(const Recording& recording, const std::filesystem::path& png) {
  std::ostringstream script;
  script << "$rate << EOD\n";
  for (const RecordedPose& pose : recording.vehicles()[0].poses) {
    script << pose.time << ' ' << -pose.yawRate * degrees << '\n';
  }
  script << "EOD\n"
         << look << "set output " << quoted(png) << R"(
set title 'Yaw rate (the paper, Figure 7)'
set xlabel 'time, s'
set ylabel 'yaw rate, deg/s (SAE J670: z down, positive turning right)'
set xzeroaxis lw 1 lc rgb '#808080'
plot $rate using 1:2 with lines lw 2 lc rgb '#1f4e9c' notitle
)";
  runPlotter(script.str(), png);
}

void plotTrajectory(const Scene& scene, const Recording& recording,
                    const std::filesystem::path& png) {
  const RecordedVehicle& vehicle = recording.vehicles()[0];
  std::ostringstream script;
  script << "$path << EOD\n";
  for (const RecordedPose& pose : vehicle.poses) {
    script << pose.position.x() << ' ' << pose.position.y() << ' ' << pose.velocity.norm() << '\n';
  }
  script << "EOD\n$walls << EOD\n";
  for (const Wall& wall : selectWalls(scene).walls) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d& a = wall.corners[k];
      const Eigen::Vector3d& b = wall.corners[(k + 1) % 3];
      script << a.x() << ' ' << a.y() << '\n' << b.x() << ' ' << b.y() << "\n\n";
    }
  }
  script << "EOD\n$cars << EOD\n";
  const double start = vehicle.poses.front().time;
  for (int half = 0; start + 0.5 * half <= vehicle.poses.back().time; ++half) {
    outlineAt(script, vehicle, start + 0.5 * half);
  }
  script << "EOD\n$impacts << EOD\n";
  for (const RecordedImpact& impact : recording.impacts()) {
    const Eigen::Vector3d contact = impact.event().contact;
    script << contact.x() << ' ' << contact.y() << '\n';
  }
  script << "EOD\n"
         << look << "set output " << quoted(png) << R"(
set title 'Path of the mass centre, outline every 0.5 s (the paper, Figure 6)'
set xlabel 'x, m'
set ylabel 'y, m (ISO 8855: positive to the left)'
set cblabel 'speed, m/s'
set palette defined (0 '#440154', 1 '#31688e', 2 '#35b779', 3 '#fde725')
set size ratio -1
set xrange [-5:75]
set yrange [-12:14]
set key top left
plot $walls with lines lw 1.5 lc rgb '#606060' title 'walls', \
     $cars with lines lw 1 lc rgb '#909090' title 'outline', \
     $path using 1:2:3 with lines lw 3 lc palette title 'mass centre', \
     $impacts with points pt 7 ps 1.2 lc rgb '#d62728' title 'impacts'
)";
  runPlotter(script.str(), png);
}

void plotCurves(const ResponseSettings& settings, const std::filesystem::path& png) {
  std::ostringstream script;
  script << "$curves << EOD\n";
  for (int angle = 0; angle <= 90; ++angle) {
    const double alpha = angle / degrees;
    script << angle << ' ' << settings.restitution(alpha) << ' ' << settings.friction(alpha) << ' '
           << settings.energyRemaining(alpha) << '\n';
  }
  script << "EOD\n"
         << look << "set output " << quoted(png) << R"(
set title 'Restitution (the paper, Figure 4), friction and remaining energy'
set xlabel 'angle of attack, deg (0 grazing, 90 head-on)'
set xrange [0:90]
set xtics 15
set yrange [0:0.35]
set y2range [0:1]
set y2tics
set border 11
set ylabel 'restitution e, friction {/Symbol m}'
set y2label 'remaining energy P'
plot $curves using 1:2 with lines lw 3 lc rgb '#1f4e9c' title 'e', \
     $curves using 1:3 with lines lw 3 dt 2 lc rgb '#d62728' title '{/Symbol m}', \
     $curves using 1:4 axes x1y2 with lines lw 3 dt 4 lc rgb '#2a7f3f' title 'P (right axis)'
)";
  runPlotter(script.str(), png);
}

}  // namespace bumper::examples
