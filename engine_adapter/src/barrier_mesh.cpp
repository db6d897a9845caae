#include "barrier_mesh.h"

#include <algorithm>
#include <limits>
#include <mutex>
#include <utility>

#include "bumper/engine_adapter/trimesh_lock.h"
#include "bumper/response/error.h"
#include "ode_vectors.h"

namespace bumper {

namespace {

void collectTriangles(dGeomID mesh, dGeomID /*box*/, const int* triangles, int count) {
  auto* found = static_cast<std::vector<int>*>(dGeomGetData(mesh));
  found->insert(found->end(), triangles, triangles + count);
}

// The list of triangles is all that is wanted; no contact need be made of any of them.
int noContact(dGeomID /*mesh*/, dGeomID /*box*/, int /*triangle*/) { return 0; }

Scene sceneOf(dGeomID trimesh, const std::string& name) {
  Scene scene;
  scene.name = name;
  scene.meshes.push_back({.name = name, .material = "", .colour = {0.7F, 0.7F, 0.7F}});
  const int count = dGeomTriMeshGetTriangleCount(trimesh);
  scene.vertices.reserve(3 * static_cast<std::size_t>(count));
  scene.triangles.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    dVector3 corners[3];
    dGeomTriMeshGetTriangle(trimesh, i, &corners[0], &corners[1], &corners[2]);
    const auto first = static_cast<std::uint32_t>(scene.vertices.size());
    for (const dVector3& corner : corners) scene.vertices.push_back(toVector(corner));
    scene.triangles.push_back({.corners = {first, first + 1, first + 2}, .mesh = 0});
  }
  return scene;
}

}  // namespace

BarrierMesh::BarrierMesh(const Scene& scene, const BarrierOptions& options, std::string name,
                         Query query)
    : name_(std::move(name)), ownsGeom_(true) {
  keepWalls(scene, selectWalls(scene, options.walls));
  buildMesh(query);
  const Eigen::Vector3d middle = 0.5 * (low_ + high_);
  geom_ = dCreateTriMesh(options.space, data_, nullptr, nullptr, nullptr);
  dGeomSetPosition(geom_, middle.x(), middle.y(), middle.z());
}

BarrierMesh::BarrierMesh(const Scene& scene, dGeomID geom, const BarrierOptions& options,
                         std::string name, Query query)
    : name_(std::move(name)), geom_(geom), solid_(dGeomGetClass(geom) == dBoxClass) {
  keepWalls(scene, selectWalls(scene, options.walls));
  buildMesh(query);
}

BarrierMesh::BarrierMesh(dGeomID trimesh, const BarrierOptions& options, std::string name,
                         Query query)
    : name_(std::move(name)), geom_(trimesh) {
  const Scene scene = sceneOf(trimesh, name_);
  Walls selected = selectWalls(scene, options.walls);
  parts_ = wallParts(scene, selected);
  keepWalls(scene, std::move(selected));
  buildMesh(query);
}

BarrierMesh::~BarrierMesh() {
  if (ownsGeom_) dGeomDestroy(geom_);
  dGeomDestroy(queryGeom_);
  dGeomTriMeshDataDestroy(data_);
}

void BarrierMesh::keepWalls(const Scene& scene, Walls selected) {
  if (selected.walls.empty()) {
    throw Error("barrier '" + name_ + "' has no wall: all of its " +
                std::to_string(scene.triangles.size()) +
                " triangles are flatter than WallSelection::maxNormalUp allows, or degenerate");
  }
  walls_ = std::move(selected.walls);
  clearance_ = ClearanceMap(walls_);
  report_ = selected.report;
  for (const SceneMesh& mesh : scene.meshes) materials_.push_back(mesh.material);
  low_.setConstant(std::numeric_limits<double>::infinity());
  high_ = -low_;
  highestFoot_ = -std::numeric_limits<double>::infinity();
  lowestTop_ = std::numeric_limits<double>::infinity();
  for (const Wall& wall : walls_) {
    meshOfWall_.push_back(
        static_cast<int>(scene.triangles[static_cast<std::size_t>(wall.triangle)].mesh));
    for (const Eigen::Vector3d& corner : wall.corners) {
      low_ = low_.cwiseMin(corner);
      high_ = high_.cwiseMax(corner);
    }
    highestFoot_ = std::max(highestFoot_, wall.foot);
    lowestTop_ = std::min(lowestTop_, wall.top);
  }
}

void BarrierMesh::buildMesh(Query query) {
  const Eigen::Vector3d middle = 0.5 * (low_ + high_);
  for (const Wall& wall : walls_) {
    for (const Eigen::Vector3d& corner : wall.corners) {
      const Eigen::Vector3d local = corner - middle;
      indices_.push_back(static_cast<dTriIndex>(vertices_.size() / 3));
      vertices_.insert(vertices_.end(), {local.x(), local.y(), local.z()});
    }
  }
  // Single precision rounds by 6e-8 of the largest coordinate, in the tree and in the box.
  margin_ = 1e-4 + 1e-6 * (high_ - low_).norm();

  const std::scoped_lock guard(trimeshLock());
  data_ = dGeomTriMeshDataCreate();
  dGeomTriMeshDataBuildDouble(data_, vertices_.data(), 3 * sizeof(double),
                              static_cast<int>(vertices_.size() / 3), indices_.data(),
                              static_cast<int>(indices_.size()), 3 * sizeof(dTriIndex));
  queryGeom_ = dCreateTriMesh(nullptr, data_, nullptr, nullptr, nullptr);
  if (query == Query::list_triangles) {
    dGeomTriMeshSetCallback(queryGeom_, &noContact);
    dGeomTriMeshSetArrayCallback(queryGeom_, &collectTriangles);
  }
  dGeomSetPosition(queryGeom_, middle.x(), middle.y(), middle.z());
}

WallPart BarrierMesh::partOf(int triangle) const {
  const auto index = static_cast<std::size_t>(triangle);
  if (!hasWallsOnly()) return parts_[index];
  return {.kind = WallPart::Kind::face, .foot = walls_[index].foot, .top = walls_[index].top};
}

bool BarrierMesh::reaches(const Eigen::Vector3d& centre, double radius) const {
  return ((low_.array() - radius) <= centre.array()).all() &&
         (centre.array() <= (high_.array() + radius)).all();
}

void BarrierMesh::list(dGeomID box, std::vector<int>& walls) const {
  walls.clear();
  const std::scoped_lock guard(trimeshLock());
  dGeomSetData(queryGeom_, &walls);
  dContactGeom unused;
  dCollide(box, queryGeom_, 1, &unused, sizeof unused);
}

int BarrierMesh::contacts(dGeomID box, dContactGeom* contacts, int capacity) const {
  const std::scoped_lock guard(trimeshLock());
  return dCollide(box, queryGeom_, capacity, contacts, sizeof(dContactGeom));
}

}  // namespace bumper
