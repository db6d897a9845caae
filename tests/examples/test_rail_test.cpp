// The paper's story of Figures 6 and 7, told by both laws.

#include <gtest/gtest.h>
#include <ode/ode.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "bumper/scenes/paper_scenes.h"
#include "test_rail_run.h"

namespace bumper::tests {
namespace {

constexpr double degrees = 180.0 / std::numbers::pi;

class TestRail : public ::testing::TestWithParam<Law> {
 protected:
  static void SetUpTestSuite() { dInitODE2(0); }
  static void TearDownTestSuite() { dCloseODE(); }
};

// Figure 7 has the SAE sign: positive turning right.
double saeYawRate(const RecordedPose& pose) { return -pose.yawRate * degrees; }

TEST_P(TestRail, GoesAsThePaperSays) {
  const Scene scene = testRail();
  ASSERT_EQ(scene.triangles.size(), 612U);
  const Recording recording = examples::runTestRail(scene, {.law = GetParam()});
  std::vector<ImpactEvent> impacts;
  for (const RecordedImpact& each : recording.impacts()) impacts.push_back(each.event());
  ASSERT_GE(impacts.size(), 3U);

  // "The right front corner impacts the side wall at about 1.5 seconds, causing a spike in negative
  // yaw rate."
  EXPECT_GE(impacts[0].time, 1.45);
  EXPECT_LE(impacts[0].time, 1.55);
  EXPECT_GT(impacts[0].arm.x(), 1.5);
  EXPECT_LT(impacts[0].arm.y(), -0.7);
  EXPECT_LT(-impacts[0].yawRateAfter * degrees, -50.0);

  // "This is followed almost immediately by the right rear corner of the vehicle hitting the wall,
  // reversing the direction of the yaw rate."
  EXPECT_LE(impacts[1].time - impacts[0].time, 0.25);
  EXPECT_LT(impacts[1].arm.x(), -1.5);
  EXPECT_LT(impacts[1].arm.y(), -0.7);
  EXPECT_LT(-impacts[1].yawRateBefore, 0.0);
  EXPECT_GT(-impacts[1].yawRateAfter, 0.0);

  // "At about 2.5 seconds, the left front corner of the vehicle hits the end wall effectively
  // stopping forward motion and resulting in residual negative yaw rate, which gradually dies out."
  std::size_t end = 2;
  while (end < impacts.size() && impacts[end].approachSpeed < 15.0) ++end;
  ASSERT_LT(end, impacts.size());
  EXPECT_GE(impacts[end].time, 2.3);
  EXPECT_LE(impacts[end].time, 2.7);
  EXPECT_GT(impacts[end].arm.x(), 1.5);
  EXPECT_GT(impacts[end].arm.y(), 0.3);
  EXPECT_LT(impacts[end].speedAfter, 5.0);
  EXPECT_LT(-impacts[end].yawRateAfter, 0.0);

  const std::vector<RecordedPose>& poses = recording.vehicles()[0].poses;
  for (const RecordedPose& pose : poses) {
    if (pose.time > impacts[end].time + 0.01) {
      EXPECT_LT(pose.velocity.norm(), 5.0) << "at " << pose.time << " s";
    }
  }
  EXPECT_LT(std::abs(saeYawRate(poses.back())), 2.0);
}

// Never through a wall: the outline's deepest corner goes in by no more than a step's way.
TEST_P(TestRail, StaysOnItsSideOfTheWalls) {
  const Scene scene = testRail();
  const Recording recording = examples::runTestRail(scene, {.law = GetParam()});
  const Eigen::Vector2d sideNormal = Eigen::Vector2d(-0.10453, 0.99452).normalized();
  const Eigen::Vector2d endNormal = Eigen::Vector2d(-0.98163, -0.19081).normalized();
  for (const RecordedPose& pose : recording.vehicles()[0].poses) {
    const Eigen::Vector2d centre = pose.position.head<2>();
    EXPECT_GT((centre - Eigen::Vector2d(42.334, -0.900)).dot(sideNormal), 0.7);
    EXPECT_GT((centre - Eigen::Vector2d(67.197, 1.713)).dot(endNormal), 1.8);
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, TestRail, ::testing::Values(Law::restitution, Law::energy),
                         [](const auto& each) { return std::string(toString(each.param)); });

}  // namespace
}  // namespace bumper::tests
