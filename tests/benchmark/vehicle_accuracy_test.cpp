#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <sstream>

#include "../response/random_pairs.h"
#include "ode_world.h"
#include "vehicle_rows.h"

/// Vehicles that hit each other against the reference: the benchmark's claims, over fewer cases.
namespace bumper::benchmark {
namespace {

[[maybe_unused]] const ::testing::Environment* const ode =
    ::testing::AddGlobalTestEnvironment(new tests::OdeEnvironment);

constexpr double bound = 1e-9;  // of Δv, relative, and of the place, m
constexpr double energyRounding = 1e-12;

std::string describe(const VehicleCase& one) {
  std::ostringstream text;
  for (const PairState& vehicle : one.vehicles) {
    using tests::operator<<;
    text << vehicle;
  }
  for (const StraightWall& wall : one.walls) {
    text << "wall (" << wall.start.transpose() << ") to (" << wall.end.transpose() << ")\n";
  }
  return text.str();
}

void expectAsReference(VehicleKind kind, std::size_t count, std::uint64_t seed) {
  const VehicleBatch batch = makeVehicleBatch(kind, count, seed);
  const VehicleScheme bumper = vehicleSchemes().front();
  EndError worst;
  for (const ReferencedVehicles& one : batch.cases) {
    for (const double step : stepSizes) {
      const VehicleRun run = bumper.run({&one.vehicleCase, one.flight.duration, step, true});
      const EndError error = errorOf(one, run.end);
      worst.deltaV = std::max(worst.deltaV, error.deltaV);
      worst.position = std::max(worst.position, error.position);
      EXPECT_TRUE(error.deltaV <= bound && error.position <= bound)
          << nameOf(kind) << ", step " << step << ", Δv off by " << error.deltaV << ", place by "
          << error.position << ", " << one.flight.vehicleImpacts << " + " << one.flight.wallImpacts
          << " impacts, until " << one.flight.duration << '\n'
          << describe(one.vehicleCase);
      EXPECT_LE(run.energyGain, energyRounding) << describe(one.vehicleCase);
    }
  }
  std::printf("[ figures  ] %s: %zu cases; Δv off by %.2g, place by %.2g m\n", nameOf(kind),
              batch.cases.size(), worst.deltaV, worst.position);
  std::printf("[ figures  ] of %zu starts %zu sensitive; in doubt from the first contact on:",
              batch.tried, batch.sensitive);
  for (int i = 1; i < doubts; ++i) {
    const std::size_t number = batch.doubtful.at(static_cast<std::size_t>(i));
    std::printf(" %s %zu", nameOf(static_cast<Doubt>(i)), number);
  }
  std::printf("\n");
}

TEST(VehicleAccuracy, PairsAreTheReferencesToRoundingAtEveryStep) {
  expectAsReference(VehicleKind::pair, 300, 71);
}

TEST(VehicleAccuracy, PlainPairsToo) { expectAsReference(VehicleKind::plain, 60, 72); }

TEST(VehicleAccuracy, ScenesWithWallsToo) { expectAsReference(VehicleKind::scene, 60, 73); }

/// The peers' cases are the same ones: they come near.
TEST(VehicleAccuracy, PeersComeNear) {
  const VehicleBatch batch = makeVehicleBatch(VehicleKind::plain, 40, 74);
  for (const VehicleScheme& scheme : vehicleSchemes()) {
    std::vector<double> errors;
    for (const ReferencedVehicles& one : batch.cases) {
      const VehicleRun run = scheme.run({&one.vehicleCase, one.flight.duration, 5e-4, true});
      errors.push_back(errorOf(one, run.end).deltaV);
    }
    std::ranges::sort(errors);
    EXPECT_LE(errors[errors.size() / 2], 0.3) << scheme.name;
    std::printf("[ figures  ] %s: median %.2g, worst %.2g\n", scheme.name,
                errors[errors.size() / 2], errors.back());
  }
}

}  // namespace
}  // namespace bumper::benchmark
