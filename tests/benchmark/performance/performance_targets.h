#pragma once

#include <optional>
#include <string>
#include <vector>

#include "performance_run.h"

namespace bumper::benchmark {

/// One of the project's targets, and what was measured.
struct Target {
  std::string target;
  std::string reached;
  std::optional<bool> met{};  ///< nothing: not measured, or no target but a figure beside one
};

std::vector<Target> targetsOf(const Performance& performance);

/// The row of a scene and a scheme; null if there is none.
const QueryRow* rowOf(const Performance& performance, const std::string& scene,
                      const std::string& scheme);

/// A number to two or three digits.
std::string shortNumber(double value);

}  // namespace bumper::benchmark
