#include "barrier_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
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

// Memory of ODE's tree for each triangle but one, bytes: a box in single precision, two pointers.
constexpr std::size_t treeNodeSize = 6 * sizeof(float) + 2 * sizeof(void*);

// Faces that lean by more than the usual limit, m aside for each m up, and are no larger than this,
// m, are taken one by one: else a barrier would lean everywhere as its flattest face does.
constexpr double usualLean = 0.32;
constexpr double largestFace = 4.0;

// A rectangle in plan around a wall, larger by `more` on all sides, as two walls.
std::pair<Wall, Wall> halvesAround(const Wall& wall, double more) {
  Eigen::Vector2d side = Eigen::Vector2d::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector2d each = (wall.corners[(k + 1) % 3] - wall.corners[k]).head<2>();
    if (each.squaredNorm() > side.squaredNorm()) side = each;
  }
  const Eigen::Vector2d along = side.normalized();
  const Eigen::Vector2d across(-along.y(), along.x());
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector3d& corner : wall.corners) {
    box.extend(Eigen::Vector2d(along.dot(corner.head<2>()), across.dot(corner.head<2>())));
  }
  const auto corner = [&](bool end, bool left) {
    const double x = end ? box.max().x() + more : box.min().x() - more;
    const double y = left ? box.max().y() + more : box.min().y() - more;
    const Eigen::Vector2d place = x * along + y * across;
    return Eigen::Vector3d(place.x(), place.y(), wall.corners[0].z());
  };
  std::pair<Wall, Wall> halves{wall, wall};
  halves.first.corners = {corner(false, false), corner(true, false), corner(true, true)};
  halves.second.corners = {corner(false, false), corner(true, true), corner(false, true)};
  return halves;
}

// The arrays must live as long.
OwnTriMeshData trimeshOf(const std::vector<double>& vertices,
                         const std::vector<dTriIndex>& indices) {
  OwnTriMeshData data(dGeomTriMeshDataCreate());
  dGeomTriMeshDataBuildDouble(data.get(), vertices.data(), 3 * sizeof(double),
                              static_cast<int>(vertices.size() / 3), indices.data(),
                              static_cast<int>(indices.size()), 3 * sizeof(dTriIndex));
  return data;
}

// Only the list of triangles is needed; no contacts are generated.
int noContact(dGeomID /*mesh*/, dGeomID /*box*/, int /*triangle*/) { return 0; }

Scene sceneOf(dGeomID trimesh, const WorldFrame& frame, const std::string& name) {
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
    for (const dVector3& corner : corners) {
      scene.vertices.push_back(frame.vector(toVector(corner)));
    }
    scene.triangles.push_back({.corners = {first, first + 1, first + 2}, .mesh = 0});
  }
  return scene;
}

/// What is known of a triangle, if anything.
template <typename Known>
const Known* find(const std::vector<Known>& sorted, std::size_t triangle) {
  const auto found = std::lower_bound(
      sorted.begin(), sorted.end(), triangle,
      [](const Known& each, std::size_t wanted) { return each.triangle < wanted; });
  return found != sorted.end() && found->triangle == triangle ? &*found : nullptr;
}

}  // namespace

BarrierMesh::BarrierMesh(const Scene& scene, const WorldFrame& frame, const BarrierOptions& options,
                         std::string name)
    : name_(std::move(name)) {
  const Walls selected = selectWalls(scene, options.walls);
  keepWalls(scene, selected);
  // The triangles of the geom are the walls.
  std::size_t wall = 0;
  for (const WallFoot& foot : wallFeet(selected.walls)) {
    while (selected.walls[wall].triangle != foot.triangle) ++wall;
    keepFoot(wall, foot);
  }
  buildMesh();
  lendGeom(frame, options.space);
}

BarrierMesh::BarrierMesh(const Scene& scene, dGeomID geom, bool solid,
                         const BarrierOptions& options, std::string name)
    : name_(std::move(name)), geom_(geom), solid_(solid) {
  keepWalls(scene, selectWalls(scene, options.walls));
  buildMesh();
}

BarrierMesh::BarrierMesh(dGeomID trimesh, const WorldFrame& frame, const BarrierOptions& options,
                         std::string name)
    : name_(std::move(name)), geom_(trimesh) {
  const Scene scene = sceneOf(trimesh, frame, name_);
  // A wall is one from foot to top, also where no outline reaches it.
  WallSelection everywhere = options.walls;
  everywhere.groundReach.reset();
  Walls selected = selectWalls(scene, everywhere);
  keepParts(wallParts(scene, selected));
  dropOutOfReach(scene, options.walls, selected);
  keepWalls(scene, selected);
  for (const WallFoot& foot : wallFeet(scene, selected.walls)) {
    keepFoot(static_cast<std::size_t>(foot.triangle), foot);
  }
  buildMesh();
}

void BarrierMesh::keepParts(const std::vector<WallPart>& parts) {
  for (std::uint32_t i = 0; i < parts.size(); ++i) {
    if (parts[i].kind == WallPart::Kind::none) continue;
    parts_.push_back({.triangle = i,
                      .foot = roundedDown(parts[i].foot),
                      .top = roundedUp(parts[i].top),
                      .kind = parts[i].kind});
  }
  parts_.shrink_to_fit();
}

void BarrierMesh::keepFoot(std::size_t triangle, const WallFoot& foot) {
  feet_.push_back({.triangle = static_cast<std::uint32_t>(triangle),
                   .foot = roundedDown(foot.foot),
                   .top = roundedUp(foot.top)});
}

void BarrierMesh::keepWalls(const Scene& scene, const Walls& selected) {
  if (selected.walls.empty()) {
    throw Error("barrier '" + name_ + "' has no wall: all of its " +
                std::to_string(scene.triangles.size()) +
                " triangles are flatter than WallSelection::maxNormalUp allows, degenerate, or "
                "dropped for another reason that WallSelection gives");
  }
  walls_ = WallTable(selected.walls, scene);
  report_ = selected.report;
  for (const SceneMesh& mesh : scene.meshes) materials_.push_back(mesh.material);
  low_.setConstant(std::numeric_limits<double>::infinity());
  high_ = -low_;
  highestFoot_ = -std::numeric_limits<double>::infinity();
  lowestTop_ = std::numeric_limits<double>::infinity();
  for (const Wall& wall : selected.walls) {
    for (const Eigen::Vector3d& corner : wall.corners) {
      low_ = low_.cwiseMin(corner);
      high_ = high_.cwiseMax(corner);
    }
    highestFoot_ = std::max(highestFoot_, wall.foot);
    lowestTop_ = std::min(lowestTop_, wall.top);
  }
  makePlan(selected.walls);
}

// The line of a face that leans is within the face's own width of it: its footprint is made so much
// larger.
void BarrierMesh::makePlan(std::vector<Wall> walls) {
  const std::size_t count = walls.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d& normal = walls[i].normal;
    const double lean = std::abs(normal.z()) / normal.head<2>().norm();
    if (lean <= std::max(lean_, usualLean)) {
      lean_ = std::max(lean_, lean);
      continue;
    }
    const WallFace face = walls_.face(walls_.faceOf(i));
    const std::optional<Strip> strip = stripOf(face);
    const double width = strip ? strip->width : face.diameter();
    if (width > largestFace) {
      lean_ = lean;
      continue;
    }
    const auto [first, second] = halvesAround(walls[i], width);
    walls[i] = first;
    walls.push_back(second);
  }
  plan_ = WallPlan(walls);
}

void BarrierMesh::buildMesh() {
  feet_.shrink_to_fit();
  // Single precision rounds by 6e-8 of the largest coordinate, in the tree and in the box.
  margin_ = 1e-4 + 1e-6 * (high_ - low_).norm();

  keepFineWalls();
  const std::scoped_lock guard(trimeshLock());
  data_ = trimeshOf(walls_.vertices(), walls_.indices());
  if (!othersIndices_.empty()) othersData_ = trimeshOf(walls_.vertices(), othersIndices_);
  if (fine_.isEmpty() || othersData_) {
    dTriMeshDataID data = fine_.isEmpty() ? data_.get() : othersData_.get();
    queryGeom_.reset(dCreateTriMesh(nullptr, data, nullptr, nullptr, nullptr));
    dGeomTriMeshSetCallback(queryGeom_.get(), &noContact);
    dGeomTriMeshSetArrayCallback(queryGeom_.get(), &collectTriangles);
    const Eigen::Vector3d& origin = walls_.origin();
    dGeomSetPosition(queryGeom_.get(), origin.x(), origin.y(), origin.z());
  }
  report_.memory = memory();
}

void BarrierMesh::keepFineWalls() {
  fine_ = FineWalls(walls_);
  if (fine_.isEmpty()) return;
  for (std::size_t i = 0; i < walls_.size(); ++i) {
    if (fine_.has(i)) continue;
    others_.push_back(static_cast<int>(i));
    for (std::size_t k = 0; k < 3; ++k) othersIndices_.push_back(walls_.indices()[3 * i + k]);
  }
}

// Other bodies collide with it in the world.
void BarrierMesh::lendGeom(const WorldFrame& frame, dSpaceID space) {
  const Eigen::Vector3d middle = frame.vectorInWorld(0.5 * (low_ + high_));
  const Eigen::Vector3d place = frame.vectorInWorld(walls_.origin());
  if (!frame.isUsual()) {
    const std::vector<double>& own = walls_.vertices();
    worldVertices_.resize(own.size());
    for (std::size_t i = 0; i < own.size(); i += 3) {
      const Eigen::Vector3d corner = frame.vectorInWorld({own[i], own[i + 1], own[i + 2]});
      std::copy_n(corner.data(), 3, &worldVertices_[i]);
    }
    const std::scoped_lock guard(trimeshLock());
    worldData_ = trimeshOf(worldVertices_, walls_.indices());
    report_.memory = memory();
  }
  lent_.emplace(space, worldData_ ? worldData_.get() : data_.get(), place, middle);
  geom_ = lent_->address();
}

std::size_t BarrierMesh::memory() const {
  const std::size_t trees = worldData_ ? 2 : 1;
  return walls_.memory() + plan_.memory() + parts_.capacity() * sizeof(Part) +
         feet_.capacity() * sizeof(Foot) + worldVertices_.capacity() * sizeof(double) +
         fine_.memory() + others_.capacity() * sizeof(int) +
         othersIndices_.capacity() * sizeof(dTriIndex) +
         (trees * (walls_.size() - 1) + others_.size()) * treeNodeSize;
}

WallPart BarrierMesh::partOf(int triangle) const {
  const auto index = static_cast<std::size_t>(triangle);
  if (hasWallsOnly()) {
    return {.kind = WallPart::Kind::face, .foot = walls_.foot(index), .top = walls_.top(index)};
  }
  const Part* part = find(parts_, index);
  if (part == nullptr) return {};
  return {.kind = part->kind,
          .foot = static_cast<double>(part->foot),
          .top = static_cast<double>(part->top)};
}

std::optional<WallFoot> BarrierMesh::footOf(int triangle) const {
  const Foot* foot = find(feet_, static_cast<std::size_t>(triangle));
  if (foot == nullptr) return std::nullopt;
  return WallFoot{.triangle = triangle,
                  .foot = static_cast<double>(foot->foot),
                  .top = static_cast<double>(foot->top)};
}

bool BarrierMesh::reaches(const Eigen::Vector3d& centre, double radius) const {
  return ((low_.array() - radius) <= centre.array()).all() &&
         (centre.array() <= (high_.array() + radius)).all();
}

void BarrierMesh::list(dGeomID box, std::vector<int>& walls) const {
  walls.clear();
  if (!queryGeom_) return;
  {
    const std::scoped_lock guard(trimeshLock());
    dGeomSetData(queryGeom_.get(), &walls);
    dContactGeom unused;
    dCollide(box, queryGeom_.get(), 1, &unused, sizeof unused);
  }
  if (fine_.isEmpty()) return;
  for (int& wall : walls) wall = others_[static_cast<std::size_t>(wall)];
}

}  // namespace bumper
