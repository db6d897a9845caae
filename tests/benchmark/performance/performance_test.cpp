#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "ode_world.h"
#include "performance_report.h"
#include "query_scheme.h"

/// The benchmark runs, its peers find what they are asked for, and its file has the shape that
/// readers rely on. No time is compared.
namespace bumper::benchmark {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;

[[maybe_unused]] const ::testing::Environment* const ode =
    ::testing::AddGlobalTestEnvironment(new tests::OdeEnvironment);

constexpr double lowestTouching = 0.9;  // of touching poses: each scheme has its own margins

std::string textOf(const std::filesystem::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

TEST(Drive, IsMostlyFarAndMovesAsItsVelocitiesSay) {
  for (const char* name : {"S1", "S2g"}) {
    SCOPED_TRACE(name);
    const Drive drive = makeDrive(makeScene(name).scene, 20000);
    const auto share = [&](Nearness kind) {
      return static_cast<double>(drive.count(kind)) / static_cast<double>(drive.poses.size());
    };
    EXPECT_NEAR(share(Nearness::far), 0.91, 0.03);
    EXPECT_NEAR(share(Nearness::near), 0.065, 0.02);
    EXPECT_NEAR(share(Nearness::touching), 0.025, 0.01);
    for (std::size_t i = 1; i < drive.poses.size(); ++i) {
      const Pose& pose = drive.poses[i];
      const Vector2 before = drive.poses[i - 1].place.position;
      ASSERT_LT((pose.place.position - before - stepSize * pose.velocity).norm(), 1e-11) << i;
      ASSERT_LT(pose.velocity.norm(), 40.0) << i;
      ASSERT_LT(std::abs(pose.yawRate), 4.0) << i;
    }
  }
}

TEST(WallGrid, GapIsZeroWhereTheyOverlapAndTheDistanceElsewhere) {
  const Outline outline(queryCar());
  const PlanPlace place{.position = {10.0, 5.0}, .cosine = 0.0, .sine = 1.0};  // heading along y
  const PlanSegment before{.start = {0.0, 8.2}, .end = {20.0, 8.2}};
  EXPECT_NEAR(gapBetween(outline, place, before), 1.0, 1e-12);
  EXPECT_FALSE(overlap(outline, place, before));
  const PlanSegment through{.start = {0.0, 7.0}, .end = {20.0, 7.0}};
  EXPECT_EQ(gapBetween(outline, place, through), 0.0);
  EXPECT_TRUE(overlap(outline, place, through));
  const PlanSegment off{.start = {13.9, 11.2}, .end = {20.0, 20.0}};  // 3 m and 4 m off a corner
  EXPECT_NEAR(gapBetween(outline, place, off), 5.0, 1e-12);
}

TEST(Scenes, HaveTheTrianglesOfTheirNames) {
  EXPECT_EQ(makeScene("S1").scene.triangles.size(), 612);
  EXPECT_EQ(makeScene("S2").scene.triangles.size(), 1838);
  EXPECT_EQ(makeScene("S2g").scene.triangles.size(), 8780);
  const Scene large = makeScene("S3").scene;
  EXPECT_EQ(large.triangles.size(), 100000);
  EXPECT_EQ(wallsAlone(large).triangles.size(), 20000);
}

TEST(Performance, QuickRunWritesFiguresThatAreThereAndPositive) {
  const std::filesystem::path folder =
      std::filesystem::path(::testing::TempDir()) / "bumper_performance";
  std::vector<std::string> said;
  const Performance performance =
      measurePerformance(quickOptions(), [&](const std::string& line) { said.push_back(line); });
  EXPECT_FALSE(said.empty());
  writeReport(performance, folder / "performance.json");

  const json document = json::parse(textOf(folder / "performance.json"));
  for (const char* rows : {"queries", "growth"}) {
    ASSERT_FALSE(document.at(rows).empty());
    for (const json& row : document.at(rows)) {
      SCOPED_TRACE(row.dump());
      EXPECT_GT(row.at("triangles").get<int>(), 500);
      for (const char* figure : {"far_ns", "near_ns", "touch_ns", "path_mean_ns", "build_ms"}) {
        EXPECT_GT(row.at(figure).get<double>(), 0.0) << figure;
      }
      EXPECT_GE(row.at("memory_mb").get<double>(), 0.0);
      EXPECT_TRUE(row.at("instructions_far").is_null());  // nothing was counted
      EXPECT_EQ(row.at("found_far").get<double>(), 0.0);
      if (row.at("scheme") != "world_step") {
        EXPECT_GT(row.at("found_touching").get<double>(), lowestTouching);
      }
    }
  }
  for (const std::string& scheme : querySchemeNames()) {
    EXPECT_TRUE(std::ranges::any_of(document.at("queries"), [&](const json& row) {
      return row.at("scheme") == scheme && row.at("scene") == "S2g";
    })) << scheme;
  }
  ASSERT_EQ(document.at("steps").size(), 6 + quickOptions().steps.fleets.size());
  for (const json& row : document.at("steps")) {
    SCOPED_TRACE(row.dump());
    EXPECT_GT(row.at("free_ns").get<double>(), 0.0);
    EXPECT_GT(row.at("contact_ns").get<double>(), 0.0);
    EXPECT_GT(row.at("vehicles").get<int>(), 0);
  }
  ASSERT_FALSE(document.at("table1").empty());
  for (const json& row : document.at("table1")) {
    EXPECT_GT(row.at("update_us").get<double>(), 0.0);
    EXPECT_GT(row.at("no_collision_us").get<double>(), 0.0);
  }
  EXPECT_EQ(document.at("targets").size(), 12);
  EXPECT_THAT(textOf(folder / "performance.md"),
              AllOf(HasSubstr("## Targets"), HasSubstr("| S2g | 8780 | bumper |")));
  EXPECT_THAT(textOf(folder / "performance.gp"), HasSubstr("performance_vehicles.png"));
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace bumper::benchmark
