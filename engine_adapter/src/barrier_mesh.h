#pragma once

#include <ode/ode.h>

#include <optional>
#include <string>
#include <vector>

#include "bumper/engine_adapter/barrier.h"
#include "bumper/scenes/scene.h"
#include "bumper/scenes/wall_feet.h"
#include "bumper/scenes/wall_parts.h"
#include "bumper/scenes/wall_plan.h"
#include "fine_walls.h"
#include "lent_geom.h"
#include "ode_handles.h"
#include "wall_table.h"
#include "world_frame.h"

namespace bumper {

/// A registered barrier: its walls in double precision, and their trimesh for ODE's collider.
class BarrierMesh {
 public:
  /// A new geom for the scene's walls in options.space.
  BarrierMesh(const Scene& scene, const WorldFrame& frame, const BarrierOptions& options,
              std::string name);
  /// The walls of the application's geom, of any class, as a scene; `solid` as isSolid().
  BarrierMesh(const Scene& scene, dGeomID geom, bool solid, const BarrierOptions& options,
              std::string name);
  /// The walls of the application's trimesh.
  BarrierMesh(dGeomID trimesh, const WorldFrame& frame, const BarrierOptions& options,
              std::string name);
  ~BarrierMesh() = default;
  BarrierMesh(const BarrierMesh&) = delete;
  BarrierMesh& operator=(const BarrierMesh&) = delete;
  BarrierMesh(BarrierMesh&&) = delete;
  BarrierMesh& operator=(BarrierMesh&&) = delete;

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const WallTable& walls() const { return walls_; }
  [[nodiscard]] const WallReport& report() const { return report_; }
  /// The geom in the application's contacts; it may be destroyed.
  [[nodiscard]] dGeomID geom() const { return geom_; }
  /// The same if it is Bumper's; null if it is the application's own.
  [[nodiscard]] const LentGeom* lentGeom() const { return lent_ ? &*lent_ : nullptr; }
  /// The materials of the scene's meshes, and which of them a wall belongs to.
  [[nodiscard]] const std::vector<std::string>& materials() const { return materials_; }
  [[nodiscard]] std::size_t meshOf(int wall) const {
    return walls_.meshOf(static_cast<std::size_t>(wall));
  }
  /// The part of the walls that a triangle of geom() is; geom() must be a trimesh.
  [[nodiscard]] WallPart partOf(int triangle) const;
  /// The walls whose foot a triangle of geom() is, if any; likewise.
  [[nodiscard]] std::optional<WallFoot> footOf(int triangle) const;
  [[nodiscard]] bool hasWallsOnly() const { return parts_.empty() && !solid_; }
  /// The walls enclose a solid; their normals point outwards.
  [[nodiscard]] bool isSolid() const { return solid_; }
  /// The highest foot and the lowest top of all walls, m.
  [[nodiscard]] double highestFoot() const { return highestFoot_; }
  [[nodiscard]] double lowestTop() const { return lowestTop_; }

  /// Whether a sphere reaches the walls' bounding box.
  [[nodiscard]] bool reaches(const Eigen::Vector3d& centre, double radius) const;

  /// The walls from above, those that lean far with room around them.
  [[nodiscard]] const WallPlan& plan() const { return plan_; }
  /// How far the other walls lean from the vertical at most: m aside for each m up.
  [[nodiscard]] double lean() const { return lean_; }

  /// Those that list() leaves out.
  [[nodiscard]] const FineWalls& fineWalls() const { return fine_; }
  /// Fills `walls` with the indices of those that ODE's collider finds at the box. The collider
  /// works in single precision: make the box larger by margin() on every side.
  void list(dGeomID box, std::vector<int>& walls) const;
  [[nodiscard]] double margin() const { return margin_; }

 private:
  // What a triangle of geom() is that has to do with a wall.
  struct Part {
    std::uint32_t triangle;
    float foot;
    float top;
    WallPart::Kind kind;
  };

  // One that is the foot of walls, and their heights.
  struct Foot {
    std::uint32_t triangle;
    float foot;
    float top;
  };

  void keepParts(const std::vector<WallPart>& parts);
  void keepFoot(std::size_t triangle, const WallFoot& foot);
  void keepWalls(const Scene& scene, const Walls& selected);
  void makePlan(std::vector<Wall> walls);
  void buildMesh();
  void keepFineWalls();
  void lendGeom(const WorldFrame& frame, dSpaceID space);
  [[nodiscard]] std::size_t memory() const;

  std::string name_;
  WallTable walls_;
  FineWalls fine_;
  // Of the walls that are not fine, if some are: their numbers and indices.
  std::vector<int> others_;
  std::vector<dTriIndex> othersIndices_;
  WallPlan plan_;
  WallReport report_;
  std::vector<std::string> materials_;
  std::vector<Part> parts_;  // by triangle; empty: geom() holds walls only
  std::vector<Foot> feet_;   // by triangle
  Eigen::Vector3d low_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d high_ = Eigen::Vector3d::Zero();
  double highestFoot_ = 0.0;
  double lowestTop_ = 0.0;
  double margin_ = 0.0;
  double lean_ = 0.0;

  // Each is destroyed after those that are built on it.
  OwnTriMeshData data_;
  OwnTriMeshData othersData_;
  OwnGeom queryGeom_;  // in no space; carries our callbacks; null if all walls are fine
  // The same walls in the world's axes and unit, if these are not Bumper's: for lent_.
  std::vector<double> worldVertices_;
  OwnTriMeshData worldData_;
  dGeomID geom_ = nullptr;
  std::optional<LentGeom> lent_;
  bool solid_ = false;
};

}  // namespace bumper
