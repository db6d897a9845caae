#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "scenes.h"

namespace bumper::benchmark {

/// A figure that was not measured.
inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// What a scheme's queries cost on a scene.
struct QueryRow {
  std::string scene;
  std::size_t triangles = 0;
  std::string scheme;
  std::array<double, 3> nanoseconds{unknown, unknown, unknown};   ///< per query, by nearness
  double pathMean = unknown;                                      ///< over the whole drive, ns
  double buildTime = unknown;                                     ///< ms
  double memory = unknown;                                        ///< kept after building, MB
  std::array<double, 3> instructions{unknown, unknown, unknown};  ///< per query, by nearness
  double foundTouching = 0.0;  ///< share of the touching poses at which it finds something
  double foundFar = 0.0;       ///< … and of the far ones
};

struct QueryOptions {
  std::size_t poses = 20000;
  int repetitions = 7;
  int builds = 5;
  double budget = 80.0;  ///< ms of one repetition of one scheme: a slow one skips poses
};

/// How the poses of a scene's drive are shared out.
struct DriveShares {
  std::string scene;
  std::array<double, 3> shares{};  ///< of the poses, by nearness
};

struct QueryMeasurement {
  std::vector<QueryRow> rows;
  DriveShares drive;
};

/// Measures schemes on one scene in turn, over the same drive. "bumper_teleport" is "bumper" with
/// the poses in no order.
QueryMeasurement measureQueries(const NamedScene& scene, const std::vector<std::string>& schemes,
                                const QueryOptions& options);

}  // namespace bumper::benchmark
