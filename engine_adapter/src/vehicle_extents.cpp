#include "vehicle_extents.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "ode_vectors.h"

namespace bumper {

namespace {

/// All that lies within a ball, or a disc across an axis, around any point of the corners' hull.
struct ConvexShape {
  std::vector<Eigen::Vector3d> corners;
  double ball = 0.0;  // radius, m
  double disc = 0.0;  // radius, m
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();

  /// How far it reaches along a direction of any length.
  [[nodiscard]] double along(const Eigen::Vector3d& direction) const {
    double most = -std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3d& corner : corners) most = std::max(most, direction.dot(corner));
    return most + ball * direction.norm() + disc * direction.cross(axis).norm();
  }

  /// … within heights, which it must meet: of all planes that lean against it, taken where they
  /// cross the lowest or highest height, the nearest. That is the dual of the linear programme.
  [[nodiscard]] double along(const Eigen::Vector3d& direction, const Heights& heights) const {
    const double high = std::min(heights.high, along(Eigen::Vector3d::UnitZ()));
    const double low = std::max(heights.low, -along(-Eigen::Vector3d::UnitZ()));
    const auto atLean = [&](double angle) {
      const double lean = std::tan(angle);
      return along(direction - lean * Eigen::Vector3d::UnitZ()) + lean * (lean > 0.0 ? high : low);
    };
    // It falls and then rises: golden section.
    constexpr double steepest = 0.5 * std::numbers::pi - 1e-4;
    constexpr int rounds = 80;  // to rounding
    constexpr double share = 1.0 / std::numbers::phi;
    double first = -steepest;
    double last = steepest;
    double nearFirst = last - share * (last - first);
    double nearLast = first + share * (last - first);
    double atNearFirst = atLean(nearFirst);
    double atNearLast = atLean(nearLast);
    for (int i = 0; i < rounds; ++i) {
      if (atNearFirst <= atNearLast) {
        last = nearLast;
        nearLast = nearFirst;
        atNearLast = atNearFirst;
        nearFirst = last - share * (last - first);
        atNearFirst = atLean(nearFirst);
      } else {
        first = nearFirst;
        nearFirst = nearLast;
        atNearFirst = atNearLast;
        nearLast = first + share * (last - first);
        atNearLast = atLean(nearLast);
      }
    }
    // It ends upright if all of it is within the heights.
    return std::min({atNearFirst, atNearLast, atLean(0.0)});
  }
};

// The corners of a convex, which ODE does not expose: a plane through it gets a contact at each
// corner beneath, so it is cut once from either side.
std::vector<Eigen::Vector3d> cornersOf(dGeomID convex) {
  constexpr std::size_t most = 0xffff;  // contacts that dCollide can give
  dReal box[6];
  dGeomGetAABB(convex, box);
  const double middle = 0.5 * (box[4] + box[5]);
  std::vector<Eigen::Vector3d> corners;
  std::vector<dContactGeom> contacts(64);
  for (const double up : {1.0, -1.0}) {
    const dGeomID plane = dCreatePlane(nullptr, 0.0, 0.0, up, up * middle);
    std::size_t count = 0;
    while (true) {
      count = static_cast<std::size_t>(dCollide(convex, plane, static_cast<int>(contacts.size()),
                                                contacts.data(), sizeof(dContactGeom)));
      if (count < contacts.size() || contacts.size() == most) break;
      contacts.resize(std::min(8 * contacts.size(), most));
    }
    dGeomDestroy(plane);
    for (std::size_t i = 0; i < count; ++i) corners.push_back(toVector(contacts[i].pos));
  }
  return corners;
}

// ODE recommends offsets, but applications still use transforms.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
dGeomID geomIn(dGeomID transform) { return dGeomTransformGetGeom(transform); }
#pragma GCC diagnostic pop

class Measurement {
 public:
  explicit Measurement(const Heights& heights) : heights_(heights) {}

  /// `frame` transforms from the frame of the geom's own pose to the vehicle's.
  void add(dGeomID geom, const Eigen::Isometry3d& frame, bool isInTransform = false) {
    const int kind = dGeomGetClass(geom);
    if (kind == dTriMeshClass) {
      addTriangles(geom, frame);
      return;
    }
    if (kind == dConvexClass) {
      if (isInTransform) return;
      ConvexShape shape{.corners = cornersOf(geom)};
      for (Eigen::Vector3d& corner : shape.corners) corner = frame * corner;
      add(shape);
      return;
    }
    if (kind != dGeomTransformClass && kind != dBoxClass && kind != dSphereClass &&
        kind != dCapsuleClass && kind != dCylinderClass) {
      return;
    }
    Eigen::Isometry3d own = Eigen::Isometry3d::Identity();
    own.linear() = toMatrix(dGeomGetRotation(geom));
    own.translation() = toVector(dGeomGetPosition(geom));
    own = frame * own;
    if (kind == dGeomTransformClass) {
      const dGeomID inner = geomIn(geom);
      if (inner != nullptr) add(inner, own, true);
      return;
    }
    add(primitive(geom, kind, own));
  }

  [[nodiscard]] std::optional<VehicleExtents> result() const {
    if (extents_.lowest > extents_.highest) return std::nullopt;
    return extents_;
  }

 private:
  static ConvexShape primitive(dGeomID geom, int kind, const Eigen::Isometry3d& own) {
    ConvexShape shape;
    if (kind == dBoxClass) {
      dVector3 lengths;
      dGeomBoxGetLengths(geom, lengths);
      const Eigen::Vector3d half = 0.5 * toVector(lengths);
      for (unsigned i = 0; i < 8; ++i) {
        const Eigen::Vector3d corner((i & 1U) != 0 ? half.x() : -half.x(),
                                     (i & 2U) != 0 ? half.y() : -half.y(),
                                     (i & 4U) != 0 ? half.z() : -half.z());
        shape.corners.emplace_back(own * corner);
      }
      return shape;
    }
    if (kind == dSphereClass) {
      shape.corners.emplace_back(own.translation());
      shape.ball = dGeomSphereGetRadius(geom);
      return shape;
    }
    dReal radius = 0.0;
    dReal length = 0.0;
    if (kind == dCapsuleClass) {
      dGeomCapsuleGetParams(geom, &radius, &length);
      shape.ball = radius;
    } else {
      dGeomCylinderGetParams(geom, &radius, &length);
      shape.disc = radius;
    }
    shape.axis = own.linear().col(2);
    shape.corners = {own.translation() + 0.5 * length * shape.axis,
                     own.translation() - 0.5 * length * shape.axis};
    return shape;
  }

  void addTriangles(dGeomID trimesh, const Eigen::Isometry3d& frame) {
    if (dGeomTriMeshGetTriMeshDataID(trimesh) == nullptr) return;
    ConvexShape triangle{.corners = std::vector<Eigen::Vector3d>(3)};
    for (int i = 0; i < dGeomTriMeshGetTriangleCount(trimesh); ++i) {
      dVector3 corners[3];
      dGeomTriMeshGetTriangle(trimesh, i, &corners[0], &corners[1], &corners[2]);
      for (std::size_t k = 0; k < 3; ++k) triangle.corners[k] = frame * toVector(corners[k]);
      add(triangle);
    }
  }

  void add(const ConvexShape& shape) {
    if (shape.corners.empty()) return;
    const double top = shape.along(Eigen::Vector3d::UnitZ());
    const double bottom = -shape.along(-Eigen::Vector3d::UnitZ());
    if (top < heights_.low || bottom > heights_.high) return;
    extents_.highest = std::max(extents_.highest, std::min(top, heights_.high));
    extents_.lowest = std::min(extents_.lowest, std::max(bottom, heights_.low));
    const bool isWhole = heights_.low <= bottom && top <= heights_.high;
    const auto reach = [&](const Eigen::Vector3d& direction, double& most) {
      const double whole = shape.along(direction);
      if (whole > most) most = std::max(most, isWhole ? whole : shape.along(direction, heights_));
    };
    reach(Eigen::Vector3d::UnitX(), extents_.front);
    reach(-Eigen::Vector3d::UnitX(), extents_.rear);
    reach(Eigen::Vector3d::UnitY(), extents_.left);
    reach(-Eigen::Vector3d::UnitY(), extents_.right);
  }

  Heights heights_;
  VehicleExtents extents_;
};

}  // namespace

std::optional<VehicleExtents> extentsOf(std::span<const dBodyID> bodies, const VehiclePose& pose,
                                        const Heights& heights, const WorldFrame& frame) {
  // In the world's unit.
  const double metre = frame.metre();
  Eigen::Isometry3d toVehicle = Eigen::Isometry3d::Identity();
  toVehicle.linear() = pose.axes.transpose() * frame.turn().rows();
  toVehicle.translation() = -metre * (pose.axes.transpose() * pose.massCentre);
  Measurement measurement({.low = metre * heights.low, .high = metre * heights.high});
  for (dBodyID body : bodies) {
    for (dGeomID geom = dBodyGetFirstGeom(body); geom != nullptr; geom = dBodyGetNextGeom(geom)) {
      if (dGeomGetCategoryBits(geom) == 0 && dGeomGetCollideBits(geom) == 0) continue;
      measurement.add(geom, toVehicle);
    }
  }
  std::optional<VehicleExtents> extents = measurement.result();
  if (!extents || frame.isUsual()) return extents;
  for (const auto side :
       {&VehicleExtents::front, &VehicleExtents::rear, &VehicleExtents::left,
        &VehicleExtents::right, &VehicleExtents::lowest, &VehicleExtents::highest}) {
    *extents.*side /= metre;
  }
  return extents;
}

}  // namespace bumper
