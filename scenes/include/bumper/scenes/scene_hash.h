#pragma once

#include <cstdint>

#include "bumper/base/api.h"
#include "bumper/scenes/scene.h"

namespace BUMPER_API bumper {

/// A hash of a scene's geometry, equal for scenes with the same one: FNV-1a of 64 bits over, each
/// in little-endian byte order, the numbers of vertices and of triangles (64 bits), the vertices'
/// coordinates x, y, z (IEEE 754 doubles, −0 as 0), and of each triangle its three corners and its
/// mesh (32 bits each). Names, materials and colours do not count. Not cryptographic.
std::uint64_t contentHash(const Scene& scene);

}  // namespace bumper
