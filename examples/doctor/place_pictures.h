#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "examination.h"
#include "worst_places.h"

namespace bumper::doctor {

/// Draws a picture of each place into a folder, which is made if need be: 1_catch.png and so on.
/// The vehicle with contact joints and the one with Bumper where the drive ends, their outlines
/// where it was worst; contact normals, red where they are off by more than 10°, and the walls' own
/// in green. Returns the files. Throws Error as SnapshotRenderer and writePng do.
std::vector<std::string> drawPlaces(const Subject& subject, const Examination& examination,
                                    std::span<const WorstPlace> places,
                                    const std::filesystem::path& folder);

}  // namespace bumper::doctor
