#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "bumper/render/image.h"
#include "bumper/render/image_compare.h"
#include "bumper/render/snapshot.h"
#include "bumper/scenes/paper_scenes.h"
#include "synthetic_run.h"

namespace bumper {
namespace {

/// The shares of differing pixels that other processors and drivers may show: in the whole picture
/// and in any of its tiles.
constexpr double mostDiffering = 0.005;
constexpr double mostDifferingInATile = 0.10;

bool isGolden(const ImageComparison& comparison) {
  return comparison.differingShare <= mostDiffering &&
         comparison.worstTileShare <= mostDifferingInATile;
}

struct Case {
  std::string name;
  Scene (*scene)();
  Recording (*run)();
  SnapshotView view;
  std::optional<double> moment = std::nullopt;
};

void PrintTo(const Case& which, std::ostream* stream) { *stream << which.name; }

Scene wholeCourse() { return course(); }

std::vector<Case> cases() {
  return {{"test_rail_top", testRail, testing::testRailRun, SnapshotView::top},
          {"test_rail_three_quarter", testRail, testing::testRailRun, SnapshotView::three_quarter},
          {"course_top", wholeCourse, testing::courseRun, SnapshotView::top},
          {"course_three_quarter", wholeCourse, testing::courseRun, SnapshotView::three_quarter},
          {"test_rail_chase", testRail, testing::testRailRun, SnapshotView::chase, 2.5},
          {"course_orbit", wholeCourse, testing::courseRun, SnapshotView::orbit}};
}

SnapshotOptions optionsOf(const Case& which) {
  SnapshotOptions options;
  options.width = 800;
  options.height = 450;
  options.view = which.view;
  options.moment = which.moment;
  return options;
}

Image draw(const Case& which, const Recording& run,
           OffscreenBackend backend = OffscreenBackend::automatic) {
  return renderSnapshot(which.scene(), run, optionsOf(which), backend);
}

std::filesystem::path goldenOf(const Case& which) {
  return std::filesystem::path(GOLDEN_FOLDER) / (which.name + ".png");
}

class GoldenImage : public ::testing::TestWithParam<Case> {};

TEST_P(GoldenImage, isMatched) {
  const Case& which = GetParam();
  if (std::getenv("BUMPER_UPDATE_GOLDEN") != nullptr) {
    writePng(draw(which, which.run()), goldenOf(which));
    GTEST_SKIP() << "wrote " << goldenOf(which);
  }
  for (const OffscreenBackend backend : builtBackends()) {
    const Image actual = draw(which, which.run(), backend);
    const ImageComparison comparison = compareImages(readPng(goldenOf(which)), actual);
    if (isGolden(comparison)) continue;
    const std::filesystem::path folder(OUTPUT_FOLDER);
    std::filesystem::create_directories(folder);
    const std::string name =
        which.name + (backend == OffscreenBackend::osmesa ? "_osmesa" : "_egl");
    writePng(actual, folder / (name + "_actual.png"));
    writePng(comparison.difference, folder / (name + "_difference.png"));
    ADD_FAILURE() << 100.0 * comparison.differingShare << " % of the pixels differ from "
                  << goldenOf(which) << ", in the worst tile " << 100.0 * comparison.worstTileShare
                  << " %; see " << folder / (name + "_actual.png") << " and "
                  << folder / (name + "_difference.png")
                  << ". If the new picture is right, run again with BUMPER_UPDATE_GOLDEN=1.";
  }
}

TEST_P(GoldenImage, isSmallEnoughToKeep) {
  EXPECT_LT(std::filesystem::file_size(goldenOf(GetParam())), 300'000U);
}

TEST_P(GoldenImage, isMissedWithoutTheHardestImpact) {
  const Case& which = GetParam();
  const Recording run = which.run();
  const Image less = draw(which, testing::withoutImpact(run, run.impacts().size() - 1));
  EXPECT_FALSE(isGolden(compareImages(readPng(goldenOf(which)), less)));
}

TEST_P(GoldenImage, isMissedByCarsThatStandAcross) {
  const Case& which = GetParam();
  // A degree moves a car's corners by less than a pixel at this size: snapshot_test measures that.
  const Image other = draw(which, testing::turned(which.run(), 0.5 * std::numbers::pi));
  EXPECT_FALSE(isGolden(compareImages(readPng(goldenOf(which)), other)));
}

INSTANTIATE_TEST_SUITE_P(PaperScenes, GoldenImage, ::testing::ValuesIn(cases()),
                         [](const auto& instance) { return instance.param.name; });

/// Marks that go, one at a time, from a picture that otherwise stays the same.
TEST(GoldenTestRail, isMissedWithoutAnyOneMark) {
  const Case which = cases()[0];
  const Recording run = which.run();
  for (std::size_t k = 0; k < run.impacts().size(); ++k) {
    const Image less = draw(which, testing::withoutImpact(run, k));
    EXPECT_FALSE(isGolden(compareImages(readPng(goldenOf(which)), less))) << "impact " << k + 1;
  }
}

}  // namespace
}  // namespace bumper
