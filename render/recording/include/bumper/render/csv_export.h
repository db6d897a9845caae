#pragma once

#include <cstddef>
#include <filesystem>

#include "bumper/base/api.h"
#include "bumper/render/recording.h"

namespace BUMPER_API bumper {

/// Writes `events.csv`, every field of every impact of the recording, and `trajectory.csv`, the
/// poses of the vehicle with the given index (without vehicles the header alone), into a folder,
/// which is made if it does not exist. Files of these names are replaced.
///
/// World frame and SI units unless a column's name has another: arm_x_m and arm_y_m are in the
/// vehicle's frame, angle_of_attack_deg is by the contact point's velocity, yaw_rad is the heading
/// and goes on beyond ±π without a jump. A field is empty where a number is NaN: not known. Numbers
/// have as many digits as it takes to read the same double back, with a point whatever the locale;
/// names that hold a comma, a quote or a line break stand in quotes, as RFC 4180 has it.
///
/// Throws Error, naming the folder or file, if there is no such vehicle or a file cannot be
/// written; what stood there before is then still whole.
void writeCsv(const Recording& recording, const std::filesystem::path& folder,
              std::size_t vehicle = 0);

}  // namespace bumper
