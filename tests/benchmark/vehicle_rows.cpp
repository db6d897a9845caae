#include "vehicle_rows.h"

#include <algorithm>
#include <limits>

namespace bumper::benchmark {

namespace {

/// The least of several repetitions of the same cases, scheme by scheme in turn.
void measureTimes(const VehicleBatch& batch, const std::vector<VehicleScheme>& schemes,
                  const VehicleOptions& options, std::vector<VehicleRow>& rows) {
  const std::size_t timed = std::min(options.timed, batch.cases.size());
  for (const double step : stepSizes) {
    std::vector<double> least(schemes.size(), std::numeric_limits<double>::infinity());
    for (int repetition = 0; repetition < options.repetitions; ++repetition) {
      for (std::size_t s = 0; s < schemes.size(); ++s) {
        double time = 0.0;
        double simulated = 0.0;
        for (std::size_t k = 0; k < timed; ++k) {
          const ReferencedVehicles& one = batch.cases[k];
          const VehicleRun run =
              schemes[s].run({&one.vehicleCase, one.flight.duration, step, false});
          time += run.cpuTime;
          simulated += one.flight.duration;
        }
        least[s] = std::min(least[s], 1e6 * time / simulated);
      }
    }
    for (std::size_t s = 0; s < schemes.size(); ++s) {
      const auto row = std::ranges::find_if(rows, [&](const VehicleRow& each) {
        return each.kind == batch.kind && each.errors.step == step &&
               each.errors.scheme == schemes[s].name;
      });
      if (row != rows.end()) row->errors.cpuPerSimulatedTime = least[s];
    }
  }
}

}  // namespace

EndError errorOf(const ReferencedVehicles& one, const std::vector<PlanarMotion>& end) {
  double change = 0.0;
  for (std::size_t i = 0; i < end.size(); ++i) {
    const Vector2& start = one.vehicleCase.vehicles[i].motion.velocity;
    change = std::max(change, (one.flight.end[i].velocity - start).norm());
  }
  EndError error;
  for (std::size_t i = 0; i < end.size(); ++i) {
    const PlanarMotion& right = one.flight.end[i];
    error.deltaV = std::max(error.deltaV, (end[i].velocity - right.velocity).norm() / change);
    error.yawRate = std::max(error.yawRate, std::abs(end[i].yawRate - right.yawRate));
    error.position = std::max(error.position, (end[i].position - right.position).norm());
  }
  return error;
}

VehicleResults measureVehicles(const VehicleOptions& options,
                               const std::function<void(const std::string&)>& say) {
  VehicleResults results;
  const std::vector<VehicleScheme> all = vehicleSchemes();
  for (const auto& [kind, count] :
       {std::pair{VehicleKind::plain, options.plain}, std::pair{VehicleKind::pair, options.pairs},
        std::pair{VehicleKind::scene, options.scenes}}) {
    const std::string name = nameOf(kind);
    say(name + ": references of " + std::to_string(count) + " cases");
    const VehicleBatch batch =
        makeVehicleBatch(kind, count, options.seed + static_cast<std::uint64_t>(kind));
    results.counts.push_back(
        {kind, batch.cases.size(), batch.tried, batch.sensitive, batch.doubtful});
    // The peers' law is that of the plain cases alone.
    const std::size_t schemeCount = kind == VehicleKind::plain ? all.size() : 1;
    const std::vector<VehicleScheme> schemes(
        all.begin(), all.begin() + static_cast<std::ptrdiff_t>(schemeCount));
    for (const VehicleScheme& scheme : schemes) {
      say(name + ": " + scheme.name);
      for (const double step : stepSizes) {
        RowMaker row;
        for (const ReferencedVehicles& one : batch.cases) {
          const VehicleRun run = scheme.run({&one.vehicleCase, one.flight.duration, step, true});
          row.add(errorOf(one, run.end), run.energyGain);
        }
        results.rows.push_back({kind, row.row(Setting::free_flight, scheme.name, 0, step)});
      }
    }
    measureTimes(batch, schemes, options, results.rows);
  }
  return results;
}

}  // namespace bumper::benchmark
