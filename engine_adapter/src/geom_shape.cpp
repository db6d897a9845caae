#include "geom_shape.h"

#include <array>
#include <bit>
#include <cmath>

#include "ode_vectors.h"

namespace bumper {

namespace {

// After Fowler, Noll and Vo, of eight bytes at a time.
class CheckSum {
 public:
  void add(std::uint64_t value) { sum_ = (sum_ ^ value) * 0x100000001B3U; }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  [[nodiscard]] std::uint64_t value() const { return sum_; }

 private:
  std::uint64_t sum_ = 0xCBF29CE484222325U;
};

// ODE keeps a trimesh's vertices in single precision, and tells them in the world: rounded back
// they are what they were, wherever it stands.
void addTriangles(dGeomID trimesh, CheckSum& sum) {
  const Eigen::Vector3d place = toVector(dGeomGetPosition(trimesh));
  const Eigen::Matrix3d axes = toMatrix(dGeomGetRotation(trimesh));
  const int count = dGeomTriMeshGetTriangleCount(trimesh);
  for (int i = 0; i < count; ++i) {
    dVector3 first;
    dVector3 second;
    dVector3 third;
    dGeomTriMeshGetTriangle(trimesh, i, &first, &second, &third);
    for (const dReal* corner : {first, second, third}) {
      const Eigen::Vector3d local = axes.transpose() * (toVector(corner) - place);
      for (int k = 0; k < 3; ++k) sum.add(static_cast<double>(static_cast<float>(local[k])) + 0.0);
    }
  }
}

}  // namespace

std::uint64_t shapeOf(dGeomID geom) {
  CheckSum sum;
  const int kind = dGeomGetClass(geom);
  sum.add(static_cast<std::uint64_t>(kind));
  std::array<dReal, 4> numbers{};
  switch (kind) {
    case dSphereClass:
      numbers[0] = dGeomSphereGetRadius(geom);
      break;
    case dBoxClass:
      dGeomBoxGetLengths(geom, numbers.data());
      break;
    case dCylinderClass:
      dGeomCylinderGetParams(geom, numbers.data(), &numbers[1]);
      break;
    case dCapsuleClass:
      dGeomCapsuleGetParams(geom, numbers.data(), &numbers[1]);
      break;
    case dPlaneClass:
      dGeomPlaneGetParams(geom, numbers.data());
      break;
    case dTriMeshClass:
      addTriangles(geom, sum);
      break;
    default:
      break;
  }
  for (const dReal number : numbers) sum.add(number);
  return sum.value();
}

std::uint64_t leanOf(dGeomID geom, const Eigen::Vector3d& up) {
  CheckSum sum;
  if (dGeomGetClass(geom) == dPlaneClass) return sum.value();
  const Eigen::Vector3d own = toMatrix(dGeomGetRotation(geom)).transpose() * up;
  for (int k = 0; k < 3; ++k) sum.add(std::round(1000.0 * own[k]) + 0.0);
  return sum.value();
}

}  // namespace bumper
