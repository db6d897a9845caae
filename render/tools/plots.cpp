#include "plots.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <span>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

#include "bumper/base/child_process.h"
#include "bumper/base/output_file.h"
#include "bumper/render/degrees.h"
#include "bumper/render/image.h"
#include "bumper/response/contact_point.h"
#include "bumper/response/error.h"
#include "bumper/scenes/walls.h"

namespace bumper::tools {

namespace {

constexpr const char* plotterName = "gnuplot";

constexpr const char* look = R"(
set terminal pngcairo size 1200,600 font 'sans,13' background rgb 'white'
set border 3 lc rgb '#404040'
set tics nomirror
set grid lc rgb '#dddddd' lw 1 lt 1
set key top right
)";

ChildProcess::Patience patienceOf(const PlotOptions& options) {
  return std::chrono::ceil<std::chrono::milliseconds>(
      std::chrono::duration<double>(options.patience));
}

bool isPicture(const OutputFile& output) {
  try {
    readPng(output.path());
    return true;
  } catch (const Error&) {
    return false;
  }
}

/// No word of the script is the user's: gnuplot would run commands in the name of a file. It is
/// content with a full disk, so that what it wrote is looked at.
void runPlotter(const std::string& script, const PlotOptions& options,
                const std::filesystem::path& png) {
  OutputFile output(png);
  std::string words;
  try {
    const std::string begin = "set output '" + output.path().string() + "'\n";
    ChildProcess plotter(plotterName, {}, {.input = true, .errors = true});
    const ChildProcess::Patience patience = patienceOf(options);
    const bool isTaken = plotter.write(std::as_bytes(std::span(begin)), patience) &&
                         plotter.write(std::as_bytes(std::span(script)), patience);
    const int status = plotter.hasStalled() ? plotter.kill() : plotter.wait(patience);
    words = plotter.lastErrorLine();
    if (plotter.hasStalled()) words = "it did nothing for too long and was stopped; " + words;
    if (hasSucceeded(status) && isTaken) {
      if (isPicture(output)) {
        output.moveToPlace();
        return;
      }
      words = "what it wrote is no whole picture; " + words;
    }
  } catch (const std::system_error& error) {
    words = error.code().message();
  }
  throw Error("gnuplot could not draw " + png.string() + (words.empty() ? "" : ": " + words));
}

const std::vector<RecordedPose>& posesOf(const Recording& recording, const PlotOptions& options) {
  const auto vehicles = recording.vehicles();
  if (options.vehicle >= vehicles.size() || vehicles[options.vehicle].poses.empty())
    throw Error("there is nothing to plot: the recording holds no pose of the vehicle");
  return vehicles[options.vehicle].poses;
}

std::vector<ImpactEvent> impactsOf(const Recording& recording, const PlotOptions& options) {
  std::vector<ImpactEvent> impacts;
  for (const RecordedImpact& impact : recording.impacts()) {
    if (const auto event = asSeenBy(recording.vehicles()[options.vehicle].name, impact.event()))
      impacts.push_back(*event);
  }
  return impacts;
}

// The look, the axis of time, and a line at each impact, with its number where there is room.
void beginPlot(std::ostream& script, const Recording& recording, const PlotOptions& options) {
  script << look << "set xlabel 'time, s'\nset xzeroaxis lw 1 lc rgb '#808080'\n";
  const std::vector<RecordedPose>& poses = posesOf(recording, options);
  const double room = 0.015 * (poses.back().time - poses.front().time);
  double labelled = -std::numeric_limits<double>::infinity();
  int number = 0;
  for (const RecordedImpact& impact : recording.impacts()) {
    ++number;
    const ImpactEvent event = impact.event();
    if (!asSeenBy(recording.vehicles()[options.vehicle].name, event)) continue;
    script << "set arrow from " << event.time << ", graph 0 to " << event.time
           << ", graph 1 nohead lw 1 dt 3 lc rgb '#d62728' back\n";
    if (event.time - labelled < room) continue;
    labelled = event.time;
    script << "set label '" << number << "' at " << event.time
           << ", graph 1 offset 0,0.6 center tc rgb '#d62728' font ',10'\n";
  }
}

// The outline of a vehicle at a pose as a closed line; y times `side`.
void outlineAt(std::ostream& out, const RecordedVehicle& vehicle, double time, double side) {
  const std::optional<RecordedPose> pose = poseAt(vehicle, time);
  if (!pose) return;
  const std::array<Vector2, 4> corners = Outline(vehicle.parameters).corners();
  for (std::size_t k = 0; k <= corners.size(); ++k) {
    const Vector2 corner =
        pose->position.head<2>() + rotated(corners[k % 4], heading(pose->orientation));
    out << corner.x() << ' ' << side * corner.y() << '\n';
  }
  out << '\n';
}

}  // namespace

bool havePlotter() {
  try {
    return hasSucceeded(ChildProcess(plotterName, {"--version"}, {}).wait(patienceOf({})));
  } catch (const std::system_error&) {
    return false;
  }
}

void plotYawRate(const Recording& recording, const PlotOptions& options,
                 const std::filesystem::path& png) {
  const double sign = options.sae ? -1.0 : 1.0;
  std::ostringstream script;
  script << "$rate << EOD\n";
  for (const RecordedPose& pose : posesOf(recording, options))
    script << pose.time << ' ' << sign * pose.yawRate * degrees << '\n';
  script << "EOD\n";
  beginPlot(script, recording, options);
  script << "set title 'Yaw rate'\nset ylabel 'yaw rate, deg/s ("
         << (options.sae ? "SAE J670: positive turning right" : "ISO 8855: positive turning left")
         << ")'\nplot $rate using 1:2 with lines lw 2 lc rgb '#1f4e9c' notitle\n";
  runPlotter(script.str(), options, png);
}

void plotSpeed(const Recording& recording, const PlotOptions& options,
               const std::filesystem::path& png) {
  std::ostringstream script;
  script << "$speed << EOD\n";
  for (const RecordedPose& pose : posesOf(recording, options))
    script << pose.time << ' ' << pose.velocity.norm() << '\n';
  script << "EOD\n";
  beginPlot(script, recording, options);
  script << R"(set title 'Speed of the mass centre'
set ylabel 'speed, m/s'
set yrange [0:]
plot $speed using 1:2 with lines lw 2 lc rgb '#1f4e9c' notitle
)";
  runPlotter(script.str(), options, png);
}

void plotForce(const Recording& recording, const PlotOptions& options,
               const std::filesystem::path& png) {
  const std::vector<RecordedPose>& poses = posesOf(recording, options);
  const double mass = recording.vehicles()[options.vehicle].parameters.mass;
  std::ostringstream script;
  script << "$force << EOD\n";
  for (std::size_t k = 1; k < poses.size(); ++k) {
    const double step = poses[k].time - poses[k - 1].time;
    if (step <= 0.0) continue;
    const Eigen::Vector3d force = poses[k].orientation.conjugate() *
                                  (poses[k].velocity - poses[k - 1].velocity) * (mass / step);
    // Constant over the step.
    for (const double time : {poses[k - 1].time, poses[k].time}) {
      script << time << ' ' << force.x() / 1000.0 << ' '
             << (options.sae ? -1.0 : 1.0) * force.y() / 1000.0 << '\n';
    }
  }
  script << "EOD\n";
  beginPlot(script, recording, options);
  script << R"(set title 'Force on the mass centre, tyres and impacts together'
set ylabel 'force, kN'
plot $force using 1:2 with lines lw 2 lc rgb '#1f4e9c' title 'along the vehicle, positive forward', \
     $force using 1:3 with lines lw 2 lc rgb '#d62728' title 'across, positive to the )"
         << (options.sae ? "right" : "left") << "'\n";
  runPlotter(script.str(), options, png);
}

void plotImpulse(const Recording& recording, const PlotOptions& options,
                 const std::filesystem::path& png) {
  const std::vector<RecordedPose>& poses = posesOf(recording, options);
  std::ostringstream script;
  script << "$impulse << EOD\n";
  double normal = 0.0;
  double tangent = 0.0;
  script << poses.front().time << " 0 0 0 0\n";
  bool isHitByOthers = false;
  for (const ImpactEvent& event : impactsOf(recording, options)) {
    isHitByOthers = isHitByOthers || !event.otherVehicle.empty();
    normal += event.impulseNormal / 1000.0;
    tangent += std::abs(event.impulseTangent) / 1000.0;
    script << event.time << ' ' << event.impulseNormal / 1000.0 << ' '
           << std::abs(event.impulseTangent) / 1000.0 << ' ' << normal << ' ' << tangent << '\n';
  }
  script << poses.back().time << " 0 0 " << normal << ' ' << tangent << "\nEOD\n";
  beginPlot(script, recording, options);
  script << R"(set title ')"
         << (isHitByOthers ? "Impulse of walls and other vehicles" : "Impulse of the walls") << R"('
set ylabel 'impulse, kN s'
set yrange [0:]
set key top left
plot $impulse using 1:2 with impulses lw 4 lc rgb '#1f4e9c' title 'each impact, along the normal', \
     $impulse using 1:3 with impulses lw 2 lc rgb '#d62728' title 'each impact, friction', \
     $impulse using 1:4 with steps lw 1.5 dt 2 lc rgb '#1f4e9c' title 'all so far, along the normal', \
     $impulse using 1:5 with steps lw 1.5 dt 2 lc rgb '#d62728' title 'all so far, friction'
)";
  runPlotter(script.str(), options, png);
}

void plotPath(const Scene& scene, const Recording& recording, const PlotOptions& options,
              const std::filesystem::path& png) {
  const RecordedVehicle& vehicle = recording.vehicles()[options.vehicle];
  const std::vector<RecordedPose>& poses = posesOf(recording, options);
  const double side = options.sae ? -1.0 : 1.0;
  Eigen::AlignedBox2d frame;
  std::ostringstream script;
  script << "$path << EOD\n";
  for (const RecordedPose& pose : poses) {
    frame.extend(Eigen::Vector2d(pose.position.x(), side * pose.position.y()));
    script << pose.position.x() << ' ' << side * pose.position.y() << ' ' << pose.velocity.norm()
           << '\n';
  }
  script << "EOD\n$walls << EOD\n0 0\n\n";
  for (const Wall& wall : selectWalls(scene).walls) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d& a = wall.corners[k];
      const Eigen::Vector3d& b = wall.corners[(k + 1) % 3];
      script << a.x() << ' ' << side * a.y() << '\n' << b.x() << ' ' << side * b.y() << "\n\n";
    }
  }
  script << "EOD\n$cars << EOD\n";
  for (int half = 0; poses.front().time + 0.5 * half <= poses.back().time; ++half)
    outlineAt(script, vehicle, poses.front().time + 0.5 * half, side);
  script << "EOD\n$impacts << EOD\n";
  for (const ImpactEvent& event : impactsOf(recording, options))
    script << event.contact.x() << ' ' << side * event.contact.y() << '\n';
  script << "EOD\n" << look;
  constexpr double margin = 8.0;  // m
  // To scale, and yet of a shape that fills the plot and leaves the scales room.
  constexpr double flattest = 0.4;
  const Eigen::Vector2d middle = frame.center();
  Eigen::Vector2d half = 0.5 * frame.sizes() + Eigen::Vector2d(margin, margin);
  half = half.cwiseMax(flattest * half.maxCoeff());
  script << "set xrange [" << middle.x() - half.x() << ':' << middle.x() + half.x() << "]\n"
         << "set yrange [" << middle.y() - half.y() << ':' << middle.y() + half.y() << ']'
         << (options.sae ? " reverse\n" : "\n")  // from above, either way
         << "set ylabel 'y, m ("
         << (options.sae ? "SAE J670: positive to the right" : "ISO 8855: positive to the left")
         << ")'\n";
  script << R"(
set title 'Path of the mass centre, outline every 0.5 s'
set xlabel 'x, m'
set cblabel 'speed, m/s'
set palette defined (0 '#440154', 1 '#31688e', 2 '#35b779', 3 '#fde725')
set size ratio -1
set key outside top center horizontal
plot $walls with lines lw 1.5 lc rgb '#606060' title 'walls', \
     $cars with lines lw 1 lc rgb '#909090' title 'outline', \
     $path using 1:2:3 with lines lw 3 lc palette title 'mass centre')";
  if (!impactsOf(recording, options).empty())
    script << ", $impacts with points pt 7 ps 1.2 lc rgb '#d62728' title 'impacts'";
  runPlotter(script.str() + "\n", options, png);
}

void plotCurves(const ResponseSettings& settings, const PlotOptions& options,
                const std::filesystem::path& png) {
  std::ostringstream script;
  script << "$curves << EOD\n";
  for (int angle = 0; angle <= 90; ++angle) {
    const double alpha = angle / degrees;
    script << angle << ' ' << settings.restitution(alpha) << ' ' << settings.friction(alpha) << ' '
           << settings.energyRemaining(alpha) << '\n';
  }
  script << "EOD\n"
         << look << R"(
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
  runPlotter(script.str(), options, png);
}

}  // namespace bumper::tools
