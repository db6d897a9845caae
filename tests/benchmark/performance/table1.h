#pragma once

#include <string>
#include <vector>

#include "query_rows.h"

namespace bumper::benchmark {

/// A cell of the paper's Table 1: an update of the vehicle, with its tyres, over typical
/// collisions.
struct Table1Row {
  std::string scene;        ///< "test rail", "course" (in random order), "course regrouped"
  std::string law;          ///< "energy", "restitution"
  std::string scheme;       ///< "bumper", "osg_flat" (the paper's way)
  double update = unknown;  ///< µs
  double withoutCollision = unknown;  ///< µs
};

/// The scenes are those of the paper: all of the test rail, of the course the walls alone. The
/// vehicle follows the benchmark's drive through its first swerve.
std::vector<Table1Row> measureTable1(int repetitions);

}  // namespace bumper::benchmark
