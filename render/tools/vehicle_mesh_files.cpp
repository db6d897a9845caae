#include "vehicle_mesh_files.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <numbers>
#include <variant>

#include "bumper/base/printing.h"
#include "bumper/response/error.h"
#include "scene_loading.h"
#include "tool.h"

namespace bumper::tools {

namespace {

std::shared_ptr<const Scene> load(const std::filesystem::path& file, const std::string& up,
                                  double turn) {
  Scene mesh = loadScene(file, "--vehicle-mesh-up", {.up = upAxis(up)});
  const Eigen::AngleAxisd turned(turn * std::numbers::pi / 180.0, Eigen::Vector3d::UnitZ());
  for (Eigen::Vector3d& vertex : mesh.vertices) vertex = turned * vertex;
  return std::make_shared<const Scene>(std::move(mesh));
}

/// Whether an entry is "<vehicle>=<file>".
bool isOf(const std::string& vehicle, const std::string& entry) {
  return entry.starts_with(vehicle + "=");
}

/// Without the vehicle's name.
std::string fileFor(const std::string& vehicle, const std::string& entry) {
  return isOf(vehicle, entry) ? entry.substr(vehicle.size() + 1) : entry;
}

std::string wordOf(const RunParameters& settings, const std::string& name) {
  const auto found = settings.find(name);
  if (found == settings.end()) return "";
  const auto* word = std::get_if<std::string>(&found->second);
  return word != nullptr ? *word : "";
}

double numberOf(const RunParameters& settings, const std::string& name) {
  const auto found = settings.find(name);
  if (found == settings.end()) return 0.0;
  const auto* number = std::get_if<double>(&found->second);
  return number != nullptr ? *number : 0.0;
}

VehicleMeshes asRecorded(const Recording& recording, const std::filesystem::path& folder) {
  VehicleMeshes meshes;
  for (const RecordedVehicle& vehicle : recording.vehicles()) {
    const std::string file = wordOf(vehicle.settings, "mesh");
    if (file.empty()) continue;
    try {
      meshes[vehicle.name] = load(folder / file, wordOf(vehicle.settings, "mesh_up"),
                                  numberOf(vehicle.settings, "mesh_turn_deg"));
    } catch (const Error& error) {
      std::fprintf(stderr, "warning: vehicle '%s' is drawn without its mesh: %s\n",
                   printable(vehicle.name).c_str(), printable(error.what()).c_str());
    }
  }
  return meshes;
}

}  // namespace

void addVehicleMeshOptions(CLI::App& command, VehicleMeshOptions& options) {
  command
      .add_option("--vehicle-mesh", options.files,
                  "mesh file that vehicles are drawn from, x forward; <name>=<file>: only the "
                  "vehicle of that name")
      ->type_name("FILE");
  command.add_option("--vehicle-mesh-up", options.up, "its up axis, for formats that state none")
      ->check(CLI::IsMember({"x", "y", "z"}));
  command
      .add_option("--vehicle-mesh-turn", options.turn,
                  "to the left about the up axis, if its front does not point along x, deg")
      ->check(numberIn(-360.0, 360.0));
}

RunParameters meshSettings(const VehicleMeshOptions& options, const std::string& vehicle,
                           const std::filesystem::path& folder) {
  if (options.files.empty()) return {};
  const std::filesystem::path file = fileFor(vehicle, options.files.back());
  RunParameters settings{
      {"mesh", std::filesystem::proximate(file, std::filesystem::absolute(folder)).string()}};
  if (!options.up.empty()) settings["mesh_up"] = options.up;
  if (options.turn != 0.0) settings["mesh_turn_deg"] = options.turn;
  return settings;
}

VehicleMeshes loadVehicleMeshes(const VehicleMeshOptions& options, const Recording& recording,
                                const std::filesystem::path& folder) {
  if (options.files.empty()) return asRecorded(recording, folder);
  VehicleMeshes meshes;
  for (const std::string& entry : options.files) {
    const auto named = std::ranges::find_if(
        recording.vehicles(),
        [&](const RecordedVehicle& vehicle) { return isOf(vehicle.name, entry); });
    if (named != recording.vehicles().end()) {
      meshes[named->name] = load(fileFor(named->name, entry), options.up, options.turn);
      continue;
    }
    const auto mesh = load(entry, options.up, options.turn);
    for (const RecordedVehicle& vehicle : recording.vehicles()) meshes[vehicle.name] = mesh;
  }
  return meshes;
}

}  // namespace bumper::tools
