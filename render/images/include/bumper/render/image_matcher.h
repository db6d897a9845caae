#pragma once

#include <gmock/gmock.h>

#include <filesystem>
#include <ostream>
#include <utility>

#include "bumper/base/api.h"
#include "bumper/render/golden_image.h"

namespace BUMPER_API bumper {

/// A GoogleMock matcher around compareWithGolden(); made by MatchesGolden().
class GoldenMatcher {
 public:
  using is_gtest_matcher = void;

  GoldenMatcher(std::filesystem::path golden, GoldenOptions options)
      : golden_(std::move(golden)), options_(std::move(options)) {}

  bool MatchAndExplain(const Image& actual, ::testing::MatchResultListener* listener) const {
    const GoldenResult result = compareWithGolden(actual, golden_, options_);
    *listener << result.explanation;
    return result.matches;
  }
  void DescribeTo(std::ostream* stream) const { *stream << "is the picture in " << golden_; }
  void DescribeNegationTo(std::ostream* stream) const {
    *stream << "is not the picture in " << golden_;
  }

 private:
  std::filesystem::path golden_;
  GoldenOptions options_;
};

/// `EXPECT_THAT(image, bumper::MatchesGolden("golden/run.png"))` in a GoogleTest program, which
/// links GTest::gmock itself. Files that are left, and how the golden file is updated: see
/// compareWithGolden(). Not to be negated: an update would make the golden file what it must not
/// be; use compareImages() instead.
inline GoldenMatcher MatchesGolden(std::filesystem::path golden, GoldenOptions options = {}) {
  return {std::move(golden), std::move(options)};
}

/// How GoogleTest prints a picture.
inline void PrintTo(const Image& image, std::ostream* stream) {
  *stream << "a picture of " << image.width() << " x " << image.height() << " pixels";
}

}  // namespace bumper
