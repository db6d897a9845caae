#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "bumper/render/golden_image.h"
#include "bumper/render/image.h"
#include "bumper/render/image_matcher.h"
#include "bumper/response/error.h"
#include "temporary_folder.h"
#include "text_file.h"

namespace bumper {
namespace {

using ::testing::HasSubstr;
using testing::TemporaryFolder;

/// Each test begins without the variable that updates golden files.
class GoldenFile : public ::testing::Test {
 protected:
  void SetUp() override { unsetenv(variable); }
  void TearDown() override { unsetenv(variable); }

  static constexpr const char* variable = "BUMPER_UPDATE_GOLDEN";
  TemporaryFolder folder_;
  std::filesystem::path golden_ = folder_.path() / "golden" / "run.png";
  GoldenOptions options_{.output = folder_.path() / "left" / "here"};
  std::filesystem::path actual_ = options_.output / "run_actual.png";
  std::filesystem::path difference_ = options_.output / "run_difference.png";
  Image white_{40, 30, {255, 255, 255}};
  Image grey_{40, 30, {120, 120, 120}};
};

TEST_F(GoldenFile, thatIsMissingIsNotMatched) {
  const GoldenResult result = compareWithGolden(white_, golden_, options_);
  EXPECT_FALSE(result.matches);
  EXPECT_THAT(result.explanation, HasSubstr("there is no file"));
  EXPECT_EQ(readPng(actual_), white_);
  EXPECT_FALSE(std::filesystem::exists(golden_));
}

TEST_F(GoldenFile, isWrittenOnlyWhenTheVariableIsSet) {
  setenv(variable, "0", 1);
  EXPECT_FALSE(compareWithGolden(white_, golden_, options_).matches);
  setenv(variable, "", 1);
  EXPECT_FALSE(compareWithGolden(white_, golden_, options_).matches);
  setenv(variable, "1", 1);
  EXPECT_TRUE(compareWithGolden(white_, golden_, options_).matches);
  EXPECT_EQ(readPng(golden_), white_);
  EXPECT_TRUE(compareWithGolden(grey_, golden_, options_).matches);
  EXPECT_EQ(readPng(golden_), grey_);
}

TEST_F(GoldenFile, leavesPicturesUntilItIsMatchedAgain) {
  std::filesystem::create_directories(golden_.parent_path());
  writePng(white_, golden_);
  EXPECT_THAT(white_, MatchesGolden(golden_, options_));
  EXPECT_FALSE(std::filesystem::exists(options_.output));

  const GoldenResult result = compareWithGolden(grey_, golden_, options_);
  EXPECT_FALSE(result.matches);
  EXPECT_THAT(result.explanation, HasSubstr(difference_.string()));
  EXPECT_THAT(result.explanation, HasSubstr("BUMPER_UPDATE_GOLDEN=1"));
  EXPECT_EQ(readPng(actual_), grey_);
  EXPECT_GT(readPng(difference_).at(3, 3).red, readPng(difference_).at(3, 3).green + 100);
  EXPECT_EQ(readPng(golden_), white_);

  EXPECT_TRUE(compareWithGolden(white_, golden_, options_).matches);
  EXPECT_FALSE(std::filesystem::exists(actual_));
  EXPECT_FALSE(std::filesystem::exists(difference_));
}

TEST_F(GoldenFile, ofAnotherSizeIsNotMatched) {
  std::filesystem::create_directories(golden_.parent_path());
  writePng(Image(30, 40), golden_);
  const GoldenResult result = compareWithGolden(white_, golden_, options_);
  EXPECT_FALSE(result.matches);
  EXPECT_THAT(result.explanation, HasSubstr("40 x 30 pixels instead of 30 x 40"));
}

TEST_F(GoldenFile, thatIsDamagedIsAnError) {
  std::filesystem::create_directories(golden_.parent_path());
  testing::writeText(golden_, "no picture");
  EXPECT_THROW(compareWithGolden(white_, golden_, options_), Error);
}

TEST_F(GoldenFile, takesTheTolerancesGiven) {
  std::filesystem::create_directories(golden_.parent_path());
  writePng(white_, golden_);
  options_.compare.tolerance = 140;
  EXPECT_THAT(grey_, MatchesGolden(golden_, options_));
}

}  // namespace
}  // namespace bumper
