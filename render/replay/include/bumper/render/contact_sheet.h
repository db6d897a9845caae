#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bumper/base/api.h"
#include "bumper/render/image.h"
#include "bumper/render/recording.h"
#include "bumper/render/vehicle_meshes.h"
#include "bumper/scenes/scene.h"

namespace BUMPER_API bumper {

struct ContactSheetOptions {
  int pictureWidth = 420;   ///< pixels, 160 to 2000
  int pictureHeight = 280;  ///< pixels, 120 to 2000
  std::size_t impacts = 8;  ///< rows at most, 1 to 40: those with the largest Δv
  /// s from the impact, ascending, 1 to 12 of them: one picture each.
  std::vector<double> instants{-0.15, 0.0, 0.15, 0.4};
  std::string title{};            ///< empty: the scene's name
  VehicleMeshes vehicleMeshes{};  ///< of the vehicles that are not drawn as a car-like body
};

/// One picture of the whole run: on top the run from above, below it a row for each impact,
/// in the order of time, with its number, time, Δv, speeds and yaw rates, of both if two
/// vehicles hit each other, and pictures of them at instants around it, from where least is hidden.
/// An impact within 0.3 s of a harder one of the same vehicle is named in that one's row instead.
/// Earlier instants are ghosts. Where the run has not begun or is over, a place is empty.
///
/// Throws Error on an invalid scene, an option outside its range, a recording without poses, a
/// sheet larger than Image::maxSide, or if the driver fails.
Image contactSheet(const Scene& scene, const Recording& recording,
                   const ContactSheetOptions& options = {});

}  // namespace bumper
