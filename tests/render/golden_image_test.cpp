#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <numbers>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "bumper/render/image.h"
#include "bumper/render/image_compare.h"
#include "bumper/render/image_matcher.h"
#include "bumper/render/impact_close_up.h"
#include "bumper/render/snapshot.h"
#include "bumper/scenes/paper_scenes.h"
#include "synthetic_run.h"

namespace bumper {
namespace {

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
  for (const OffscreenBackend backend : builtBackends()) {
    const std::string folder = backend == OffscreenBackend::osmesa ? "/osmesa" : "/egl";
    EXPECT_THAT(draw(which, which.run(), backend),
                MatchesGolden(goldenOf(which), {.output = OUTPUT_FOLDER + folder}));
  }
}

TEST_P(GoldenImage, isSmallEnoughToKeep) {
  EXPECT_LT(std::filesystem::file_size(goldenOf(GetParam())), 300'000U);
}

TEST_P(GoldenImage, isMissedWithoutTheHardestImpact) {
  const Case& which = GetParam();
  const Recording run = which.run();
  const Image less = draw(which, testing::withoutImpact(run, run.impacts().size() - 1));
  EXPECT_FALSE(compareImages(readPng(goldenOf(which)), less).isSame);
}

TEST_P(GoldenImage, isMissedByCarsThatAreTurned) {
  const Case& which = GetParam();
  // By 10°: in the course's top view a car is a dozen pixels long. tests/consumer sees 1° in a
  // picture of the car.
  const Image other = draw(which, testing::turned(which.run(), 10.0 * std::numbers::pi / 180.0));
  EXPECT_FALSE(compareImages(readPng(goldenOf(which)), other).isSame);
}

INSTANTIATE_TEST_SUITE_P(PaperScenes, GoldenImage, ::testing::ValuesIn(cases()),
                         [](const auto& instance) { return instance.param.name; });

/// The close-up of an impact, of one that is straight and one that slides.
Image closeUp(const Recording& run, std::size_t impact, OffscreenBackend backend) {
  return impactCloseUp(testRail(), run, impact, {.width = 800, .height = 450}, backend);
}

class GoldenCloseUp : public ::testing::TestWithParam<std::size_t> {
 protected:
  std::string name_ = "close_up_" + std::to_string(GetParam() + 1);
  std::filesystem::path golden_ = std::filesystem::path(GOLDEN_FOLDER) / (name_ + ".png");
};

TEST_P(GoldenCloseUp, isMatched) {
  for (const OffscreenBackend backend : builtBackends()) {
    const std::string folder = backend == OffscreenBackend::osmesa ? "/osmesa" : "/egl";
    EXPECT_THAT(closeUp(testing::cornerHits(), GetParam(), backend),
                MatchesGolden(golden_, {.output = OUTPUT_FOLDER + folder}));
  }
}

TEST_P(GoldenCloseUp, isMissedByACarThatIsTurned) {
  const Recording other = testing::turned(testing::cornerHits(), std::numbers::pi / 180.0);
  EXPECT_FALSE(
      compareImages(readPng(golden_), closeUp(other, GetParam(), OffscreenBackend::automatic))
          .isSame);
}

INSTANTIATE_TEST_SUITE_P(TestRail, GoldenCloseUp, ::testing::Values(0U, 1U));

/// Marks that go, one at a time, from a picture that otherwise stays the same.
TEST(GoldenTestRail, isMissedWithoutAnyOneMark) {
  const Case which = cases()[0];
  const Recording run = which.run();
  for (std::size_t k = 0; k < run.impacts().size(); ++k) {
    const Image less = draw(which, testing::withoutImpact(run, k));
    EXPECT_FALSE(compareImages(readPng(goldenOf(which)), less).isSame) << "impact " << k + 1;
  }
}

}  // namespace
}  // namespace bumper
