#include "barrier.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "bumper/response/error.h"
#include "geom_class.h"
#include "geom_shape.h"
#include "ode_vectors.h"

namespace bumper {

namespace {

// A contact whose normal is steeper than this is one with a top.
constexpr double capNormal = 0.7;

// Upright enough for a post?
bool isUpright(dGeomID capsule, const WorldFrame& frame, double maxNormalUp) {
  const Eigen::Vector3d axis = frame.direction(toMatrix(dGeomGetRotation(capsule)).col(2));
  return axis.head<2>().norm() <= maxNormalUp;
}

// What is to be done about a geom whose walls ODE does not tell.
[[noreturn]] void refuse(dGeomID geom) {
  const std::string what = std::string("addBarrier: the geom is ") + classNameOf(geom);
  switch (dGeomGetClass(geom)) {
    case dRayClass:
      throw Error(what + ", which nothing bumps into");
    case dGeomTransformClass:
      throw Error(what + ": place the geom in it with dGeomSetPosition, and add that one");
    default:
      throw Error(what +
                  ", whose shape ODE does not tell: give its faces as a scene, addBarrier(scene, "
                  "{.geom = geom}); a trimesh, box, plane, cylinder, capsule or sphere can be a "
                  "barrier as it is");
  }
}

// The sides of a box, wound so that their normals point outwards.
Scene sceneOfBox(dGeomID box, const WorldFrame& frame, const std::string& name) {
  dVector3 lengths;
  dGeomBoxGetLengths(box, lengths);
  const Eigen::Vector3d half = 0.5 * toVector(lengths);
  const Eigen::Vector3d place = toVector(dGeomGetPosition(box));
  const Eigen::Matrix3d axes = toMatrix(dGeomGetRotation(box));
  Scene scene;
  scene.name = name;
  scene.meshes.push_back({.name = name, .material = "", .colour = {0.7F, 0.7F, 0.7F}});
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d corner((i & 1) != 0 ? half.x() : -half.x(),
                                 (i & 2) != 0 ? half.y() : -half.y(),
                                 (i & 4) != 0 ? half.z() : -half.z());
    scene.vertices.emplace_back(frame.vector(place + axes * corner));
  }
  constexpr std::array<std::array<std::uint32_t, 4>, 6> sides = {
      {{1, 3, 7, 5}, {2, 0, 4, 6}, {3, 2, 6, 7}, {0, 1, 5, 4}, {4, 5, 7, 6}, {2, 3, 1, 0}}};
  for (const auto& side : sides) {
    scene.triangles.push_back({.corners = {side[0], side[1], side[2]}, .mesh = 0});
    scene.triangles.push_back({.corners = {side[0], side[2], side[3]}, .mesh = 0});
  }
  return scene;
}

// A capsule that leans or lies, as rings of corners around its axis, wound likewise. The corners
// lie on it, some of them where it is widest seen from above.
Scene sceneOfCapsule(dGeomID capsule, const WorldFrame& frame, const std::string& name) {
  constexpr std::uint32_t around = 24;
  constexpr int ringsOfEnd = 6;
  dReal radius = 0.0;
  dReal length = 0.0;
  dGeomCapsuleGetParams(capsule, &radius, &length);
  const Eigen::Vector3d place = toVector(dGeomGetPosition(capsule));
  const Eigen::Vector3d axis = toMatrix(dGeomGetRotation(capsule)).col(2);
  const Eigen::Vector3d up = frame.directionInWorld(Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d aside = up.cross(axis).normalized();
  const Eigen::Vector3d above = axis.cross(aside);
  Scene scene;
  scene.name = name;
  scene.meshes.push_back({.name = name, .material = "", .colour = {0.7F, 0.7F, 0.7F}});
  const auto addRing = [&](double along, double wide) {
    for (std::uint32_t i = 0; i < around; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / around;
      scene.vertices.push_back(frame.vector(
          place + along * axis + wide * (std::cos(angle) * aside + std::sin(angle) * above)));
    }
  };
  for (const double end : {-1.0, 1.0}) {
    for (int i = 0; i < ringsOfEnd; ++i) {
      const int ring = end < 0.0 ? i - ringsOfEnd + 1 : i;
      const double angle = 0.5 * std::numbers::pi * ring / ringsOfEnd;
      addRing(0.5 * end * length + radius * std::sin(angle), radius * std::cos(angle));
    }
  }
  const auto rings = static_cast<std::uint32_t>(scene.vertices.size()) / around;
  for (const double end : {-1.0, 1.0}) {
    scene.vertices.push_back(frame.vector(place + end * (0.5 * length + radius) * axis));
  }
  const std::uint32_t first = around * rings;
  for (std::uint32_t i = 0; i < around; ++i) {
    const std::uint32_t next = (i + 1) % around;
    scene.triangles.push_back({.corners = {first, next, i}, .mesh = 0});
    for (std::uint32_t ring = 0; ring + 1 < rings; ++ring) {
      const std::uint32_t low = around * ring;
      const std::uint32_t high = low + around;
      scene.triangles.push_back({.corners = {low + i, low + next, high + next}, .mesh = 0});
      scene.triangles.push_back({.corners = {low + i, high + next, high + i}, .mesh = 0});
    }
    const std::uint32_t last = around * (rings - 1);
    scene.triangles.push_back({.corners = {last + i, last + next, first + 1}, .mesh = 0});
  }
  return scene;
}

}  // namespace

Barrier::Barrier(BarrierId id, const Scene& scene, const WorldFrame& frame,
                 const BarrierOptions& options, std::string name, const ResponseSettings& usual)
    : id_(id), name_(std::move(name)), hasScene_(true) {
  keepOptions(options);
  mesh_.emplace(scene, frame, options, name_);
  keepGeom(mesh_->geom(), frame);
  keepSettings(usual);
}

Barrier::Barrier(BarrierId id, dGeomID geom, const WorldFrame& frame, const BarrierOptions& options,
                 std::string name, const ResponseSettings& usual)
    : id_(id), name_(std::move(name)), hasScene_(false) {
  keepOptions(options);
  switch (dGeomGetClass(geom)) {
    case dTriMeshClass:
      mesh_.emplace(geom, frame, options, name_);
      break;
    case dBoxClass:
      mesh_.emplace(sceneOfBox(geom, frame, name_), geom, true, options, name_);
      break;
    case dCapsuleClass:
      if (!isUpright(geom, frame, options.walls.maxNormalUp)) {
        mesh_.emplace(sceneOfCapsule(geom, frame, name_), geom, true, options, name_);
        break;
      }
      [[fallthrough]];
    case dSphereClass:
    case dPlaneClass:
    case dCylinderClass:
      primitive_.emplace(geom, frame, options.walls.maxNormalUp);
      break;
    default:
      refuse(geom);
  }
  keepGeom(geom, frame);
  keepSettings(usual);
}

Barrier::Barrier(BarrierId id, dGeomID geom, const Scene& shape, const WorldFrame& frame,
                 const BarrierOptions& options, std::string name, const ResponseSettings& usual)
    : id_(id), name_(std::move(name)), hasScene_(true) {
  keepOptions(options);
  mesh_.emplace(shape, geom, dGeomGetClass(geom) == dBoxClass, options, name_);
  keepGeom(geom, frame);
  keepSettings(usual);
}

// The pattern belongs to the caller, and is read again when the walls are.
void Barrier::keepOptions(const BarrierOptions& options) {
  options_ = options;
  scenery_ = options.walls.scenery;
  options_.walls.scenery = scenery_;
}

void Barrier::keepGeom(dGeomID geom, const WorldFrame& frame) {
  geom_ = geom;
  geomClass_ = dGeomGetClass(geom);
  if (geomClass_ == dTriMeshClass) geomData_ = dGeomTriMeshGetTriMeshDataID(geom);
  frame_.emplace(geom, frame);
  up_ = frame.directionInWorld(Eigen::Vector3d::UnitZ());
  shape_ = shapeOf(geom);
  lean_ = leanOf(geom, up_);
}

// A body may turn its geoms, and a scene's walls are as given; what the application itself turns is
// looked at anew.
bool Barrier::hasSameWalls() const {
  if (!isStill(geom_) || shapeOf(geom_) != shape_) return false;
  const bool isCarried = frame_->body() != nullptr || dGeomGetBody(geom_) != nullptr;
  return hasScene_ || isCarried || leanOf(geom_, up_) == lean_;
}

bool Barrier::isStill(dGeomID existing) const {
  return existing == geom_ && dGeomGetClass(existing) == geomClass_ &&
         (geomClass_ != dTriMeshClass || dGeomTriMeshGetTriMeshDataID(existing) == geomData_);
}

void Barrier::keepSettings(const ResponseSettings& usual) {
  usual_ = &usual;
  if (mesh_) report_ = mesh_->report();
  if (primitive_)
    report_ = {.walls = 1, .lowestFoot = primitive_->foot(), .highestTop = primitive_->top()};
  // Number 0, then one for each material that has its own.
  own_.push_back(options_.response.value_or(usual));
  if (options_.response) usual_ = nullptr;
  const std::vector<std::string> materials =
      mesh_ ? mesh_->materials() : std::vector<std::string>{""};
  settingsOfMesh_.assign(materials.size(), 0);
  for (const auto& [material, settings] : options_.materials) {
    const int number = static_cast<int>(own_.size());
    bool known = false;
    for (std::size_t i = 0; i < materials.size(); ++i) {
      if (materials[i] != material) continue;
      settingsOfMesh_[i] = number;
      known = true;
    }
    if (!known) {
      std::string message = "BarrierOptions::materials: barrier '" + name_ + "' has no material '" +
                            material + "'; it has";
      for (const std::string& each : materials) message += " '" + each + "'";
      throw Error(message);
    }
    own_.push_back(settings);
  }
  report_.memory += sizeof(Barrier) + own_.capacity() * sizeof(ResponseSettings);
}

double Barrier::freeUntil(const PlanStrip& strip, double z, double height) const {
  return mesh_ ? mesh_->plan().freeUntil(strip) : primitive_->freeUntil(strip, z, height);
}

bool Barrier::mayComeWithin(const Eigen::Vector3d& place, double radius) const {
  const PlanStrip square{
      .origin = place.head<2>(), .start = -radius, .end = radius, .halfWidth = radius};
  return freeUntil(square, place.z(), radius) < radius;
}

double Barrier::lean() const { return mesh_ ? mesh_->lean() : primitive_->lean(); }

int Barrier::wallCount() const { return mesh_ ? static_cast<int>(mesh_->walls().size()) : 1; }

int Barrier::wallAt(int wall, const Eigen::Vector3d& point) const {
  if (!mesh_) return wall;
  const WallTable& walls = mesh_->walls();
  return static_cast<int>(walls.wallAt(walls.faceOf(static_cast<std::size_t>(wall)), point));
}

const std::string& Barrier::materialOf(int wall) const {
  static const std::string none;
  return mesh_ ? mesh_->materials()[mesh_->meshOf(wall)] : none;
}

int Barrier::triangleOf(int wall) const {
  // A box's triangles are internal to Bumper.
  if (!mesh_ || mesh_->isSolid()) return -1;
  return mesh_->walls().triangle(static_cast<std::size_t>(wall));
}

int Barrier::settingsNumberOf(int wall) const {
  return mesh_ ? settingsOfMesh_[mesh_->meshOf(wall)] : settingsOfMesh_.front();
}

const ResponseSettings& Barrier::settings(int number) const {
  return number == 0 && usual_ != nullptr ? *usual_ : own_[static_cast<std::size_t>(number)];
}

double Barrier::longestPenetrationTime() const {
  double longest = settings(0).penetrationTime;
  for (const ResponseSettings& each : own_) longest = std::max(longest, each.penetrationTime);
  return longest;
}

WallPart Barrier::partAt(int triangle, const Eigen::Vector3d& normal) const {
  if (mesh_ && geomClass_ == dTriMeshClass) return mesh_->partOf(triangle);
  return {.kind = std::abs(normal.z()) > capNormal ? WallPart::Kind::cap : WallPart::Kind::face,
          .foot = report_.lowestFoot,
          .top = report_.highestTop};
}

std::optional<WallFoot> Barrier::footAt(int triangle) const {
  if (!mesh_ || dGeomGetClass(geom_) != dTriMeshClass) return std::nullopt;
  return mesh_->footOf(triangle);
}

bool Barrier::hasWallsOnly() const {
  if (primitive_) return !primitive_->isPost();
  return geomClass_ == dTriMeshClass && mesh_->hasWallsOnly();
}

double Barrier::highestFoot() const { return mesh_ ? mesh_->highestFoot() : primitive_->foot(); }

double Barrier::lowestTop() const { return mesh_ ? mesh_->lowestTop() : primitive_->top(); }

}  // namespace bumper
