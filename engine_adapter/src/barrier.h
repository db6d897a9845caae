#pragma once

#include <ode/ode.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "barrier_frame.h"
#include "barrier_mesh.h"
#include "bumper/engine_adapter/barrier.h"
#include "primitive_wall.h"
#include "world_frame.h"

namespace bumper {

/// The barrier of a BarrierId: triangles, or a plane or cylinder of ODE's.
class Barrier {
 public:
  /// A scene, as a new geom. Scenes are in the frame's own axes, metres.
  Barrier(BarrierId id, const Scene& scene, const WorldFrame& frame, const BarrierOptions& options,
          std::string name, const ResponseSettings& usual);
  /// A geom of the application's: trimesh, box, plane or cylinder.
  Barrier(BarrierId id, dGeomID geom, const WorldFrame& frame, const BarrierOptions& options,
          std::string name, const ResponseSettings& usual);
  /// A geom of the application's whose shape is given as a scene.
  Barrier(BarrierId id, dGeomID geom, const Scene& shape, const WorldFrame& frame,
          const BarrierOptions& options, std::string name, const ResponseSettings& usual);
  ~Barrier() = default;
  Barrier(const Barrier&) = delete;
  Barrier& operator=(const Barrier&) = delete;
  Barrier(Barrier&&) = delete;
  Barrier& operator=(Barrier&&) = delete;

  [[nodiscard]] BarrierId id() const { return id_; }
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const BarrierOptions& options() const { return options_; }
  /// May be gone.
  [[nodiscard]] dGeomID geom() const { return geom_; }
  /// Whether a geom that has the address geom() is still that one, and not another in its place.
  [[nodiscard]] bool isStill(dGeomID existing) const;
  /// Where its walls are now. Everything below that has a place is in this frame.
  [[nodiscard]] const BarrierFrame& frame() const { return *frame_; }
  [[nodiscard]] BarrierFrame& frame() { return *frame_; }
  /// The walls that were read are the geom's, whatever its place.
  [[nodiscard]] bool hasSameWalls() const;
  /// Whether its walls are given by a scene, not the geom.
  [[nodiscard]] bool hasScene() const { return hasScene_; }
  [[nodiscard]] const WallReport& report() const { return report_; }

  /// Null for a plane or cylinder.
  [[nodiscard]] const BarrierMesh* mesh() const { return mesh_ ? &*mesh_ : nullptr; }
  /// Null for triangles.
  [[nodiscard]] const PrimitiveWall* primitive() const {
    return primitive_ ? &*primitive_ : nullptr;
  }

  /// How far along its middle line a strip is free of walls, m, as in WallPlan::freeUntil(); of a
  /// plane or post within `height` above and below `z`, m.
  [[nodiscard]] double freeUntil(const PlanStrip& strip, double z, double height) const;
  /// False: certainly no wall comes within `radius` of a place, m.
  [[nodiscard]] bool mayComeWithin(const Eigen::Vector3d& place, double radius) const;
  /// How far walls that freeUntil() takes as they are lean from the vertical at most: m aside for
  /// each m up.
  [[nodiscard]] double lean() const;

  [[nodiscard]] int wallCount() const;
  /// Of the walls that make one face with a wall the one at a point, m.
  [[nodiscard]] int wallAt(int wall, const Eigen::Vector3d& point) const;
  [[nodiscard]] const std::string& materialOf(int wall) const;
  [[nodiscard]] int triangleOf(int wall) const;  ///< −1 if the geom has none

  /// The number of a wall's settings; the barrier's usual ones are number 0.
  [[nodiscard]] int settingsNumberOf(int wall) const;
  [[nodiscard]] const ResponseSettings& settings(int number) const;
  [[nodiscard]] int settingsCount() const { return static_cast<int>(own_.size()); }
  [[nodiscard]] double longestPenetrationTime() const;

  /// Classifies a contact of geom() with something else: the number of the triangle or −1, and the
  /// contact's normal.
  [[nodiscard]] WallPart partAt(int triangle, const Eigen::Vector3d& normal) const;
  /// The walls whose foot such a triangle is, if any.
  [[nodiscard]] std::optional<WallFoot> footAt(int triangle) const;
  /// Every contact of geom() is one with a wall's face.
  [[nodiscard]] bool hasWallsOnly() const;
  /// The highest foot and the lowest top of all walls, m.
  [[nodiscard]] double highestFoot() const;
  [[nodiscard]] double lowestTop() const;

 private:
  void keepOptions(const BarrierOptions& options);
  void keepGeom(dGeomID geom, const WorldFrame& frame);
  void keepSettings(const ResponseSettings& usual);

  BarrierId id_;
  std::string name_;
  BarrierOptions options_;
  std::string scenery_;  // what options_ refers to
  bool hasScene_;
  dGeomID geom_ = nullptr;
  int geomClass_ = dTriMeshClass;
  dTriMeshDataID geomData_ = nullptr;  // of a trimesh
  WallReport report_;
  std::optional<BarrierFrame> frame_;
  Eigen::Vector3d up_ = Eigen::Vector3d::UnitZ();  // in the ODE world's axes
  // Of the geom when its walls were read, as check sums.
  std::uint64_t shape_ = 0;
  std::uint64_t lean_ = 0;
  std::optional<BarrierMesh> mesh_;
  std::optional<PrimitiveWall> primitive_;
  // Barriers that follow the responder's settings form one wall where they meet: number 0 is then
  // the responder's own object, not a copy.
  const ResponseSettings* usual_ = nullptr;
  std::vector<ResponseSettings> own_;
  std::vector<int> settingsOfMesh_;
};

}  // namespace bumper
