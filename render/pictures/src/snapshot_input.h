#pragma once

#include <string>

#include "bumper/base/api.h"
#include "bumper/render/recording.h"
#include "bumper/render/snapshot.h"

namespace BUMPER_INTERNAL bumper {
namespace drawing {

/// Throws Error unless a picture's width or height, which `name` says, lies in `low` to 8192
/// pixels.
void checkPixels(int value, int low, const char* name);

/// Throws Error, beginning with `where`, if a mesh is invalid or of no vehicle.
void checkVehicleMeshes(const Recording& recording, const VehicleMeshes& meshes,
                        const std::string& where);

/// Throws Error if the size lies outside its range, or a vehicle mesh is invalid or of no vehicle.
void checkOptions(const Recording& recording, const SnapshotOptions& options);

}  // namespace drawing
}  // namespace bumper
