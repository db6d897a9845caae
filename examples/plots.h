#pragma once

#include <filesystem>

#include "bumper/render/recording.h"
#include "bumper/response/response_settings.h"
#include "bumper/scenes/scene.h"

namespace bumper::examples {

/// Whether the program gnuplot can be run.
bool havePlotter();

/// The paper's Figure 7: yaw rate over time, in the paper's sign (SAE J670, z down).
void plotYawRate(const Recording& recording, const std::filesystem::path& png);

/// The paper's Figure 6: the path with the walls and the outline at every half second.
void plotTrajectory(const Scene& scene, const Recording& recording,
                    const std::filesystem::path& png);

/// The paper's Figure 4, with friction and remaining energy beside restitution.
void plotCurves(const ResponseSettings& settings, const std::filesystem::path& png);

}  // namespace bumper::examples
