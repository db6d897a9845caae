#include "vehicle_shape.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace bumper::drawing {

namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

const Vector3f glass(0.13F, 0.16F, 0.21F);
const Vector3f tyre(0.10F, 0.10F, 0.11F);
const Vector3f rim(0.66F, 0.68F, 0.70F);
const Vector3f underside(0.20F, 0.20F, 0.21F);
const Vector3f frontLamp(1.00F, 0.96F, 0.78F);
const Vector3f rearLamp(0.52F, 0.02F, 0.04F);

/// A slice across the car: everything in shares of the outline and of the height.
struct Slice {
  double along;   ///< 0 at the rear, 1 at the front
  double across;  ///< half width
  double bottom;
  double top;
};

// From the rear to the front.
constexpr std::array<Slice, 8> body = {{{0.000, 0.84, 0.24, 0.52},
                                        {0.020, 0.91, 0.19, 0.59},
                                        {0.080, 0.97, 0.16, 0.63},
                                        {0.300, 0.97, 0.15, 0.64},
                                        {0.660, 0.97, 0.15, 0.62},
                                        {0.880, 0.96, 0.16, 0.54},
                                        {0.965, 0.88, 0.18, 0.47},
                                        {1.000, 0.70, 0.22, 0.41}}};

/// The cabin narrows from the belt line to the roof.
struct Cabin {
  double rearBase = 0.09;
  double rearTop = 0.23;
  double frontTop = 0.50;
  double frontBase = 0.68;
  double base = 0.615;
  double roof = 0.98;
  double baseWidth = 0.88;
  double roofWidth = 0.68;
};

class Builder {
 public:
  Builder(const VehicleParameters& vehicle, Vector3f paint)
      : rear_(-vehicle.massCentreToRear),
        length_(vehicle.massCentreToFront + vehicle.massCentreToRear),
        halfWidth_(0.5 * vehicle.width),
        ground_(-vehicle.massCentreHeight),
        height_(std::clamp(2.6 * vehicle.massCentreHeight, 0.25 * length_, 0.45 * length_)),
        paint_(std::move(paint)) {}

  std::vector<ShapeTriangle> build() {
    addBody();
    addCabin();
    addLamps();
    const double radius = std::min(0.235 * height_, 0.085 * length_);
    for (const double along : {0.19, 0.81}) {
      for (const double side : {-1.0, 1.0}) addWheel(along, side, radius);
    }
    return std::move(triangles_);
  }

 private:
  [[nodiscard]] Vector3d at(double along, double across, double up) const {
    return {rear_ + along * length_, across * halfWidth_, ground_ + up * height_};
  }

  void triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3f& colour) {
    triangles_.push_back({{a, b, c}, colour});
  }

  void quad(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d,
            const Vector3f& colour) {
    triangle(a, b, c, colour);
    triangle(a, c, d, colour);
  }

  /// Counter-clockwise as seen from the front.
  [[nodiscard]] std::array<Vector3d, 8> ring(const Slice& slice) const {
    const double w = slice.across;
    const double rise = slice.top - slice.bottom;
    const double sill = slice.bottom + 0.25 * rise;
    const double belt = slice.top - 0.22 * rise;
    return {at(slice.along, 0.90 * w, slice.bottom),
            at(slice.along, w, sill),
            at(slice.along, w, belt),
            at(slice.along, 0.90 * w, slice.top),
            at(slice.along, -0.90 * w, slice.top),
            at(slice.along, -w, belt),
            at(slice.along, -w, sill),
            at(slice.along, -0.90 * w, slice.bottom)};
  }

  void addBody() {
    for (std::size_t k = 1; k < body.size(); ++k) {
      const auto behind = ring(body[k - 1]);
      const auto ahead = ring(body[k]);
      for (std::size_t j = 0; j < behind.size(); ++j) {
        const std::size_t next = (j + 1) % behind.size();
        quad(behind[j], behind[next], ahead[next], ahead[j], j == 7 ? underside : paint_);
      }
    }
    const auto rear = ring(body.front());
    const auto front = ring(body.back());
    for (std::size_t j = 1; j + 1 < front.size(); ++j) {
      triangle(front[0], front[j], front[j + 1], paint_);
      triangle(rear[0], rear[j + 1], rear[j], paint_);
    }
  }

  void addCabin() {
    const Cabin c;
    const auto corners = [&](double along, double across, double up) {
      return std::array<Vector3d, 2>{at(along, across, up), at(along, -across, up)};
    };
    const auto rearBase = corners(c.rearBase, c.baseWidth, c.base);
    const auto rearTop = corners(c.rearTop, c.roofWidth, c.roof);
    const auto frontTop = corners(c.frontTop, c.roofWidth, c.roof);
    const auto frontBase = corners(c.frontBase, c.baseWidth, c.base);
    quad(frontBase[1], frontBase[0], frontTop[0], frontTop[1], glass);
    quad(rearBase[0], rearBase[1], rearTop[1], rearTop[0], glass);
    quad(frontBase[0], rearBase[0], rearTop[0], frontTop[0], glass);
    quad(rearBase[1], frontBase[1], frontTop[1], rearTop[1], glass);
    // The roof is a little wider than the windows' upper edge and has pillars of paint in front.
    const Vector3d lift(0.0, 0.0, 0.02 * height_);
    quad(frontTop[1] + lift, frontTop[0] + lift, rearTop[0] + lift, rearTop[1] + lift, paint_);
    for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
      addPillar(frontBase[side], frontTop[side]);
      addPillar(rearBase[side], rearTop[side]);
      addPillar(rearTop[side], frontTop[side]);
    }
    addPillar(frontTop[0], frontTop[1]);
    addPillar(rearTop[0], rearTop[1]);
  }

  /// A bar of paint along an edge of the cabin.
  void addPillar(const Vector3d& from, const Vector3d& to) {
    const Vector3d along = (to - from).normalized();
    const double half = 0.025 * height_;
    const Vector3d u = along.unitOrthogonal() * half;
    const Vector3d v = along.cross(u);
    const std::array<Vector3d, 4> corner = {u, v, -u, -v};
    for (std::size_t k = 0; k < 4; ++k) {
      const Vector3d& a = corner[k];
      const Vector3d& b = corner[(k + 1) % 4];
      quad(from + a, from + b, to + b, to + a, paint_);
    }
  }

  void addLamps() {
    for (const double side : {-1.0, 1.0}) {
      addLamp(0.955, 1.004, side, 0.34, 0.465, frontLamp);
      addLamp(-0.004, 0.030, side, 0.42, 0.565, rearLamp);
    }
  }

  /// A box at a corner of the body.
  void addLamp(double from, double to, double side, double low, double high,
               const Vector3f& colour) {
    const double inner = 0.42 * side;
    const double outer = 0.75 * side;
    const auto c = [&](double along, double across, double up) { return at(along, across, up); };
    const double left = std::max(inner, outer);
    const double right = std::min(inner, outer);
    quad(c(to, right, low), c(to, left, low), c(to, left, high), c(to, right, high), colour);
    quad(c(from, left, low), c(from, right, low), c(from, right, high), c(from, left, high),
         colour);
    quad(c(from, right, high), c(to, right, high), c(to, left, high), c(from, left, high), colour);
    quad(c(from, left, low), c(from, left, high), c(to, left, high), c(to, left, low), colour);
    quad(c(from, right, high), c(from, right, low), c(to, right, low), c(to, right, high), colour);
  }

  void addWheel(double along, double side, double radius) {
    constexpr int segments = 20;
    const double thickness = 0.24 * halfWidth_;
    const Vector3d hub(rear_ + along * length_, side * halfWidth_, ground_ + radius);
    const Vector3d inwards(0.0, -side * thickness, 0.0);
    const auto spoke = [&](int k, double r) {
      const double angle = 2.0 * std::numbers::pi * k / segments;
      return Vector3d(r * std::cos(angle), 0.0, r * std::sin(angle));
    };
    for (int k = 0; k < segments; ++k) {
      const Vector3d a = hub + spoke(k, radius);
      const Vector3d b = hub + spoke(k + 1, radius);
      const Vector3d c = hub + spoke(k, 0.6 * radius);
      const Vector3d d = hub + spoke(k + 1, 0.6 * radius);
      const bool left = side > 0.0;
      // Seen from outside, angles on the left side run clockwise.
      left ? quad(b, a, c, d, tyre) : quad(a, b, d, c, tyre);
      left ? triangle(d, c, hub, rim) : triangle(c, d, hub, rim);
      left ? quad(a, b, b + inwards, a + inwards, tyre)
           : quad(b, a, a + inwards, b + inwards, tyre);
    }
  }

  double rear_;
  double length_;
  double halfWidth_;
  double ground_;
  double height_;
  Vector3f paint_;
  std::vector<ShapeTriangle> triangles_;
};

}  // namespace

Vector3f paintOf(std::size_t vehicle) {
  // Red, blue, amber, sky, black, pine, plum, salmon.
  static const std::array<Vector3f, paintCount> paints = {
      Vector3f(0.86F, 0.14F, 0.13F), Vector3f(0.34F, 0.18F, 0.96F), Vector3f(0.98F, 0.78F, 0.10F),
      Vector3f(0.25F, 0.74F, 0.97F), Vector3f(0.07F, 0.07F, 0.10F), Vector3f(0.15F, 0.36F, 0.31F),
      Vector3f(0.51F, 0.05F, 0.51F), Vector3f(0.98F, 0.54F, 0.49F)};
  return paints[vehicle % paints.size()];
}

std::vector<ShapeTriangle> vehicleShape(const VehicleParameters& vehicle, const Vector3f& paint) {
  return Builder(vehicle, paint).build();
}

std::vector<ShapeTriangle> vehicleShape(const VehicleParameters& vehicle, const Scene& mesh) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& vertex : mesh.vertices) box.extend(vertex);
  const Vector3d shift(
      0.5 * (vehicle.massCentreToFront - vehicle.massCentreToRear) - box.center().x(),
      -box.center().y(), -vehicle.massCentreHeight - box.min().z());
  std::vector<ShapeTriangle> shape;
  shape.reserve(mesh.triangles.size());
  for (const Scene::Triangle& triangle : mesh.triangles) {
    ShapeTriangle placed{{}, mesh.meshes[triangle.mesh].colour};
    for (std::size_t k = 0; k < 3; ++k) placed.corners.at(k) = mesh.corner(triangle, k) + shift;
    shape.push_back(placed);
  }
  return shape;
}

std::vector<ShapeTriangle> vehicleShape(const RecordedVehicle& vehicle, std::size_t index,
                                        const VehicleMeshes& meshes) {
  const auto own = meshes.find(vehicle.name);
  return own == meshes.end() ? vehicleShape(vehicle.parameters, paintOf(index))
                             : vehicleShape(vehicle.parameters, *own->second);
}

}  // namespace bumper::drawing
