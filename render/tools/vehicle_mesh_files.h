#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "bumper/render/recording.h"
#include "bumper/render/vehicle_meshes.h"

namespace bumper::tools {

/// Which mesh files vehicles are drawn from.
struct VehicleMeshOptions {
  std::vector<std::string> files;  ///< "car=car.glb" of one vehicle, "car.glb" of all
  std::string up;                  ///< "x", "y", "z"; empty: as the files say
  double turn = 0.0;               ///< deg to the left, until the front points along x
};

/// Adds --vehicle-mesh, --vehicle-mesh-up and --vehicle-mesh-turn.
void addVehicleMeshOptions(CLI::App& command, VehicleMeshOptions& options);

/// What a recording in a folder states of its vehicles, so that the mesh is found again when both
/// are moved together: "mesh", a path relative to the folder, "mesh_up" and "mesh_turn_deg".
RunParameters meshSettings(const VehicleMeshOptions& options, const std::string& vehicle,
                           const std::filesystem::path& folder);

/// The meshes that the options name, each read in a process of its own; without any, those that the
/// vehicles' settings name, relative to `folder`. Throws Error, naming the file, if one cannot be
/// read; for those of the settings it warns on standard error instead.
VehicleMeshes loadVehicleMeshes(const VehicleMeshOptions& options, const Recording& recording,
                                const std::filesystem::path& folder);

}  // namespace bumper::tools
