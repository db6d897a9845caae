#pragma once

#include <memory>

#include "schemes.h"

namespace bumper::benchmark {

/// What an ODE program without Bumper's geometry can do: the law and the force pulse of Bumper at
/// the depth-weighted mean of dCollide's contacts of the outline with the wall, once in a step.
std::unique_ptr<Scheme> makeMeanContactScheme(Setting setting, int triangles);

}  // namespace bumper::benchmark
