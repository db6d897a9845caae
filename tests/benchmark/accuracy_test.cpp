#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "accuracy_rows.h"
#include "ode_world.h"
#include "schemes.h"

/// Bumper against the reference: the same claims as the benchmark's, over fewer cases.
namespace bumper::benchmark {
namespace {

[[maybe_unused]] const ::testing::Environment* const ode =
    ::testing::AddGlobalTestEnvironment(new tests::OdeEnvironment);

constexpr std::size_t caseCount = 300;
constexpr double bound = 1e-9;  // of Δv, relative, and of the position, m
constexpr double energyRounding = 1e-12;

struct ReferencedCase {
  ImpactCase impactCase;
  CaseReference reference;
};

/// Those of 300 cases of every kind in which all is decided by impacts.
const std::vector<ReferencedCase>& someCases() {
  static const std::vector<ReferencedCase> result = [] {
    std::vector<ReferencedCase> kept;
    for (const ImpactCase& one : makeCases(readCars(BUMPER_VEHICLES), 60, caseCount, 11)) {
      const CaseReference reference = referenceOf(one, Setting::free_flight);
      if (!reference.sensitive && !reference.flight.lasting) kept.push_back({one, reference});
    }
    return kept;
  }();
  return result;
}

/// All numbers of a start, to repeat a case by hand.
std::string describe(const ImpactCase& one) {
  std::ostringstream text;
  text.precision(17);
  text << nameOf(one.kind) << ", law " << one.law.id << ", car " << one.car.body.mass << " kg, at ("
       << one.start.position.x() << ", " << one.start.position.y() << "), yaw " << one.start.yaw
       << ", velocity (" << one.start.velocity.x() << ", " << one.start.velocity.y()
       << "), yaw rate " << one.start.yawRate;
  return text.str();
}

TEST(Accuracy, FreeFlightIsTheReferencesToRoundingAtEveryStep) {
  EXPECT_GE(someCases().size(), caseCount * 9 / 10);
  for (const int triangles : wallMeshes) {
    const std::unique_ptr<Scheme> scheme = makeScheme("bumper", Setting::free_flight, triangles);
    for (const ReferencedCase& one : someCases()) {
      for (const double step : stepSizes) {
        const RunResult result =
            scheme->run({.impactCase = &one.impactCase, .reference = &one.reference, .step = step});
        const EndError error = errorOf(one.impactCase, one.reference, result.end);
        EXPECT_LE(error.deltaV, bound) << step << " s: " << describe(one.impactCase);
        EXPECT_LE(error.position, bound) << step << " s: " << describe(one.impactCase);
        EXPECT_LE(result.energyGain, energyRounding) << step << " s: " << describe(one.impactCase);
      }
    }
  }
}

// What contact joints make of the same impacts, at best: a true normal and a small step.
TEST(Accuracy, ContactJointsAreOffByMoreThanAThousandth) {
  const std::unique_ptr<Scheme> scheme =
      makeScheme("ode_quickstep_true_normal", Setting::free_flight, 1224);
  RowMaker rows;
  for (const ReferencedCase& one : someCases()) {
    if (one.impactCase.kind != CaseKind::plain) continue;
    const RunResult result =
        scheme->run({.impactCase = &one.impactCase, .reference = &one.reference, .step = 0.001});
    rows.add(errorOf(one.impactCase, one.reference, result.end), result.energyGain);
  }
  const Row row = rows.row(Setting::free_flight, "ode_quickstep_true_normal", 1224, 0.001);
  EXPECT_GT(row.deltaV.median, 1e-3);
  EXPECT_LT(row.deltaV.median, 0.1);  // it is the same impact nonetheless
}

}  // namespace
}  // namespace bumper::benchmark
