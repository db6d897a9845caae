#pragma once

#include <ode/ode.h>

namespace bumper {

/// ODE's name for the class of a geom, with its article: "a sphere".
const char* classNameOf(dGeomID geom);

}  // namespace bumper
