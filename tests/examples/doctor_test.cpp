#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ode/ode.h>

#include <algorithm>
#include <cmath>

#include "bumper/scenes/paper_scenes.h"
#include "checks.h"
#include "doctor_scenes.h"
#include "examination.h"
#include "vehicle_presets.h"
#include "worst_places.h"

namespace bumper::doctor {
namespace {

using namespace bumper::testing;
using ::testing::IsEmpty;

Subject subjectOf(Scene scene) {
  return {.scene = std::move(scene), .vehicle = *findVehicle("car")};
}

std::vector<SmallFeature> featuresOf(const Scene& scene) {
  return smallFeatures(selectWalls(scene).walls, 0.02, 0.2);
}

TEST(SmallFeatures, FindAStepOfAnySizeBelowTheSmallest) {
  for (const double step : {0.0002, 0.001, 0.005, 0.019}) {
    const auto features = featuresOf(steppedWall(step));
    ASSERT_EQ(features.size(), 1U) << step;
    EXPECT_NEAR(features[0].size, step, 1e-9);
    EXPECT_FALSE(features[0].isGap);
    EXPECT_NEAR(features[0].place.x(), 20.0, 1e-9);
    EXPECT_NEAR(features[0].place.y(), 0.0, 0.02);
  }
}

TEST(SmallFeatures, AreNotWhatIsLargerOrGoesOn) {
  EXPECT_THAT(featuresOf(healthyWall()), IsEmpty());
  EXPECT_THAT(featuresOf(steppedWall(0.0)), IsEmpty());
  EXPECT_THAT(featuresOf(steppedWall(0.05)), IsEmpty());
  EXPECT_THAT(featuresOf(straightWall({0.0, 0.0}, {40.0, 7.0}, 1.0, 80, 6)), IsEmpty());
  EXPECT_THAT(featuresOf(testRail()), IsEmpty());
}

TEST(SmallFeatures, FindEveryJointOfBlocksOnBothSides) {
  const auto features = featuresOf(rowOfBlocks());
  EXPECT_EQ(features.size(), 2U * 19U);
  EXPECT_TRUE(std::ranges::is_sorted(features, std::greater(), &SmallFeature::size));
  // The back is in line: gaps of 10 mm alone.
  EXPECT_EQ(std::ranges::count_if(features, [](const auto& f) { return f.place.y() < -0.4; }), 19);
  for (const SmallFeature& feature : features) {
    if (feature.place.y() < -0.4) {
      EXPECT_TRUE(feature.isGap);
      EXPECT_NEAR(feature.size, 0.01, 1e-9);
    }
  }
}

TEST(MeshEdges, OfAClosedBlockAreAllShared) {
  Scene block;
  addBlock(block, {0.0, 0.0}, {2.0, 1.0}, 1.0);
  const MeshEdges edges = examineEdges(block);
  EXPECT_EQ(edges.open.count, 0U);
  EXPECT_EQ(edges.flipped.count, 0U);
  EXPECT_EQ(edges.nonManifold.count, 0U);
}

TEST(MeshEdges, ShowAHoleAFlippedTriangleAndAThird) {
  Scene hole;
  addBlock(hole, {0.0, 0.0}, {2.0, 1.0}, 1.0);
  Scene flipped = hole;
  Scene third = hole;
  hole.triangles.pop_back();
  EXPECT_EQ(examineEdges(hole).open.count, 3U);
  std::swap(flipped.triangles.front().corners[0], flipped.triangles.front().corners[1]);
  EXPECT_EQ(examineEdges(flipped).flipped.count, 3U);
  third.vertices.emplace_back(0.0, 0.0, 5.0);
  third.triangles.push_back({{0, 1, 8}, 0});
  EXPECT_EQ(examineEdges(third).nonManifold.count, 1U);
  EXPECT_EQ(examineEdges(third).open.count, 2U);
}

WallPath pathOf(const std::vector<WallLine>& walls, std::vector<WallLine> obstacles = {}) {
  obstacles.insert(obstacles.end(), walls.begin(), walls.end());
  return pathAlong(walls, obstacles, {});
}

TEST(WallPaths, FollowPiecesAroundGentleBends) {
  const Vector2 bend = Vector2(5.0, 0.0) + 8.0 * Vector2(std::cos(0.15), std::sin(0.15));
  const WallPath path =
      pathOf({{{-3.0, 0.0}, {1.0, 0.0}}, {{5.0, 0.0}, {1.0, 0.0}}, {{5.0, 0.0}, bend}});
  EXPECT_NEAR(path.start, -3.0, 1e-12);
  EXPECT_NEAR(path.end, 13.0, 1e-12);
  EXPECT_NEAR(
      (path.pointAt(9.0) - Vector2(5.0 + 4.0 * std::cos(0.15), 4.0 * std::sin(0.15))).norm(), 0.0,
      1e-12);
  EXPECT_NEAR(path.distanceTo({0.0, 2.0}), 2.0, 1e-12);
}

TEST(WallPaths, EndAtSharpBendsGapsAndObstacles) {
  const std::vector<WallLine> wall{{{-9.0, 0.0}, {9.0, 0.0}}};
  EXPECT_NEAR(pathOf({{{-9.0, 0.0}, {4.0, 0.0}}, {{4.0, 0.0}, {6.0, 0.5}}}).end, 4.0, 1e-12);
  EXPECT_NEAR(pathOf({{{-9.0, 0.0}, {4.0, 0.0}}, {{4.5, 0.0}, {9.0, 0.0}}}).end, 4.0, 1e-12);
  EXPECT_NEAR(pathOf({{{-9.0, 0.0}, {4.0, 0.0}}, {{4.2, 0.01}, {9.0, 0.01}}}).end, 9.0, 1e-3);
  // Across, before and behind; too small; beyond the room.
  EXPECT_NEAR(pathOf(wall, {{{5.0, 1.5}, {5.0, 30.0}}}).end, 5.0, 1e-12);
  EXPECT_NEAR(pathOf(wall, {{{-5.0, 1.5}, {-5.0, 30.0}}}).start, -5.0, 1e-12);
  EXPECT_NEAR(pathOf(wall, {{{5.0, 0.0}, {5.0, 0.015}}}).clear(), 18.0, 1e-12);
  EXPECT_NEAR(pathOf(wall, {{{5.0, 2.5}, {5.0, 30.0}}}).clear(), 18.0, 1e-12);
  EXPECT_EQ(pathOf(wall, {{{-1.0, 1.0}, {1.0, 1.0}}}).clear(), 0.0);
}

DriveTrace traceOf(const std::vector<double>& speeds) {
  DriveTrace trace;
  double x = 0.0;
  for (const double speed : speeds) {
    trace.states.push_back(
        {.position = {x, 0.0, 0.0}, .velocity = {speed, 0.0, 0.0}, .energy = speed * speed});
    x += speed;
  }
  return trace;
}

TEST(TraceMeasures, FindTheSteepestLossWithinTheTime) {
  DriveTrace trace = traceOf({10.0, 9.0, 8.5, 4.0, 3.5, 3.4});
  trace.contacts = {{.step = 1, .place = {1.0, 0.0, 0.0}, .normal = {-1.0, 0.0, 0.0}},
                    {.step = 2, .place = {2.0, 0.0, 0.0}, .normal = {0.0, 1.0, 0.0}},
                    {.step = 2, .place = {3.0, 0.0, 0.0}, .normal = {-1.0, 0.0, 0.0}}};
  const TestDrive drive{.start = {.velocity = {10.0, 0.0}}};
  const SpeedLoss loss = suddenLoss(trace, drive, 0.1, 0.2);
  EXPECT_NEAR(loss.loss, 5.0, 1e-12);  // 9 to 4, and 8.5 to 3.5
  EXPECT_EQ(loss.step, 2U);
  EXPECT_EQ(loss.place.x(), 3.0);
  EXPECT_EQ(suddenLoss(traceOf({5.0, 6.0, 7.0}), drive, 0.1, 0.2).loss, 0.0);
}

TEST(TraceMeasures, TakeEnergyAfterTheContact) {
  DriveTrace trace = traceOf({10.0, 10.0, 5.0, 6.0});
  EXPECT_EQ(mostEnergy(trace), 0.0);
  trace.contacts.push_back({.step = 1});
  EXPECT_NEAR(mostEnergy(trace), 0.36, 1e-12);
}

TEST(TraceMeasures, SeeTheMassCentreCrossAWall) {
  Place place;
  place.lines = {{{12.0, -1.0}, {12.0, 1.0}}};
  EXPECT_TRUE(wentThrough(traceOf({10.0, 10.0, 10.0}), place));
  EXPECT_FALSE(wentThrough(traceOf({10.0, 1.0, 0.5}), place));
  place.lines = {{{12.0, 0.5}, {12.0, 1.0}}};
  EXPECT_FALSE(wentThrough(traceOf({10.0, 10.0, 10.0}), place));
}

/// Real drives in ODE.
class Examinations : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { dInitODE2(0); }
  static void TearDownTestSuite() { dCloseODE(); }

  static std::vector<std::string> problems(const Subject& subject, const Examination& examination,
                                           std::span<const std::string_view> names) {
    const std::vector<Check> checks = checksOf(subject, examination);
    const std::vector<std::string> asked(names.begin(), names.end());
    return problemsAmong(checks, asked);
  }
};

TEST_F(Examinations, OfAHealthyWallFindNothing) {
  const Subject subject = subjectOf(healthyWall());
  const Examination examination = examine(subject, {}, 10);
  EXPECT_EQ(examination.places.size(), 10U);
  EXPECT_GT(examination.distance, 100.0);
  EXPECT_EQ(examination.bumper.impacts.size(), 30U);
  EXPECT_THAT(problems(subject, examination, usualChecks()), IsEmpty());
  // Friction at 3° and a rebound, no more.
  EXPECT_GT(examination.bumper.worstLoss(), 0.0);
  EXPECT_LT(examination.bumper.worstLoss(), 0.1 * subject.speed);
  EXPECT_LT(examination.bumper.mostEnergy(), 1.0);
  EXPECT_GT(examination.bumper.mostEnergy(), 0.1);
}

TEST_F(Examinations, ShowJointsCaughtInARowOfBlocksAndBumperNot) {
  const Subject subject = subjectOf(rowOfBlocks());
  const Examination examination = examine(subject, {}, 30);
  EXPECT_GT(examination.joints.caught(subject.speed), 0U);
  EXPECT_EQ(examination.bumper.caught(subject.speed), 0U);
  EXPECT_THAT(problems(subject, examination, usualChecks()), IsEmpty());
  EXPECT_THAT(problems(subject, examination, checkNames()),
              ::testing::UnorderedElementsAre("features", "joints"));
  const auto worst = worstPlaces(subject, examination, 5);
  ASSERT_EQ(worst.size(), 5U);
  EXPECT_EQ(worst[0].kind, "catch");
  EXPECT_THAT(worst[0].words, ::testing::HasSubstr("contact joints"));
  // At a joint between two blocks.
  EXPECT_NEAR(std::remainder(worst[0].position.x(), 2.0), 0.0, 0.05);
}

TEST_F(Examinations, CountMoreWrongNormalsOnAFinerMesh) {
  const auto count = [](std::size_t panels, std::size_t rows) {
    const Subject subject = subjectOf(straightWall({0.0, 0.0}, {40.0, 0.0}, 1.0, panels, rows));
    const std::vector<Wall> walls = selectWalls(subject.scene).walls;
    const WallSections sections(walls);
    const Ground ground(subject);
    JointRig joints(subject, walls);
    return countNormals(subject, choosePlaces(subject, sections, ground, {}, 20), walls, joints);
  };
  const NormalCount coarse = count(1, 1);
  const NormalCount fine = count(80, 6);
  EXPECT_LT(coarse.share(), 0.05);
  EXPECT_EQ(coarse.posesWithoutRight, 0U);
  EXPECT_GT(fine.share(), 0.1);
  EXPECT_GT(fine.posesWithoutRight, 0U);
}

TEST_F(Examinations, FindTheSpeedAtWhichJointsLetThrough) {
  Subject subject = subjectOf(straightWall({-20.0, 0.0}, {20.0, 0.0}, 1.0));
  subject.step = 0.02;
  const std::vector<Wall> walls = selectWalls(subject.scene).walls;
  const WallSections sections(walls);
  const Ground ground(subject);
  const auto places = choosePlaces(subject, sections, ground, {}, 1);
  ASSERT_EQ(places.size(), 1U);
  JointRig joints(subject, walls);
  const auto through = tunnellingSpeed(subject, places[0], Approach::side, joints);
  ASSERT_TRUE(through);
  EXPECT_GT(through->speed, 5.0);
  // From here it leaps over the wall, whatever its contacts do.
  EXPECT_LT(through->speed, 2.0 * subject.vehicle.width / subject.step);
  EXPECT_TRUE(wentThrough(joints.run(through->drive), places[0]));
  BumperRig bumper(subject);
  EXPECT_FALSE(tunnellingSpeed(subject, places[0], Approach::side, bumper));
  EXPECT_FALSE(wentThrough(bumper.run(through->drive), places[0]));
}

TEST_F(Examinations, AreTheSameTwice) {
  const Subject subject = subjectOf(rowOfBlocks());
  const Examination a = examine(subject, {}, 3);
  const Examination b = examine(subject, {}, 3);
  EXPECT_EQ(a.joints.worstLoss(), b.joints.worstLoss());
  EXPECT_EQ(a.bumper.worstLoss(), b.bumper.worstLoss());
  EXPECT_EQ(a.joints.front.speed, b.joints.front.speed);
}

TEST_F(Examinations, NameWhatIsDroppedAndWhy) {
  Scene scene = healthyWall();
  // A hillside of 50° that goes on, and a sign high above the ground.
  addQuad(scene, {{{0.0, 20.0, 0.0}, {20.0, 20.0, 0.0}, {20.0, 30.0, 11.9}, {0.0, 30.0, 11.9}}});
  addQuad(scene, {{{0.0, 5.0, 8.0}, {4.0, 5.0, 8.0}, {4.0, 5.0, 9.0}, {0.0, 5.0, 9.0}}});
  const Subject subject = subjectOf(scene);
  const Walls walls = selectWalls(scene);
  const auto groups = droppedGroups(subject, walls);
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_TRUE(groups[0].isGuess);
  EXPECT_EQ(groups[0].triangles, 2U);
  EXPECT_GT(groups[0].place.y(), 20.0);
  EXPECT_THAT(groups[1].reason, ::testing::HasSubstr("out of reach"));
  EXPECT_EQ(groups[1].place.y(), 5.0);
}

TEST(Checks, ReportWhatBumperDoesWrong) {
  const Subject subject = subjectOf(healthyWall());
  Examination examination;
  const auto problems = [&] {
    const std::vector<std::string> all(checkNames().begin(), checkNames().end());
    return problemsAmong(checksOf(subject, examination), all);
  };
  EXPECT_THAT(problems(), IsEmpty());
  examination.load.warnings = {"up"};
  examination.warnings = {"many"};
  examination.bumper.slides = {{.loss = {.loss = 0.21 * subject.speed}}};
  examination.bumper.impacts = {{.energy = 1.1, .isThrough = false}};
  examination.bumper.side.speed = 20.0;
  examination.edges.flipped.count = 1;
  examination.features.resize(1);
  examination.joints.front.speed = 24.0;
  EXPECT_THAT(problems(), ::testing::ElementsAreArray(checkNames()));
  examination.bumper.slides[0].loss.loss = 0.19 * subject.speed;
  examination.bumper.side.speed = 26.0;
  EXPECT_THAT(problems(), ::testing::Not(::testing::Contains("catches")));
  EXPECT_THAT(problems(), ::testing::Not(::testing::Contains("through")));
}

TEST(VehiclePresets, ChangeWhatIsAsked) {
  const VehicleParameters car = *findVehicle("car");
  const VehicleParameters longer = changed(car, {.length = 2.0 * 4.6, .mass = 3000.0});
  EXPECT_NEAR(longer.massCentreToFront, 4.2, 1e-12);
  EXPECT_NEAR(longer.yawInertia, 8.0 * car.yawInertia, 1e-9);
  EXPECT_EQ(changed(car, {}).yawInertia, car.yawInertia);
  EXPECT_ANY_THROW(changed(car, {.massCentreToFront = 5.0}));
}

}  // namespace
}  // namespace bumper::doctor
