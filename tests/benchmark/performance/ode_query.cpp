#include "ode_query.h"

#include "scenes.h"

namespace bumper::benchmark {

OdeQuery::OdeQuery(const Scene& scene) {
  vertices_.reserve(3 * scene.vertices.size());
  for (const Eigen::Vector3d& vertex : scene.vertices) {
    vertices_.insert(vertices_.end(), {vertex.x(), vertex.y(), vertex.z()});
  }
  indices_.reserve(3 * scene.triangles.size());
  for (const Scene::Triangle& triangle : scene.triangles) {
    indices_.insert(indices_.end(),
                    {triangle.corners[0], triangle.corners[1], triangle.corners[2]});
  }
  data_ = dGeomTriMeshDataCreate();
  dGeomTriMeshDataBuildDouble(data_, vertices_.data(), 3 * sizeof(double),
                              static_cast<int>(scene.vertices.size()), indices_.data(),
                              static_cast<int>(indices_.size()), 3 * sizeof(dTriIndex));
  mesh_ = dCreateTriMesh(nullptr, data_, nullptr, nullptr, nullptr);
  const VehicleParameters car = queryCar();
  box_ = dCreateBox(nullptr, car.massCentreToFront + car.massCentreToRear, car.width,
                    bandTop - bandBottom);
}

OdeQuery::~OdeQuery() {
  dGeomDestroy(box_);
  dGeomDestroy(mesh_);
  dGeomTriMeshDataDestroy(data_);
}

void OdeQuery::moveTo(const Pose& pose) {
  const PlanPlace& place = pose.place;
  const dMatrix3 rotation = {place.cosine, -place.sine, 0.0, 0.0, place.sine, place.cosine,
                             0.0,          0.0,         0.0, 0.0, 1.0,        0.0};
  dGeomSetPosition(box_, place.position.x(), place.position.y(), 0.5 * (bandBottom + bandTop));
  dGeomSetRotation(box_, rotation);
}

}  // namespace bumper::benchmark
