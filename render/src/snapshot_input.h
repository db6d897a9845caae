#pragma once

#include "bumper/render/recording.h"
#include "bumper/render/snapshot.h"

namespace bumper::drawing {

/// Throws Error if the size lies outside its range, or a vehicle mesh is invalid or of no vehicle.
void checkOptions(const Recording& recording, const SnapshotOptions& options);

}  // namespace bumper::drawing
