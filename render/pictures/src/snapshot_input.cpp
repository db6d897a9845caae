#include "snapshot_input.h"

#include <algorithm>
#include <string>

#include "bumper/response/error.h"

namespace bumper::drawing {

void checkPixels(int value, int low, const char* name) {
  constexpr int most = 8192;
  if (value >= low && value <= most) return;
  throw Error(std::string(name) + " is " + std::to_string(value) + " pixels: it must lie in " +
              std::to_string(low) + " to " + std::to_string(most));
}

void checkVehicleMeshes(const Recording& recording, const VehicleMeshes& meshes,
                        const std::string& where) {
  for (const auto& [name, mesh] : meshes) {
    std::string what = where;
    what += "::vehicleMeshes: '";
    what += name;
    what += "'";
    if (std::ranges::find(recording.vehicles(), name, &RecordedVehicle::name) ==
        recording.vehicles().end())
      throw Error(what + " is no vehicle of the recording");
    if (mesh == nullptr) throw Error(what + " has no mesh");
    try {
      validate(*mesh);
    } catch (const Error& error) {
      throw Error(what + ": " + error.what());
    }
  }
}

void checkOptions(const Recording& recording, const SnapshotOptions& options) {
  checkPixels(options.width, 160, "SnapshotOptions::width");
  checkPixels(options.height, 120, "SnapshotOptions::height");
  checkVehicleMeshes(recording, options.vehicleMeshes, "SnapshotOptions");
}

}  // namespace bumper::drawing
