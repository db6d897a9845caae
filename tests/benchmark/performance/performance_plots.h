#pragma once

#include <string>

#include "performance_run.h"

namespace bumper::benchmark {

/// A gnuplot script that draws, where it runs, <stem>_triangles.png and <stem>_vehicles.png: growth
/// with the number of triangles and of vehicles.
std::string plotScript(const Performance& performance, const std::string& stem);

}  // namespace bumper::benchmark
