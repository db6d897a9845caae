#pragma once

#include <ode/ode.h>

#include <Eigen/Core>

namespace bumper {

/// A trimesh geom of Bumper's in a space of the application's, which may destroy it first: with the
/// space, or by itself. Destroys what remains of it.
///
/// ODE gives no notice when a geom is destroyed, but it detaches the geom from its body. So a
/// second geom is put into the same space, a sphere of radius 0 on a body private to this object:
/// when the body has lost its geom, the space was destroyed. (A geom class of Bumper's own, with a
/// destructor, would be one of the four that a program can have, and end with dCloseODE().) The
/// sphere is disabled and has neither category nor collide bits, so no near callback receives it;
/// it lies within the mesh's bounding box, so it enlarges no space.
class LentGeom {
 public:
  /// `space` may be null; then the geom is assumed to exist. `middle`: of the mesh, world, m;
  /// `place`: of the geom.
  LentGeom(dSpaceID space, dTriMeshDataID data, const Eigen::Vector3d& place,
           const Eigen::Vector3d& middle);
  ~LentGeom();
  LentGeom(const LentGeom&) = delete;
  LentGeom& operator=(const LentGeom&) = delete;
  LentGeom(LentGeom&&) = delete;
  LentGeom& operator=(LentGeom&&) = delete;

  /// Where it is or was.
  [[nodiscard]] dGeomID address() const { return geom_; }
  /// Whether it was destroyed with its space.
  [[nodiscard]] bool wentWithSpace() const;
  /// Whether it still exists. Searches all spaces connected with its own, for it may have been
  /// destroyed by itself. The content of a quadtree space cannot be read: a geom in one is assumed
  /// to exist as long as the space.
  [[nodiscard]] bool exists() const;

 private:
  explicit LentGeom(dTriMeshDataID data) : data_(data) {}

  [[nodiscard]] bool mayBeIn(dSpaceID space) const;

  dTriMeshDataID data_;
  dGeomID geom_ = nullptr;
  dWorldID world_ = nullptr;  // for the body, and never stepped
  dBodyID body_ = nullptr;
};

}  // namespace bumper
