#include "wall_cut.h"

#include <algorithm>
#include <array>
#include <limits>

namespace bumper {

namespace {

// A wall whose normal is nearly along the vehicle's z axis has no direction in its yaw plane.
constexpr double minPlanarNormal = 0.1;

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void include(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

// The yaw plane of a vehicle that pitches cuts the plane of a leaning strip along another line than
// the strip itself, and over the band's height far before it. So what counts is the strip's outline
// in the band, and its own direction.
std::optional<Segment> cutStrip(const WallFace& face, const Strip& strip, const VehicleState& state,
                                const Envelope& vehicle) {
  const Vector2 direction = (state.axes.transpose() * strip.direction).head<2>();
  const Vector2 facing = (state.axes.transpose() * face.normal()).head<2>();
  const double planar = direction.norm();
  if (planar < minPlanarNormal) return std::nullopt;
  Segment segment;
  segment.normal = turnedLeft(direction) / planar;
  if (segment.normal.dot(facing) < 0.0) segment.normal = -segment.normal;
  const Vector2 tangent = turnedLeft(segment.normal);

  Range place;
  Range away;
  const auto include = [&](const Eigen::Vector3d& point) {
    place.include(tangent.dot(point.head<2>()));
    away.include(segment.normal.dot(point.head<2>()));
  };
  const std::span<const Eigen::Vector3d> corners = face.corners();
  Eigen::Vector3d last = state.axes.transpose() * (corners.back() - state.massCentre);
  for (const Eigen::Vector3d& each : corners) {
    const Eigen::Vector3d corner = state.axes.transpose() * (each - state.massCentre);
    if (vehicle.low() <= corner.z() && corner.z() <= vehicle.high()) include(corner);
    for (const double limit : {vehicle.low(), vehicle.high()}) {
      if ((last.z() < limit) == (corner.z() < limit)) continue;
      include(last + (limit - last.z()) / (corner.z() - last.z()) * (corner - last));
    }
    last = corner;
  }
  if (!(place.low < place.high)) return std::nullopt;
  const Vector2 foot = (away.high <= 0.0 ? away.high : away.low) * segment.normal;
  segment.start = foot + place.low * tangent;
  segment.end = foot + place.high * tangent;
  return segment;
}

}  // namespace

std::optional<Segment> cutFace(const WallFace& face, const VehicleState& state,
                               const Envelope& vehicle) {
  if (const std::optional<Strip> strip = stripOf(face)) {
    return cutStrip(face, *strip, state, vehicle);
  }
  const Eigen::Vector3d normal = state.axes.transpose() * face.normal();
  const double planar = normal.head<2>().norm();
  if (planar < minPlanarNormal) return std::nullopt;
  Segment segment;
  segment.normal = normal.head<2>() / planar;
  const Vector2 tangent = turnedLeft(segment.normal);
  const Eigen::Vector3d along = state.toWorld(tangent);
  const Eigen::Vector3d up = state.up();

  const std::span<const Eigen::Vector3d> corners = face.corners();
  std::array<double, WallFace::mostCorners> heights;
  std::array<double, WallFace::mostCorners> places;
  Range height;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Eigen::Vector3d corner = corners[k] - state.massCentre;
    heights[k] = up.dot(corner);
    places[k] = along.dot(corner);
    height.include(heights[k]);
  }
  const double low = vehicle.low();
  const double high = vehicle.high();
  if (height.low > high || height.high < low) return std::nullopt;
  // Along the tangent, of the part in the band.
  Range place;
  std::size_t last = corners.size() - 1;
  for (std::size_t k = 0; k < corners.size(); last = k++) {
    if (low <= heights[k] && heights[k] <= high) place.include(places[k]);
    const auto [lower, upper] = std::minmax(heights[last], heights[k]);
    if (upper < low || lower > high) continue;
    const double slope = (places[k] - places[last]) / (heights[k] - heights[last]);
    if (lower < low) place.include(places[last] + (low - heights[last]) * slope);
    if (upper > high) place.include(places[last] + (high - heights[last]) * slope);
  }
  if (!(place.low < place.high)) return std::nullopt;

  // The mass centre is the frame's origin; on the face the way out follows from the height.
  const double distance = face.normal().dot(corners.front() - state.massCentre);
  const double atFoot = (distance - normal.z() * std::max(low, height.low)) / planar;
  const double atTop = (distance - normal.z() * std::min(high, height.high)) / planar;
  const double away = std::max(atFoot, atTop);
  const double offset = away <= 0.0 ? away : std::min(atFoot, atTop);
  const Vector2 foot = offset * segment.normal;
  segment.start = foot + place.low * tangent;
  segment.end = foot + place.high * tangent;
  return segment;
}

}  // namespace bumper
