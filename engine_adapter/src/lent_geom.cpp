#include "lent_geom.h"

namespace bumper {

namespace {

dSpaceID asSpace(dGeomID geom) { return reinterpret_cast<dSpaceID>(geom); }
dGeomID asGeom(dSpaceID space) { return reinterpret_cast<dGeomID>(space); }

}  // namespace

// Built upon an object that owns nothing yet: if memory runs out, the destructor takes away what
// there is.
LentGeom::LentGeom(dSpaceID space, dTriMeshDataID data, const Eigen::Vector3d& place,
                   const Eigen::Vector3d& middle)
    : LentGeom(data) {
  geom_ = dCreateTriMesh(space, data, nullptr, nullptr, nullptr);
  dGeomSetPosition(geom_, place.x(), place.y(), place.z());
  if (space == nullptr) return;
  world_ = dWorldCreate();
  body_ = dBodyCreate(world_);
  dBodySetPosition(body_, middle.x(), middle.y(), middle.z());
  const dGeomID watcher = dCreateSphere(nullptr, 0.0);
  dGeomSetBody(watcher, body_);
  dGeomDisable(watcher);
  dGeomSetCategoryBits(watcher, 0);
  dGeomSetCollideBits(watcher, 0);
  dSpaceAdd(space, watcher);
}

LentGeom::~LentGeom() {
  if (geom_ != nullptr && exists()) dGeomDestroy(geom_);
  if (body_ != nullptr) {
    if (const dGeomID watcher = dBodyGetFirstGeom(body_)) dGeomDestroy(watcher);
  }
  if (world_ != nullptr) dWorldDestroy(world_);
}

bool LentGeom::wentWithSpace() const {
  return body_ != nullptr && dBodyGetFirstGeom(body_) == nullptr;
}

bool LentGeom::exists() const {
  if (body_ == nullptr) return true;
  const dGeomID watcher = dBodyGetFirstGeom(body_);
  if (watcher == nullptr) return false;
  dSpaceID space = dGeomGetSpace(watcher);
  // A space that does not clean up has only detached both.
  if (space == nullptr) return true;
  for (; space != nullptr; space = dGeomGetSpace(asGeom(space))) {
    if (mayBeIn(space)) return true;
  }
  return false;
}

// Compares addresses, for its own may no longer be readable; another geom at the same address has
// other data.
bool LentGeom::mayBeIn(dSpaceID space) const {
  if (dSpaceGetClass(space) == dQuadTreeSpaceClass) return true;
  for (int i = 0; i < dSpaceGetNumGeoms(space); ++i) {
    const dGeomID each = dSpaceGetGeom(space, i);
    if (each == geom_) {
      return dGeomGetClass(each) == dTriMeshClass && dGeomTriMeshGetTriMeshDataID(each) == data_;
    }
    if (dGeomIsSpace(each) != 0 && mayBeIn(asSpace(each))) return true;
  }
  return false;
}

}  // namespace bumper
