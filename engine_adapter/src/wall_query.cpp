#include "wall_query.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "ode_vectors.h"

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

}  // namespace

std::optional<WallSegment> cutFace(const WallFace& face, const VehicleState& state, double low,
                                   double high) {
  const Eigen::Vector3d normal = state.axes.transpose() * face.normal();
  const double planar = normal.head<2>().norm();
  if (planar < minPlanarNormal) return std::nullopt;
  WallSegment segment;
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
  const double farthest = std::max(atFoot, atTop);
  const double offset = farthest <= 0.0 ? farthest : std::min(atFoot, atTop);
  const Vector2 foot = offset * segment.normal;
  segment.start = foot + place.low * tangent;
  segment.end = foot + place.high * tangent;
  return segment;
}

WallQuery::WallQuery(const VehicleParameters& parameters, const Band& band)
    : outline_(parameters),
      low_(band.bottom - parameters.massCentreHeight),
      high_(band.top - parameters.massCentreHeight),
      radius_(std::hypot(std::max(outline_.front, outline_.rear), outline_.halfWidth,
                         std::max(std::abs(low_), std::abs(high_)))),
      box_(dCreateBox(nullptr, 1.0, 1.0, 1.0)) {
  near_.reserve(256);
}

WallQuery::~WallQuery() { dGeomDestroy(box_); }

void WallQuery::placeBox(const VehicleState& state, const Margins& margins) {
  const double front = outline_.front + margins.front;
  const double rear = outline_.rear + margins.rear;
  const Eigen::Vector3d middle(0.5 * (front - rear), 0.0, 0.5 * (low_ + high_));
  const Eigen::Vector3d place = state.massCentre + state.axes * middle;
  dMatrix3 rotation = {state.axes(0, 0), state.axes(0, 1), state.axes(0, 2), 0.0,
                       state.axes(1, 0), state.axes(1, 1), state.axes(1, 2), 0.0,
                       state.axes(2, 0), state.axes(2, 1), state.axes(2, 2), 0.0};
  dGeomBoxSetLengths(box_, front + rear, 2.0 * (outline_.halfWidth + margins.side),
                     high_ - low_ + 2.0 * margins.height);
  dGeomSetPosition(box_, place.x(), place.y(), place.z());
  dGeomSetRotation(box_, rotation);
}

const std::vector<int>& WallQuery::list(const BarrierMesh& mesh, const VehicleState& state,
                                        const Margins& margins) {
  const double more = mesh.margin();
  placeBox(state, {.front = margins.front + more,
                   .rear = margins.rear + more,
                   .side = margins.side + more,
                   .height = margins.height + more});
  mesh.list(box_, near_);
  std::sort(near_.begin(), near_.end());
  return near_;
}

PlanRectangle WallQuery::swept(const PlanarMotion& motion, double h) const {
  // A little more than rounding and what counts as a touch.
  constexpr double slack = 1e-6;  // m
  const Vector2 way = h * motion.velocity;
  PlanRectangle all = outline_.enlarged(h * std::abs(motion.yawRate) * outline_.radius() + slack);
  all.middle += 0.5 * way;
  all.half += 0.5 * way.cwiseAbs();
  return all;
}

std::optional<Impact> WallQuery::meanOfContacts(const BarrierMesh& mesh,
                                                const VehicleState& state) {
  if (!mesh.reaches(state.massCentre, radius_)) return std::nullopt;
  constexpr int capacity = 64;
  std::array<dContactGeom, capacity> contacts;
  placeBox(state, {});
  const int count = mesh.contacts(box_, contacts.data(), capacity);
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double weight = 0.0;
  Impact impact;
  for (int i = 0; i < count; ++i) {
    const dContactGeom& contact = contacts[static_cast<std::size_t>(i)];
    point += contact.depth * toVector(contact.pos);
    normal += contact.depth * toVector(contact.normal);
    weight += contact.depth;
    if (contact.depth > impact.depth) {
      impact.depth = contact.depth;
      impact.wall = contact.side2;
    }
  }
  const Vector2 planar = (state.axes.transpose() * normal).head<2>();
  if (weight <= 0.0 || planar.norm() <= minPlanarNormal * normal.norm()) return std::nullopt;
  impact.normal = planar.normalized();
  impact.point = (state.axes.transpose() * (point / weight - state.massCentre)).head<2>();
  impact.arm = impact.point;
  return impact;
}

bool WallQuery::inBand(const VehiclePose& state, const Eigen::Vector3d& place, double foot,
                       double top) const {
  const auto height = [&](double z) {
    return state.up().dot(Eigen::Vector3d(place.x(), place.y(), z) - state.massCentre);
  };
  return height(top) >= low_ && height(foot) <= high_;
}

bool WallQuery::isAboveBottom(const VehiclePose& state, const Eigen::Vector3d& place) const {
  return state.up().dot(place - state.massCentre) >= low_;
}

bool WallQuery::isBelowTop(const VehiclePose& state, const Eigen::Vector3d& place) const {
  return state.up().dot(place - state.massCentre) <= high_;
}

bool WallQuery::allInBand(const VehiclePose& state, double highestFoot, double lowestTop) const {
  const Eigen::Vector3d up = state.up();
  const double slack = radius_ * up.head<2>().norm();
  const double footHeight = (highestFoot - state.massCentre.z()) * up.z() + slack;
  const double topHeight = (lowestTop - state.massCentre.z()) * up.z() - slack;
  return topHeight >= low_ && footHeight <= high_;
}

}  // namespace bumper
