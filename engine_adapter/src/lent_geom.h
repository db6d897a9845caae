#pragma once

#include <ode/ode.h>

#include <Eigen/Core>

namespace bumper {

/// A trimesh geom of Bumper's in a space of the application's, which may destroy it first: with the
/// space, or by itself. Destroys what is left of it.
///
/// ODE tells nobody that a geom is gone, but it takes a geom that is destroyed off its body. So a
/// second geom goes into the same space, a sphere without size on a body that only this object
/// knows: a body that has lost its geom has lost it with the space. (A geom class of Bumper's own,
/// with a destructor, would be one of the four that a program can have, and end with dCloseODE().)
/// The sphere is disabled and has neither category nor collide bits, so no space hands it to a near
/// callback; it lies within the mesh's bounding box, so no space has to grow for it.
class LentGeom {
 public:
  /// `space` may be null; then nothing is watched, and the geom is taken to exist. `middle`: of the
  /// mesh, world, m; `place`: of the geom.
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
  /// Whether it is there to be used. Looks through all spaces that hang together with its own, for
  /// it may have been destroyed by itself. A quadtree space does not tell what it holds: what was
  /// put into one is taken to be there as long as the space is.
  [[nodiscard]] bool exists() const;

 private:
  [[nodiscard]] bool mayBeIn(dSpaceID space) const;

  dTriMeshDataID data_;
  dGeomID geom_;
  dWorldID world_ = nullptr;  // for the body, and never stepped
  dBodyID body_ = nullptr;
};

}  // namespace bumper
