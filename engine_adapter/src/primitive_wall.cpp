#include "primitive_wall.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "bumper/response/error.h"
#include "geom_class.h"
#include "ode_vectors.h"

namespace bumper {

namespace {

// Of a round end's radius, the part where it is steeper than 45°.
constexpr double steepShare = 0.7071067811865476;

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
  const int kind = dGeomGetClass(geom);
  const std::string name = classNameOf(geom);
  dReal radius = 0.0;
  dReal length = 0.0;
  if (kind == dCylinderClass) dGeomCylinderGetParams(geom, &radius, &length);
  if (kind == dCapsuleClass) dGeomCapsuleGetParams(geom, &radius, &length);
  if (kind == dSphereClass) radius = dGeomSphereGetRadius(geom);
  isRound_ = kind != dCylinderClass;
  radius /= frame.metre();
  length /= frame.metre();
  place_ = frame.vector(toVector(dGeomGetPosition(geom)));
  direction_ = kind == dSphereClass ? Eigen::Vector3d(Eigen::Vector3d::UnitZ())
                                    : frame.direction(toMatrix(dGeomGetRotation(geom)).col(2));
  if (direction_.z() < 0.0) direction_ = -direction_;
  radius_ = radius;
  halfLength_ = 0.5 * length;
  requireFinite(place_.allFinite() && direction_.allFinite() && std::isfinite(radius) &&
                    std::isfinite(length),
                name.c_str() + name.find(' ') + 1);
  if (!(radius_ > 0.0)) throw Error("addBarrier: the geom is " + name + " without a radius");
  if (direction_.head<2>().norm() > maxNormalUp) {
    throw Error("addBarrier: the geom is " + name +
                " that leans further than WallSelection::maxNormalUp allows");
  }
  const double half = halfLength_ * direction_.z() + (isRound_ ? steepShare * radius_ : 0.0);
  foot_ = place_.z() - half;
  top_ = place_.z() + half;
}

std::optional<PrimitiveWall::Section> PrimitiveWall::sectionOf(const Eigen::Vector3d& place,
                                                               const Eigen::Vector3d& direction,
                                                               double low, double high) const {
  if (!isRound_) {
    return Section{.centre = (place - place.z() / direction.z() * direction).head<2>(),
                   .radius = radius_};
  }
  // The axis between the centres of the ends, and the height on it next to the band, which is the
  // mass centre's if that is on it.
  const double half = halfLength_ * direction.z();
  const double onAxis = std::clamp(std::clamp(0.0, low, high), place.z() - half, place.z() + half);
  const double beyond = std::abs(std::clamp(onAxis, low, high) - onAxis);
  if (beyond > steepShare * radius_) return std::nullopt;
  return Section{.centre = (place + (onAxis - place.z()) / direction.z() * direction).head<2>(),
                 .radius = beyond > 0.0 ? std::sqrt(radius_ * radius_ - beyond * beyond) : radius_};
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
    const std::optional<Section> section = sectionOf(place, direction, low, high);
    if (!section || section->centre.norm() > reach + section->radius) return std::nullopt;
    wall.start = wall.end = section->centre;
    wall.radius = section->radius;
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
