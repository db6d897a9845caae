#pragma once

#include <filesystem>
#include <limits>

#include "bumper/base/api.h"
#include "bumper/render/recording.h"
#include "bumper/render/vehicle_meshes.h"
#include "bumper/scenes/scene.h"

namespace BUMPER_API bumper {

/// What an animated GLB file holds.
struct GlbOptions {
  /// m, ≥ 0: what of the scene lies farther than this from the rectangle around all paths, along
  /// the world's axes, is left out, so that a viewer opens with the run in sight. Infinity keeps
  /// all.
  double sceneReach = 120.0;
  /// Keyframes of a vehicle's animation, 1/s, > 0: poses that follow the last kept one more closely
  /// are left out, but not the last of all. Infinity keeps every pose.
  double keysPerSecond = std::numeric_limits<double>::infinity();
  bool showPath = true;           ///< ribbons on the ground, coloured by speed
  bool showImpacts = true;        ///< a pin at each, with an arrow along the wall's normal
  VehicleMeshes vehicleMeshes{};  ///< of the vehicles that are not drawn as a car-like body
};

/// Writes scene, moving vehicles and impacts as one binary glTF 2.0 file that any viewer plays.
///
/// The root node turns z up into glTF's y up and stands in the middle of the run. Below it
/// everything is in the world's axes, relative to that middle, in single precision: within 1.6 km
/// of it to 1e-4 m, wherever in the world it lies. Each vehicle is a node of its own name with
/// one animated translation (mass centre) and rotation for each pose; time 0 is the recording's
/// first pose. A vehicle stands still before its first and after its last pose. Of poses that have
/// the same time in single precision the last counts.
///
/// An impact is a node `impact <number>, <Δv> m/s`, which appears at its time; its extras hold the
/// numbers. Arrows are as long as in a snapshot of the whole run; impacts below a tenth of the
/// hardest's Δv are small balls. The camera `behind <vehicle>` rides with each vehicle.
///
/// Throws Error, naming the file, on an invalid scene or vehicle mesh, an option outside its
/// range, a recording without poses, more than 4 GB, or a file that cannot be written; what stood
/// there before is then still whole.
void writeGlb(const Scene& scene, const Recording& recording, const std::filesystem::path& file,
              const GlbOptions& options = {});

}  // namespace bumper
