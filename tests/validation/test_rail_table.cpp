// How the test rail goes under every reading of the paper, as a Markdown table:
//
//     test_rail_table [--out]          --out also writes out/test_rail_table.md
//
// Both methods, both laws, the three definitions of the angle of attack, and for Method::bumper
// three penetration times (Method::paper knows none). A cell is one hit: when, which part of the
// outline, the yaw rate after it in the paper's sign (SAE, positive turning right), and the mass
// centre's speed after it. The last column holds the row against the paper's account of Figures 6
// and 7.

#include <ode/ode.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "bumper/scenes/paper_scenes.h"
#include "test_rail_run.h"

namespace {

using namespace bumper;

constexpr double perDegree = 180.0 / std::numbers::pi;
/// Impulses on one wall that follow each other within four steps are one hit.
constexpr double oneHit = 0.02;  // s
/// Slower contacts are the car settling against a wall.
constexpr double slowest = 0.3;    // m/s
constexpr double halfWidth = 0.9;  // m, the example car's

enum class Wall { side, end };

struct Hit {
  Wall wall = Wall::side;
  double time = 0.0;
  double lastTime = 0.0;
  double approachSpeed = 0.0;  ///< of the hardest impulse …
  double impulse = 0.0;
  Vector2 arm;                ///< … and where it acted
  double yawRateAfter = 0.0;  ///< °/s, SAE
  double speedAfter = 0.0;
};

/// The test rail's walls stand at right angles, almost.
Wall wallOf(const ImpactEvent& event) {
  return std::abs(event.normal.x()) > std::abs(event.normal.y()) ? Wall::end : Wall::side;
}

std::vector<Hit> hitsOf(const Recording& run) {
  std::vector<Hit> hits;
  for (const RecordedImpact& each : run.impacts()) {
    const ImpactEvent event = each.event();
    if (event.phase != EventPhase::impact) continue;
    const Wall wall = wallOf(event);
    if (hits.empty() || hits.back().wall != wall || event.time > hits.back().lastTime + oneHit) {
      hits.push_back({.wall = wall, .time = event.time, .arm = event.arm});
    }
    Hit& hit = hits.back();
    const double impulse = std::hypot(event.impulseNormal, event.impulseTangent);
    if (impulse > hit.impulse) {
      hit.impulse = impulse;
      hit.approachSpeed = event.approachSpeed;
      hit.arm = event.arm;
    }
    hit.lastTime = event.time;
    hit.yawRateAfter = -event.yawRateAfter * perDegree;
    hit.speedAfter = event.speedAfter;
  }
  std::erase_if(hits, [](const Hit& hit) { return hit.approachSpeed < slowest; });
  return hits;
}

std::string fixed(double value, int digits) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(digits) << value;
  return text.str();
}

/// Contact points nearer to it than this lie in the middle of the front or rear.
constexpr double middle = 0.05;  // m

bool isFront(const Vector2& arm) { return arm.x() > 0.0; }
bool isLeft(const Vector2& arm) { return arm.y() > 0.0; }

/// A contact point away from the corner says how far from the middle it lies.
std::string partOf(const Vector2& arm) {
  const std::string part = isFront(arm) ? "front" : "rear";
  if (std::abs(arm.y()) < middle) return part + ", middle";
  const std::string side = isLeft(arm) ? "left" : "right";
  if (std::abs(arm.y()) > 0.9 * halfWidth) return part + ' ' + side;
  return part + ", " + fixed(std::abs(arm.y()), 2) + " m " + side;
}

std::string cell(const Hit& hit) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(3) << hit.time << " s " << partOf(hit.arm) << ", "
       << std::setprecision(0) << std::showpos << hit.yawRateAfter << " °/s, " << std::noshowpos
       << std::setprecision(1) << hit.speedAfter << " m/s";
  return text.str();
}

std::string cell(const std::vector<Hit>& hits, std::size_t index) {
  return index < hits.size() ? cell(hits[index]) : "–";
}

/// Where the run departs from the paper's account first; "as told" if nowhere. The bounds are those
/// of tests/examples, but any point left of the middle is "left front".
std::string verdict(const std::vector<Hit>& side, const std::vector<Hit>& end) {
  if (side.empty() || !isFront(side[0].arm) || isLeft(side[0].arm)) {
    return "front right does not hit first";
  }
  if (std::abs(side[0].time - 1.5) > 0.05) return "first hit not at 1.5 s";
  if (side[0].yawRateAfter > -50.0) return "no spike of negative yaw rate";
  if (side.size() < 2 || isFront(side[1].arm) || isLeft(side[1].arm)) {
    return "rear right does not follow";
  }
  if (side[1].time - side[0].time > 0.25) return "rear right follows late";
  if (side[1].yawRateAfter < 0.0) return "rear right does not reverse the yaw";
  if (end.empty()) return "end wall not reached";
  if (std::abs(end[0].time - 2.5) > 0.2) return "end wall not at 2.5 s";
  if (!isFront(end[0].arm) || end[0].arm.y() < middle) {
    return "end wall met by the " + partOf(end[0].arm);
  }
  if (end[0].speedAfter > 5.0) return fixed(end[0].speedAfter, 1) + " m/s left: not stopped";
  if (end[0].yawRateAfter > 0.0) return "residual yaw rate positive";
  return "as told";
}

std::string_view nameOf(AngleDefinition angle) {
  switch (angle) {
    case AngleDefinition::contact_velocity:
      return "contact point";
    case AngleDefinition::centre_velocity:
      return "mass centre";
    case AngleDefinition::heading:
      return "heading";
  }
  return "";
}

std::string row(const Scene& scene, const ResponseSettings& settings) {
  std::vector<Hit> side;
  std::vector<Hit> end;
  for (const Hit& hit : hitsOf(examples::runTestRail(scene, settings))) {
    // What comes after the end wall is another story.
    if (hit.wall == Wall::end) {
      end.push_back(hit);
    } else if (end.empty()) {
      side.push_back(hit);
    }
  }
  const bool paper = settings.method == Method::paper;
  std::string text = "| ";
  text += paper ? "paper" : "bumper";
  text += " | " + std::string(toString(settings.law));
  text += " | " + std::string(nameOf(settings.angle));
  text += " | " + (paper ? "–" : fixed(1e3 * settings.penetrationTime, 1) + " ms");
  for (std::size_t i = 0; i < 3; ++i) text += " | " + cell(side, i);
  text += " | " + cell(end, 0);
  text += " | " + verdict(side, end) + " |\n";
  return text;
}

std::string table() {
  std::string text =
      "| method | law | angle by | penetration time | side wall, first hit | second | third | end "
      "wall | against the paper |\n|---|---|---|---|---|---|---|---|---|\n";
  const Scene scene = testRail();
  for (const Method method : {Method::paper, Method::bumper}) {
    for (const Law law : {Law::restitution, Law::energy}) {
      for (const AngleDefinition angle :
           {AngleDefinition::contact_velocity, AngleDefinition::centre_velocity,
            AngleDefinition::heading}) {
        ResponseSettings settings;
        settings.method = method;
        settings.law = law;
        settings.angle = angle;
        if (method == Method::paper) {
          text += row(scene, settings);
          continue;
        }
        for (const double time : {0.001, 0.0025, 0.010}) {
          settings.penetrationTime = time;
          text += row(scene, settings);
        }
      }
    }
  }
  return text;
}

void write(const std::string& text) {
  const std::filesystem::path path = "out/test_rail_table.md";
  std::filesystem::create_directories(path.parent_path());
  std::ofstream file(path);
  file << text;
  if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
  std::cout << "\nwritten to " << path.string() << '\n';
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string_view> arguments(argv + 1, argv + argc);
  if (arguments.size() > 1 || (arguments.size() == 1 && arguments[0] != "--out")) {
    std::cerr << "usage: test_rail_table [--out]\n";
    return 2;
  }
  try {
    dInitODE2(0);
    const std::string text = table();
    std::cout << text;
    if (!arguments.empty()) write(text);
    dCloseODE();
  } catch (const std::exception& error) {
    std::cerr << "test_rail_table: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
