#pragma once

#include <optional>
#include <span>
#include <string>

#include "bumper/render/recording.h"

namespace bumper {

// What a recording requires, in memory and in a file. Each throws Error.

/// Returns the vehicle as it is kept, without poses. Throws if the name is taken by one of the
/// others, or a parameter is not finite and positive.
RecordedVehicle checkedVehicle(std::string name, const VehicleParameters& parameters,
                               RunParameters settings, std::span<const RecordedVehicle> others);

/// Throws unless there is a vehicle of that index.
void checkIndex(std::size_t vehicle, std::size_t count);

/// Returns the pose as it is kept: its orientation of unit length, unchanged if it is so already.
/// `last` is the time of the vehicle's last pose.
RecordedPose checkedPose(const RecordedPose& pose, const std::string& vehicle,
                         std::optional<double> last);

/// The index of the vehicle that the event names.
std::size_t vehicleOf(const ImpactEvent& event, std::span<const RecordedVehicle> vehicles);

/// `last` is the time of the vehicle's last impact.
void checkImpact(const ImpactEvent& event, std::optional<double> last);

}  // namespace bumper
