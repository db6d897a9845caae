#pragma once

#include <memory>

#include "schemes.h"

namespace bumper::benchmark {

/// Bullet's contact solver on the same impacts: a box in the plane against the same mesh, with the
/// friction and restitution of the case and Bullet's own defaults for the rest (its collision
/// margins too: without them it does worse). Free flight only; single precision, as Debian ships
/// it.
std::unique_ptr<Scheme> makeBulletScheme(int triangles);

}  // namespace bumper::benchmark
