// Writes what the response does over the angle as CSV files and, if gnuplot is found, as pictures:
//
//     response_curves <folder>
//
// One car, one flat wall, 60 mph; yaw rate and rebound against the heading for four penetration
// times, and what the energy law makes of its P curve at each corner and at a flush side.

#include <array>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "bumper/response/collision_step.h"
#include "bumper/response/impact_event.h"

namespace {

using bumper::Vector2;

constexpr double degree = std::numbers::pi / 180.0;
constexpr double sixtyMilesPerHour = 26.8224;  // m/s
constexpr std::array<double, 4> penetrationTimes = {0.0, 0.0025, 0.010, 0.050};

constexpr bumper::VehicleParameters car{.mass = 1500.0,
                                        .yawInertia = 2600.0,
                                        .massCentreToFront = 2.1,
                                        .massCentreToRear = 2.5,
                                        .width = 1.8,
                                        .massCentreHeight = 0.55};

bumper::PlanarMotion approach() {
  bumper::PlanarMotion motion;
  motion.velocity = {sixtyMilesPerHour, 0.0};
  return motion;
}

/// Out of a wall to the left of the car that its x axis meets at `angle`.
Vector2 wallNormal(double angle) { return {-std::sin(angle), -std::cos(angle)}; }

std::ofstream openFile(const std::filesystem::path& path) {
  std::ofstream file(path);
  if (!file) throw std::runtime_error("cannot write " + path.string());
  file.precision(10);
  return file;
}

void writeHeadings(const std::filesystem::path& folder) {
  std::ofstream file = openFile(folder / "heading.csv");
  file << "heading_deg";
  for (const double time : penetrationTimes) {
    const std::string name = std::to_string(std::lround(1e4 * time)) + "e-4s";
    file << ",yaw_rate_deg_s_" << name << ",rebound_mps_" << name << ",energy_ratio_" << name
         << ",impacts_" << name;
  }
  file << '\n';

  const bumper::PlanarMotion motion = approach();
  const double energyBefore = bumper::yawPlaneEnergy(motion, car.mass, car.yawInertia);
  bumper::CollisionStep step;
  for (int i = 0; i <= 1800; ++i) {
    const Vector2 normal = wallNormal(0.1 * i * degree);
    double lowest = 0.0;
    for (const Vector2& corner : bumper::Outline(car).corners()) {
      lowest = std::min(lowest, normal.dot(corner));
    }
    // Noticed at once: only the first corner is inside.
    const Vector2 touched = (lowest + 1e-5) * normal;
    file << 0.1 * i;
    for (const double time : penetrationTimes) {
      bumper::ResponseSettings settings;
      settings.penetrationTime = time;
      bumper::Segment wall;
      wall.start = touched - 50.0 * bumper::turnedLeft(normal);
      wall.end = touched + 50.0 * bumper::turnedLeft(normal);
      wall.normal = normal;
      const bumper::Surface surface{.settings = &settings};
      const bumper::StepOutcome outcome =
          step.resolve(car, motion, {{&wall, 1}, {&surface, 1}}, 0.0);
      file << ',' << outcome.after.yawRate / degree << ',' << outcome.after.velocity.dot(normal)
           << ',' << bumper::yawPlaneEnergy(outcome.after, car.mass, car.yawInertia) / energyBefore
           << ',' << outcome.impacts.size();
    }
    file << '\n';
  }
}

constexpr std::array<const char*, 5> contactNames = {"front_left", "rear_left", "rear_right",
                                                     "front_right", "flush"};

void writeEnergyLaw(const std::filesystem::path& folder) {
  std::ofstream file = openFile(folder / "energy_law.csv");
  file << "angle_deg,energy_asked";
  for (const char* name : contactNames) {
    file << ",restitution_" << name << ",energy_ratio_" << name << ",outcome_" << name;
  }
  file << '\n';

  const bumper::PlanarMotion motion = approach();
  bumper::ResponseSettings settings;
  settings.law = bumper::Law::energy;
  settings.restSpeed = 0.0;
  const std::array<Vector2, 4> corners = bumper::Outline(car).corners();
  for (int i = 1; i <= 900; ++i) {
    bumper::Impact impact;
    impact.normal = wallNormal(0.1 * i * degree);
    file << 0.1 * i;
    for (std::size_t k = 0; k < contactNames.size(); ++k) {
      // A flush side is met through the mass centre.
      impact.arm = k < corners.size() ? corners[k] : Vector2(-0.5 * car.width * impact.normal);
      const bumper::ImpactResponse response =
          bumper::respond(impact, bumper::freeBody(car, motion), settings);
      if (k == 0) file << ',' << response.energyAsked;
      file << ',' << response.restitution << ',' << response.energyRatio << ','
           << bumper::toString(response.outcome);
    }
    file << '\n';
  }
}

std::string plotCommands() {
  std::string text =
      "set datafile separator ','\n"
      "set terminal pngcairo size 1400,1000\n"
      "set key noenhanced outside\n"
      "set grid\n"
      "set output 'heading.png'\n"
      "set multiplot layout 2,1\n"
      "set xrange [0:180]\n"
      "set xtics 15\n"
      "set xlabel 'heading against the wall, deg'\n"
      "set ylabel 'yaw rate after the impact, deg/s'\n"
      "plot for [k=0:3] 'heading.csv' using 1:(column(2+4*k)) "
      "with lines lw 2 lc k+1 title columnheader(2+4*k)\n"
      "set ylabel 'rebound of the mass centre, m/s'\n"
      "plot for [k=0:3] 'heading.csv' using 1:(column(3+4*k)) "
      "with lines lw 2 lc k+1 title columnheader(3+4*k)\n"
      "unset multiplot\n"
      "set output 'energy_law.png'\n"
      "set multiplot layout 2,1\n"
      "set xrange [0:90]\n"
      "set xtics 10\n"
      "set xlabel 'angle of attack, deg'\n"
      "set ylabel 'restitution'\n"
      "plot for [k=0:4] 'energy_law.csv' using 1:(column(3+3*k)) "
      "with lines lw 2 lc k+1 title columnheader(3+3*k)\n"
      "set ylabel 'energy that remains'\n"
      "plot 'energy_law.csv' using 1:2 with lines lw 3 dt 2 lc 'black' title columnheader(2), \\\n"
      "  for [k=0:4] 'energy_law.csv' using 1:(column(4+3*k)) "
      "with lines lw 2 lc k+1 title columnheader(4+3*k)\n"
      "unset multiplot\n";
  return text;
}

/// Where the shell would find a program; empty if nowhere.
std::filesystem::path findProgram(std::string_view name) {
  const char* variable = std::getenv("PATH");
  std::string_view rest = variable == nullptr ? std::string_view() : std::string_view(variable);
  while (!rest.empty()) {
    const std::size_t colon = rest.find(':');
    std::filesystem::path candidate = std::filesystem::path(rest.substr(0, colon)) / name;
    if (std::filesystem::exists(candidate)) return candidate;
    rest = colon == std::string_view::npos ? std::string_view() : rest.substr(colon + 1);
  }
  return {};
}

void drawPlots(const std::filesystem::path& folder) {
  openFile(folder / "curves.gnuplot") << plotCommands();
  if (findProgram("gnuplot").empty()) {
    std::cout << "gnuplot is not installed: no pictures\n";
    return;
  }
  std::filesystem::current_path(folder);
  if (std::system("gnuplot curves.gnuplot") != 0) {
    throw std::runtime_error("gnuplot could not draw curves.gnuplot");
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::span arguments(argv, static_cast<std::size_t>(argc));
  if (arguments.size() != 2) {
    std::cerr << "usage: response_curves <folder>\n";
    return 2;
  }
  try {
    const std::filesystem::path folder = arguments[1];
    std::filesystem::create_directories(folder);
    writeHeadings(folder);
    writeEnergyLaw(folder);
    drawPlots(folder);
    std::cout << "written to " << folder.string() << '\n';
  } catch (const std::exception& error) {
    std::cerr << "response_curves: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
