#include "vehicle_warnings.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "bumper/response/contact_point.h"
#include "ode_vectors.h"
#include "vehicle_extents.h"

namespace bumper {

namespace {

// How far a geom may project from the outline, m: less is rounding of the given dimensions.
constexpr double outlineSlack = 0.01;

// How far geoms may reach below the ground, m: wheels hang lower before the car stands on them.
constexpr double droop = 0.15;

// Gravity that leans less, m aside for each m down, may model a slope.
constexpr double modelledSlope = 0.1;

std::string metres(double length) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f m", length);
  return text;
}

void warnOfLosses(dBodyID body, const std::string& vehicle, std::vector<std::string>& warnings) {
  const auto warn = [&](const char* what) {
    warnings.push_back(vehicle + "a body has " + what + ", which takes a part of every impulse");
  };
  if (dBodyGetLinearDamping(body) > 0.0) warn("linear damping");
  if (dBodyGetAngularDamping(body) > 0.0) warn("angular damping");
  if (std::isfinite(dBodyGetMaxAngularSpeed(body)) && dBodyGetMaxAngularSpeed(body) < 1e6) {
    warn("a maximum angular speed");
  }
}

// A wheel on a joint that is not linked adds mass that the law does not include.
void warnOfStrangers(dBodyID body, std::span<const dBodyID> bodies, const std::string& vehicle,
                     std::vector<std::string>& warnings) {
  for (int i = 0; i < dBodyGetNumJoints(body); ++i) {
    const dJointID joint = dBodyGetJoint(body, i);
    if (dJointGetType(joint) == dJointTypeContact) continue;
    for (const int side : {0, 1}) {
      const dBodyID other = dJointGetBody(joint, side);
      if (other == nullptr || std::find(bodies.begin(), bodies.end(), other) != bodies.end()) {
        continue;
      }
      warnings.push_back(vehicle +
                         "a joint leads to a body that is not among the linked bodies; if it "
                         "moves with the chassis as one, impulses will be wrong by its mass");
    }
  }
}

// "by 0.22 m at the sides and 0.10 m at the front"; empty: it does not.
std::string standingOut(const VehicleExtents& geoms, const Outline& outline) {
  const double side = std::max(geoms.left, geoms.right) - outline.halfWidth;
  const std::pair<double, const char*> ends[] = {
      {geoms.front - outline.front, "the front"},
      {geoms.rear - outline.rear, "the rear"},
      {side, geoms.left - geoms.right > outlineSlack   ? "the left side"
             : geoms.right - geoms.left > outlineSlack ? "the right side"
                                                       : "the sides"}};
  std::string text;
  for (const auto& [length, where] : ends) {
    if (length <= outlineSlack) continue;
    text += (text.empty() ? "by " : " and ") + metres(length) + " at " + where;
  }
  return text;
}

void warnOfOutline(const VehicleBodies& bodies, const VehicleParameters& parameters,
                   const Band& band, const std::string& vehicle,
                   std::vector<std::string>& warnings) {
  const VehiclePose pose = bodies.readPose();
  const Outline outline(parameters);
  const Heights heights{.low = band.bottom - parameters.massCentreHeight,
                        .high = band.top - parameters.massCentreHeight};
  const auto outOf = [&](std::span<const dBodyID> some) {
    const std::optional<VehicleExtents> geoms = extentsOf(some, pose, heights, bodies.frame());
    return geoms ? standingOut(*geoms, outline) : std::string();
  };
  const std::string chassis = outOf(bodies.all().first(1));
  const std::string linked = outOf(bodies.all().subspan(1));
  if (!chassis.empty()) {
    warnings.push_back(
        vehicle +
        "the outline is smaller than the chassis, whose geoms stand out of it within "
        "the band " +
        chassis + ": walls are answered at the outline, it goes that far into them");
  }
  if (!linked.empty()) {
    warnings.push_back(vehicle +
                       "geoms of linked bodies stand out of the outline within the band " + linked +
                       ": walls are answered at the outline, they go that far into them");
  }
}

void warnOfHeight(const VehicleBodies& bodies, const VehicleParameters& parameters,
                  const std::string& vehicle, std::vector<std::string>& warnings) {
  const std::optional<VehicleExtents> geoms =
      extentsOf(bodies.all(), bodies.readPose(), {}, bodies.frame());
  if (!geoms || -geoms->lowest <= parameters.massCentreHeight + droop) return;
  warnings.push_back(vehicle + "its geoms reach " + metres(-geoms->lowest) +
                     " below the mass centre, which the parameters put " +
                     metres(parameters.massCentreHeight) +
                     " above the ground: the band lies too high by the difference");
}

// Axes given wrong: the responder would leave the vehicle to ODE without a word.
void warnOfLean(const VehicleBodies& bodies, const std::string& vehicle,
                std::vector<std::string>& warnings) {
  constexpr double lying = 0.5;
  if (!(bodies.uprightness() < lying)) return;
  warnings.push_back(vehicle +
                     "it leans by more than 60°, so that its contacts are ODE's: see "
                     "VehicleOptions::axes and ResponderOptions::axes if it stands upright");
}

}  // namespace

std::vector<std::string> warningsOf(const VehicleBodies& bodies,
                                    const VehicleParameters& parameters, const Band& band,
                                    const std::string& name) {
  const std::string vehicle = "vehicle '" + name + "': ";
  std::vector<std::string> warnings;
  for (dBodyID body : bodies.all()) {
    warnOfLosses(body, vehicle, warnings);
    warnOfStrangers(body, bodies.all(), vehicle, warnings);
  }
  warnOfOutline(bodies, parameters, band, vehicle, warnings);
  warnOfHeight(bodies, parameters, vehicle, warnings);
  warnOfLean(bodies, vehicle, warnings);
  return warnings;
}

std::optional<std::string> warningOf(dWorldID world, const WorldFrame& frame) {
  dVector3 gravity;
  dWorldGetGravity(world, gravity);
  const Eigen::Vector3d own = frame.direction(toVector(gravity));
  if (own.head<2>().norm() <= -modelledSlope * own.z()) return std::nullopt;
  const Eigen::Vector3d up = frame.directionInWorld(Eigen::Vector3d::UnitZ());
  // Not a stream, which would swallow that memory has run out.
  char text[300];
  std::snprintf(text, sizeof text,
                "the world's gravity is (%g, %g, %g), not along -up: up is (%g, %g, %g), see "
                "ResponderOptions::axes and VehicleOptions::axes",
                gravity[0], gravity[1], gravity[2], up.x(), up.y(), up.z());
  return text;
}

}  // namespace bumper
