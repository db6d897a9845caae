// What must hold in the examples' scenes of vehicles that hit each other.

#include "vehicle_scenes.h"

#include <gtest/gtest.h>
#include <ode/ode.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace bumper::tests {
namespace {

class VehicleScenes : public ::testing::TestWithParam<std::size_t> {
 protected:
  static void SetUpTestSuite() { dInitODE2(0); }
  static void TearDownTestSuite() { dCloseODE(); }

  examples::VehicleScene scene_ = examples::vehicleScenes().at(GetParam());
};

TEST_P(VehicleScenes, KeepMomentumAndLeadNobodyThroughAnybody) {
  const examples::VehicleRun run = examples::runVehicleScene(scene_);
  EXPECT_GE(run.hits, scene_.name == "motorway" ? 29 : 1);
  EXPECT_LE(run.momentumChange, 1e-12);
  EXPECT_LE(run.deepestOverlap, 0.1);
  // All have come to rest, on the side of the walls on which they were.
  for (const RecordedVehicle& vehicle : run.recording.vehicles()) {
    const RecordedPose& last = vehicle.poses.back();
    EXPECT_LE(last.velocity.norm(), 0.5) << vehicle.name;
    if (scene_.name == "motorway") {
      EXPECT_LT(last.position.x(), -0.85) << vehicle.name;
      EXPECT_LT(std::abs(last.position.y()), 5.5 - 0.85) << vehicle.name;
    }
    if (scene_.name == "chain") {
      EXPECT_LT(std::abs(last.position.y()), 5.0 - 0.85) << vehicle.name;
    }
  }
}

TEST_P(VehicleScenes, GoTheSameWayEachTime) {
  const examples::VehicleRun once = examples::runVehicleScene(scene_);
  const examples::VehicleRun again = examples::runVehicleScene(scene_);
  for (std::size_t v = 0; v < once.recording.vehicles().size(); ++v) {
    EXPECT_EQ(once.recording.vehicles()[v].poses.back().position,
              again.recording.vehicles()[v].poses.back().position);
  }
}

INSTANTIATE_TEST_SUITE_P(Examples, VehicleScenes, ::testing::Range(std::size_t{0}, std::size_t{4}),
                         [](const auto& instance) {
                           return examples::vehicleScenes().at(instance.param).name;
                         });

TEST(VehicleScenesThemselves, StandForWhatTheyAreNamedAfter) {
  const std::vector<examples::VehicleScene> scenes = examples::vehicleScenes();
  dInitODE2(0);
  // The car on the street hits the other one's side.
  // An event's names lie in its recording.
  const examples::VehicleRun crossing = examples::runVehicleScene(scenes[0]);
  const ImpactEvent first =
      asSeenBy("street", crossing.recording.impacts().front().event()).value();
  EXPECT_GT(first.arm.x(), 1.5);
  EXPECT_GT(first.otherArm.y(), 0.5);
  // Each of the queue is pushed in its turn.
  std::vector<std::string> pushed;
  const examples::VehicleRun chain = examples::runVehicleScene(scenes[1]);
  for (const RecordedImpact& impact : chain.recording.impacts()) {
    const std::string name(impact.event().vehicle);
    if (std::ranges::find(pushed, name) == pushed.end()) pushed.push_back(name);
  }
  EXPECT_EQ(pushed, (std::vector<std::string>{"waits 4", "waits 3", "waits 2", "waits 1"}));
  // The gate goes on as the application says.
  const examples::VehicleRun gate = examples::runVehicleScene(scenes[3]);
  const RecordedVehicle& itself = gate.recording.vehicles().back();
  EXPECT_EQ(itself.name, "gate");
  EXPECT_NEAR(itself.poses.back().position.y(), scenes[3].gate->closedAt,
              scenes[3].gate->speed * 0.005 + 1e-9);
  EXPECT_GE(gate.hits, 2);
  dCloseODE();
}

}  // namespace
}  // namespace bumper::tests
