#include "geom_class.h"

namespace bumper {

const char* classNameOf(dGeomID geom) {
  switch (dGeomGetClass(geom)) {
    case dSphereClass:
      return "a sphere";
    case dBoxClass:
      return "a box";
    case dCapsuleClass:
      return "a capsule";
    case dCylinderClass:
      return "a cylinder";
    case dPlaneClass:
      return "a plane";
    case dRayClass:
      return "a ray";
    case dConvexClass:
      return "a convex";
    case dGeomTransformClass:
      return "a geom transform";
    case dTriMeshClass:
      return "a trimesh";
    case dHeightfieldClass:
      return "a heightfield";
    default:
      return dGeomIsSpace(geom) != 0 ? "a space" : "of a class of the application's own";
  }
}

}  // namespace bumper
