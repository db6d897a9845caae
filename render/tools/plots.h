#pragma once

#include <cstddef>
#include <filesystem>

#include "bumper/render/recording.h"
#include "bumper/response/response_settings.h"
#include "bumper/scenes/scene.h"

namespace bumper::tools {

/// Whether the program gnuplot can be run.
bool havePlotter();

struct PlotOptions {
  std::size_t vehicle = 0;  ///< index in the recording; its impacts alone are shown
  bool sae = false;         ///< signs as the paper has them: SAE J670, z down, y to the right
  double patience = 120.0;  ///< s, up to a week: how long gnuplot may do nothing
};

// Each throws Error, naming the file, if it cannot be written, or if gnuplot fails, tries the
// patience or leaves no picture, with its last words.

// Over time, with the impacts marked:

/// The paper's Figure 7.
void plotYawRate(const Recording& recording, const PlotOptions& options,
                 const std::filesystem::path& png);

void plotSpeed(const Recording& recording, const PlotOptions& options,
               const std::filesystem::path& png);

/// What accelerates the mass centre, along the vehicle's axes: mass × change of velocity from pose
/// to pose, so with tyres and walls together.
void plotForce(const Recording& recording, const PlotOptions& options,
               const std::filesystem::path& png);

/// Each impact's impulse along and across the wall's normal, and their sum so far.
void plotImpulse(const Recording& recording, const PlotOptions& options,
                 const std::filesystem::path& png);

/// The paper's Figure 6: the path with the walls and the outline at every half second.
void plotPath(const Scene& scene, const Recording& recording, const PlotOptions& options,
              const std::filesystem::path& png);

/// The paper's Figure 4, with friction and remaining energy beside restitution.
void plotCurves(const ResponseSettings& settings, const PlotOptions& options,
                const std::filesystem::path& png);

}  // namespace bumper::tools
