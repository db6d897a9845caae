#include "primitive_wall.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "bumper/response/error.h"
#include "ode_vectors.h"

namespace bumper {

namespace {

void requireFinite(bool isFinite, const char* what) {
  if (isFinite) return;
  throw Error(std::string("addBarrier: the ") + what + " has a number that is not finite");
}

}  // namespace

PrimitiveWall::PrimitiveWall(dGeomID geom, const WorldFrame& frame, double maxNormalUp) {
  if (dGeomGetClass(geom) == dPlaneClass) {
    dVector4 plane;
    dGeomPlaneGetParams(geom, plane);
    direction_ = frame.direction(toVector(plane));
    place_ = plane[3] / frame.metre() * direction_;
    requireFinite(direction_.allFinite() && place_.allFinite(), "plane");
    if (std::abs(direction_.z()) > maxNormalUp) {
      throw Error("addBarrier: the plane is flatter than WallSelection::maxNormalUp allows");
    }
    foot_ = -std::numeric_limits<double>::infinity();
    top_ = std::numeric_limits<double>::infinity();
    return;
  }
  dReal radius = 0.0;
  dReal length = 0.0;
  dGeomCylinderGetParams(geom, &radius, &length);
  radius /= frame.metre();
  length /= frame.metre();
  place_ = frame.vector(toVector(dGeomGetPosition(geom)));
  direction_ = frame.direction(toMatrix(dGeomGetRotation(geom)).col(2));
  if (direction_.z() < 0.0) direction_ = -direction_;
  radius_ = radius;
  requireFinite(place_.allFinite() && direction_.allFinite() && std::isfinite(radius) &&
                    std::isfinite(length),
                "cylinder");
  if (direction_.head<2>().norm() > maxNormalUp) {
    throw Error("addBarrier: the cylinder leans further than WallSelection::maxNormalUp allows");
  }
  foot_ = place_.z() - 0.5 * length * direction_.z();
  top_ = place_.z() + 0.5 * length * direction_.z();
}

std::optional<Segment> PrimitiveWall::cut(const VehicleState& state, const Envelope& vehicle,
                                          double beyond) const {
  const double low = vehicle.low();
  const double high = vehicle.high();
  const double reach = vehicle.radius() + beyond;
  const Eigen::Vector3d place = state.axes.transpose() * (place_ - state.massCentre);
  const Eigen::Vector3d direction = state.axes.transpose() * direction_;
  Segment wall;
  if (isPost()) {
    const double footHeight = place.z() + (foot_ - place_.z()) * state.up().z();
    const double topHeight = place.z() + (top_ - place_.z()) * state.up().z();
    if (topHeight < low || footHeight > high) return std::nullopt;
    const Vector2 centre = (place - place.z() / direction.z() * direction).head<2>();
    if (centre.norm() > reach + radius_) return std::nullopt;
    wall.start = wall.end = centre;
    wall.radius = radius_;
    return wall;
  }
  const double planar = direction.head<2>().norm();
  wall.normal = direction.head<2>() / planar;
  // The nearest line within the band.
  const double offset =
      (direction.dot(place) - std::min(direction.z() * low, direction.z() * high)) / planar;
  if (-offset > reach) return std::nullopt;
  const Vector2 foot = offset * wall.normal;
  const Vector2 along = (2.0 * reach + std::abs(offset)) * turnedLeft(wall.normal);
  wall.start = foot - along;
  wall.end = foot + along;
  wall.solid = true;
  return wall;
}

double PrimitiveWall::clearanceAtLeast(const Eigen::Vector3d& place, double height) const {
  const Eigen::Vector3d away = place - place_;
  if (isPost()) {
    return direction_.cross(away).norm() - radius_ - height * direction_.head<2>().norm();
  }
  return direction_.dot(away) - height * std::abs(direction_.z());
}

double PrimitiveWall::freeUntil(const PlanStrip& strip, double z, double height) const {
  // Discs in a row.
  const double length = strip.end - strip.start;
  const auto discs =
      static_cast<int>(std::ceil(std::max(1.0, length / std::max(2.0 * strip.halfWidth, 1.0))));
  const double half = 0.5 * length / discs;
  const double radius = std::hypot(half, strip.halfWidth);
  for (int k = 0; k < discs; ++k) {
    const double begin = strip.start + 2.0 * k * half;
    const Eigen::Vector2d middle = strip.origin + (begin + half) * strip.direction;
    const bool isFree = clearanceAtLeast({middle.x(), middle.y(), z}, height) > radius;
    if (!isFree) return k > 0 ? begin : -std::numeric_limits<double>::infinity();
  }
  return strip.end;
}

double PrimitiveWall::lean() const {
  const double aside = direction_.head<2>().norm();
  const double up = std::abs(direction_.z());
  return isPost() ? aside / up : up / aside;
}

}  // namespace bumper
