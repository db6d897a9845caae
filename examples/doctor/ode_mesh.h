#pragma once

#include <ode/ode.h>

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace bumper::doctor {

/// A trimesh of ODE's in no space, as a plain application makes one.
class OdeMesh {
 public:
  /// Space for `triangles` is reserved.
  explicit OdeMesh(std::size_t triangles);
  ~OdeMesh();
  OdeMesh(const OdeMesh&) = delete;
  OdeMesh& operator=(const OdeMesh&) = delete;
  OdeMesh(OdeMesh&&) = delete;
  OdeMesh& operator=(OdeMesh&&) = delete;

  void add(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);
  /// After the last triangle.
  void build();
  /// Null before build(), and if there is no triangle.
  [[nodiscard]] dGeomID geom() const { return geom_; }

 private:
  std::vector<double> corners_;
  std::vector<dTriIndex> indices_;
  dTriMeshDataID data_ = nullptr;
  dGeomID geom_ = nullptr;
};

}  // namespace bumper::doctor
