#pragma once

#include <string>

#include "bumper/render/recording.h"
#include "bumper/render/snapshot.h"

namespace bumper::drawing {

/// Throws Error, beginning with `where`, if a mesh is invalid or of no vehicle.
void checkVehicleMeshes(const Recording& recording, const VehicleMeshes& meshes,
                        const std::string& where);

/// Throws Error if the size lies outside its range, or a vehicle mesh is invalid or of no vehicle.
void checkOptions(const Recording& recording, const SnapshotOptions& options);

}  // namespace bumper::drawing
