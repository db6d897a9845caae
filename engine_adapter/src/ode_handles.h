#pragma once

#include <ode/ode.h>

#include <memory>

namespace bumper {

struct OdeDeleter {
  void operator()(dGeomID geom) const { dGeomDestroy(geom); }
  void operator()(dTriMeshDataID data) const { dGeomTriMeshDataDestroy(data); }
  void operator()(dJointGroupID group) const { dJointGroupDestroy(group); }
};

// Things of ODE's that have one owner.
using OwnGeom = std::unique_ptr<dxGeom, OdeDeleter>;
using OwnTriMeshData = std::unique_ptr<dxTriMeshData, OdeDeleter>;
using OwnJointGroup = std::unique_ptr<dxJointGroup, OdeDeleter>;

}  // namespace bumper
