#pragma once

#include <string>
#include <vector>

#include "case_reference.h"

namespace bumper::benchmark {

/// Median, 99th percentile and largest of an error; what is not finite counts as 1e9.
struct Spread {
  double median = 0.0;
  double p99 = 0.0;
  double max = 0.0;
};
Spread spreadOf(std::vector<double> errors);

/// One setting, scheme, step and wall: a line of accuracy.json.
struct Row {
  Setting setting = Setting::free_flight;
  std::string scheme;
  int wallTriangles = 0;
  double step = 0.0;  ///< s
  std::size_t count = 0;
  Spread deltaV;    ///< relative
  Spread yawRate;   ///< rad/s
  Spread position;  ///< m
  std::size_t gross = 0;
  double energyGain = 0.0;           ///< largest, relative
  double cpuPerSimulatedTime = 0.0;  ///< µs/s
};

/// More than this error of Δv is gross.
inline constexpr double grossError = 0.2;

/// Collects the runs of a row.
class RowMaker {
 public:
  void add(const EndError& error, double energyGain);
  [[nodiscard]] Row row(Setting setting, const std::string& scheme, int wallTriangles,
                        double step) const;

 private:
  std::vector<double> deltaV_;
  std::vector<double> yawRate_;
  std::vector<double> position_;
  double energyGain_ = 0.0;
};

/// Of the cases that do not stand in the rows.
struct Apart {
  std::size_t count = 0;      ///< of all cases of the setting
  std::size_t sensitive = 0;  ///< another number of impacts when moved by 1e-10 m
  std::size_t lasting = 0;    ///< a wall's end pressed on a side and slid along it
};

/// All that a run of the benchmark found.
struct Results {
  std::vector<Row> rows;
  std::vector<Row> lasting;  ///< Bumper's, over the lasting contacts alone
  Apart freeFlight;
  Apart tyres;
  double tyreReferenceError =
      0.0;  ///< of position at the end, m: largest change when its step is halved
  std::size_t solverMessages = 0;  ///< that ODE's solver gave up, over all runs of all schemes
  std::uint64_t seed = 0;
};

}  // namespace bumper::benchmark
