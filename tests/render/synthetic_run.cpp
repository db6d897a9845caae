#include "synthetic_run.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "bumper/scenes/paper_scenes.h"

namespace bumper::testing {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Eigen::Quaterniond turnedBy(double yaw) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Vector3d::UnitZ()));
}

RecordedPose poseOf(double time, const Vector2d& position, double yaw, const Vector2d& velocity,
                    double yawRate) {
  RecordedPose pose;
  pose.time = time;
  pose.position << position, saloon().massCentreHeight;
  pose.orientation = turnedBy(yaw);
  pose.velocity << velocity, 0.0;
  pose.yawRate = yawRate;
  return pose;
}

/// Motion from an instant on; both velocities fade by the given rate, 1/s.
struct Piece {
  double until;
  Vector2d velocity;
  double yawRate;
  double fading;
};

ImpactEvent eventAt(double time, const Vector2d& contact, const Vector2d& normal, double deltaV) {
  ImpactEvent event;
  event.time = time;
  event.vehicle = "saloon";
  event.barrier = "wall";
  event.triangle = 7;
  event.material = "concrete";
  event.contact << contact, saloon().massCentreHeight;
  event.normal << normal.normalized(), 0.0;
  event.deltaV = deltaV;
  event.approachSpeed = deltaV;
  event.impulseNormal = saloon().mass * deltaV;
  return event;
}

}  // namespace

VehicleParameters saloon() {
  VehicleParameters vehicle;
  vehicle.mass = 1226.0;
  vehicle.yawInertia = 1539.0;
  vehicle.massCentreToFront = 2.05;
  vehicle.massCentreToRear = 2.35;
  vehicle.width = 1.70;
  vehicle.massCentreHeight = 0.56;
  return vehicle;
}

Recording testRailRun() {
  const std::vector<Piece> pieces = {{1.50, {26.8, 0.0}, 0.0, 0.0},
                                     {1.60, {26.2, 1.7}, 1.05, 0.0},
                                     {2.45, {25.6, 2.95}, -0.08, 0.02},
                                     {4.20, {-1.6, 1.5}, -0.95, 0.8}};
  Recording run;
  const std::size_t vehicle = run.addVehicle("saloon", saloon());
  constexpr double step = 0.01;
  Vector2d position(0.0, 0.0);
  double yaw = 0.0;
  int count = 0;
  for (Piece piece : pieces) {
    for (; count * step < piece.until - 0.5 * step; ++count) {
      run.addPose(vehicle, poseOf(count * step, position, yaw, piece.velocity, piece.yawRate));
      position += step * piece.velocity;
      yaw += step * piece.yawRate;
      piece.velocity *= 1.0 - piece.fading * step;
      piece.yawRate *= 1.0 - piece.fading * step;
    }
  }
  run.addImpact(eventAt(1.50, {42.25, -0.91}, {-0.10453, 0.99452}, 4.2));
  run.addImpact(eventAt(1.60, {40.50, -1.09}, {-0.10453, 0.99452}, 3.1));
  run.addImpact(eventAt(2.45, {66.75, 3.90}, {-0.98163, -0.19081}, 26.4));
  return run;
}

Recording courseRun() {
  constexpr std::size_t points = 5400;
  constexpr std::size_t begin = 900;
  constexpr std::size_t length = 170;
  constexpr double impactAt = 95.0;  // m after the beginning
  constexpr double touching = 6.1;   // m beside the centre line
  const std::vector<Vector2d> line = courseCentreLine(points);
  // Towards the outside of the bend.
  const Vector2d before = line[begin + 20] - line[begin];
  const Vector2d after = line[begin + 120] - line[begin + 100];
  const double outward = before.x() * after.y() - before.y() * after.x() > 0.0 ? -1.0 : 1.0;

  Recording run;
  const std::size_t vehicle = run.addVehicle("saloon", saloon());
  double time = 0.0;
  double impactTime = 0.0;
  Vector2d impactPlace;
  Vector2d impactNormal;
  for (std::size_t k = 0; k < length; ++k) {
    const auto way = static_cast<double>(k);
    const Vector2d ahead = (line[begin + k + 1] - line[begin + k]).normalized();
    const Vector2d aside = outward * Vector2d(-ahead.y(), ahead.x());
    const bool free = way < impactAt;
    const double share = std::max(0.0, (way - 40.0) / (impactAt - 40.0));
    const double offset =
        free ? touching * share * share : touching - 3.0 * std::sin((way - impactAt) / 60.0);
    const double drift = free ? 2.0 * touching * share / (impactAt - 40.0)
                              : -0.05 * std::cos((way - impactAt) / 60.0);
    const double speed = free ? 38.0 - 0.03 * way : 29.0 - 0.20 * (way - impactAt);
    const double yaw = std::atan2(ahead.y(), ahead.x()) + outward * std::atan(drift);
    const Vector2d place = line[begin + k] + offset * aside;
    run.addPose(vehicle, poseOf(time, place, yaw, speed * (ahead + drift * aside), 0.0));
    if (way <= impactAt) {
      impactTime = time;
      impactPlace = line[begin + k] + 7.0 * aside + 2.0 * ahead;
      impactNormal = -aside;
    }
    time += 1.0 / speed;
  }
  run.addImpact(eventAt(impactTime, impactPlace, impactNormal, 9.3));
  return run;
}

Recording cornerHits() {
  struct Hit {
    Vector2d onWall;
    Vector2d normal;
    double heading;
    Vector2d arm;
    double deltaV;
    double friction;  ///< along z × normal, as a share of the normal impulse
  };
  const std::vector<Hit> hits = {
      {{42.334, -0.900}, {-0.10453, 0.99452}, 0.0, {2.03, -0.83}, 2.0, 0.3},
      {{66.900, 3.242}, {-0.98163, -0.19081}, 0.105, {2.02, 0.50}, 24.0, -0.05}};
  Recording run;
  const std::size_t vehicle = run.addVehicle("saloon", saloon());
  double time = 1.0;
  for (const Hit& hit : hits) {
    const Vector2d ahead(std::cos(hit.heading), std::sin(hit.heading));
    const Vector2d left(-ahead.y(), ahead.x());
    const Vector2d place = hit.onWall - hit.arm.x() * ahead - hit.arm.y() * left;
    run.addPose(vehicle, poseOf(time, place, hit.heading, 25.0 * ahead, 0.0));
    ImpactEvent event = eventAt(time, hit.onWall, hit.normal, hit.deltaV);
    event.arm = hit.arm;
    event.impulseTangent = hit.friction * event.impulseNormal;
    const Vector2d tangent(-hit.normal.y(), hit.normal.x());
    event.velocityAfter << 25.0 * ahead + hit.deltaV * (hit.normal + hit.friction * tangent), 0.0;
    event.speedBefore = 25.0;
    event.speedAfter = event.velocityAfter.norm();
    run.addImpact(event);
    time += 1.0;
  }
  return run;
}

Recording sideHit() {
  constexpr double half = 0.5 * std::numbers::pi;
  constexpr double deltaV = 7.0;     // along the normal, m/s
  constexpr double friction = -0.3;  // the saloon is dragged along y
  const Vector2d touch(saloon().massCentreToFront, 0.0);
  const Vector2d crossing = touch + Vector2d(0.5 * saloon().width, 0.4);
  Recording run;
  const std::size_t first = run.addVehicle("saloon", saloon());
  const std::size_t second = run.addVehicle("crossing", saloon());
  run.addPose(first, poseOf(1.0, {0.0, 0.0}, 0.0, {15.0, 0.0}, 0.0));
  run.addPose(second, poseOf(1.0, crossing, half, {0.0, 10.0}, 0.0));
  ImpactEvent event = eventAt(1.0, touch, {-1.0, 0.0}, deltaV * std::hypot(1.0, friction));
  event.barrier = event.material = "";
  event.otherVehicle = "crossing";
  event.triangle = -1;
  event.arm = touch;
  event.otherArm = {touch.y() - crossing.y(), crossing.x() - touch.x()};
  event.approachSpeed = 15.0;
  event.impulseNormal = saloon().mass * deltaV;
  event.impulseTangent = friction * event.impulseNormal;
  // The normal is −x, the tangent −y.
  const Vector3d change(-deltaV, -friction * deltaV, 0.0);
  event.velocityBefore = {15.0, 0.0, 0.0};
  event.velocityAfter = event.velocityBefore + change;
  event.otherVelocityBefore = {0.0, 10.0, 0.0};
  event.otherVelocityAfter = event.otherVelocityBefore - change;
  event.speedBefore = event.velocityBefore.norm();
  event.speedAfter = event.velocityAfter.norm();
  event.yawRateAfter = 1.2;
  event.otherYawRateAfter = -0.8;
  run.addImpact(event);
  return run;
}

Recording standingVehicle(const Vector2d& place, double heading) {
  Recording run;
  run.addPose(run.addVehicle("saloon", saloon()), poseOf(0.0, place, heading, {0.0, 0.0}, 0.0));
  return run;
}

Recording turned(const Recording& run, double angle) {
  Recording result;
  for (const RecordedVehicle& vehicle : run.vehicles()) {
    const std::size_t index = result.addVehicle(vehicle.name, vehicle.parameters);
    for (RecordedPose pose : vehicle.poses) {
      pose.orientation = turnedBy(angle) * pose.orientation;
      result.addPose(index, pose);
    }
  }
  for (const RecordedImpact& impact : run.impacts()) result.addImpact(impact.event());
  return result;
}

Recording withoutImpact(const Recording& run, std::size_t index) {
  Recording shorter;
  for (const RecordedVehicle& vehicle : run.vehicles()) {
    const std::size_t copy = shorter.addVehicle(vehicle.name, vehicle.parameters);
    for (const RecordedPose& pose : vehicle.poses) shorter.addPose(copy, pose);
  }
  for (std::size_t k = 0; k < run.impacts().size(); ++k) {
    if (k != index) shorter.addImpact(run.impacts()[k].event());
  }
  return shorter;
}

}  // namespace bumper::testing
