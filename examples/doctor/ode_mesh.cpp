#include "ode_mesh.h"

#include <numeric>

namespace bumper::doctor {

OdeMesh::OdeMesh(std::size_t triangles) : data_(dGeomTriMeshDataCreate()) {
  corners_.reserve(9 * triangles);
}

OdeMesh::~OdeMesh() {
  if (geom_ != nullptr) dGeomDestroy(geom_);
  dGeomTriMeshDataDestroy(data_);
}

void OdeMesh::add(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  for (const Eigen::Vector3d& corner : {a, b, c})
    corners_.insert(corners_.end(), {corner.x(), corner.y(), corner.z()});
}

void OdeMesh::build() {
  if (corners_.empty()) return;
  indices_.resize(corners_.size() / 3);
  std::iota(indices_.begin(), indices_.end(), dTriIndex{0});
  dGeomTriMeshDataBuildDouble(data_, corners_.data(), 3 * sizeof(double),
                              static_cast<int>(indices_.size()), indices_.data(),
                              static_cast<int>(indices_.size()), 3 * sizeof(dTriIndex));
  geom_ = dCreateTriMesh(nullptr, data_, nullptr, nullptr, nullptr);
}

}  // namespace bumper::doctor
