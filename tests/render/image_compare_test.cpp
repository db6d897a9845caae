#include "bumper/render/image_compare.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include "bumper/response/error.h"

namespace bumper {
namespace {

constexpr Rgb white{255, 255, 255};
constexpr Rgb black{0, 0, 0};

/// A black disc on white with a smooth edge.
Image disc(double x, double y) {
  Image image(128, 96, white);
  for (int j = 0; j < image.height(); ++j) {
    for (int i = 0; i < image.width(); ++i) {
      const double inside = 20.5 - std::hypot(i + 0.5 - x, j + 0.5 - y);
      const auto level = static_cast<std::uint8_t>(255.0 * (1.0 - std::clamp(inside, 0.0, 1.0)));
      image.at(i, j) = {level, level, level};
    }
  }
  return image;
}

TEST(ImageCompare, findsNothingInTheSamePicture) {
  const auto result = compareImages(disc(60, 40), disc(60, 40));
  EXPECT_EQ(result.differingShare, 0.0);
  EXPECT_EQ(result.worstTileShare, 0.0);
  EXPECT_EQ(result.worstDifference, 0);
  EXPECT_EQ(result.meanDifference, 0.0);
}

TEST(ImageCompare, seesAnEdgeMoveByAPixel) {
  const auto result = compareImages(disc(60, 40), disc(61, 40));
  EXPECT_FALSE(result.isSame);
  EXPECT_GT(result.worstDifference, 100);
  EXPECT_GT(result.meanDifference, 0.5);
}

// What another way of smoothing does: every pixel of the edge off by a tenth of the contrast,
// this way or that.
TEST(ImageCompare, doesNotSeeNoiseAlongAnEdge) {
  const Image smooth = disc(60, 40);
  Image noisy = smooth;
  std::mt19937 engine(5);
  int changed = 0;
  for (Rgb& pixel : noisy.pixels()) {
    if (pixel == white || pixel == black) continue;
    const int level = std::clamp(pixel.red + (engine() % 2 == 0 ? 24 : -24), 0, 255);
    pixel.red = pixel.green = pixel.blue = static_cast<std::uint8_t>(level);
    ++changed;
  }
  EXPECT_GT(changed, 100);
  EXPECT_TRUE(compareImages(smooth, noisy).isSame);
  EXPECT_FALSE(compareImages(smooth, noisy, {.smoothing = 0}).isSame);
}

TEST(ImageCompare, withReachAnEdgeMayMoveByAPixelButNotByThree) {
  constexpr ImageCompareOptions loose{.smoothing = 0, .reach = 1};
  EXPECT_EQ(compareImages(disc(60, 40), disc(60.8, 40.3), loose).differingShare, 0.0);
  EXPECT_GT(compareImages(disc(60, 40), disc(63, 40), loose).differingShare, 0.005);
}

TEST(ImageCompare, findsAThinLineInEitherPicture) {
  const Image plain(100, 100, white);
  Image lined = plain;
  for (int x = 0; x < 100; ++x) lined.at(x, 50) = black;
  // The line and, smoothed, a pixel on either side.
  EXPECT_NEAR(compareImages(plain, lined).differingShare, 0.03, 1e-12);
  EXPECT_NEAR(compareImages(lined, plain).differingShare, 0.03, 1e-12);
}

TEST(ImageCompare, findsASmallThingInALargePicture) {
  const Image plain(1280, 720, white);
  Image marked = plain;
  for (int y = 330; y < 350; ++y) {
    for (int x = 650; x < 670; ++x) marked.at(x, y) = black;
  }
  const auto result = compareImages(plain, marked);
  EXPECT_LT(result.differingShare, 0.001);
  EXPECT_GT(result.worstTileShare, 0.1);
  EXPECT_FALSE(result.isSame);
  EXPECT_TRUE(compareImages(plain, marked, {.mostDifferingInTile = 1.0}).isSame);
}

TEST(ImageCompare, allowsTheToleranceInEveryChannelAndNoMore) {
  const Image grey(40, 40, {100, 100, 100});
  for (int channel = 0; channel < 3; ++channel) {
    Image other = grey;
    for (Rgb& pixel : other.pixels()) {
      (channel == 0 ? pixel.red : channel == 1 ? pixel.green : pixel.blue) = 110;
    }
    EXPECT_EQ(compareImages(grey, other, {.tolerance = 10}).differingShare, 0.0);
    EXPECT_EQ(compareImages(grey, other, {.tolerance = 9}).differingShare, 1.0);
    EXPECT_EQ(compareImages(other, grey, {.tolerance = 9}).differingShare, 1.0);
  }
}

TEST(ImageCompare, saysWorstAndMeanDifference) {
  const Image first(2, 1, {10, 20, 30});
  Image second = first;
  second.at(1, 0) = {13, 18, 130};
  const auto result = compareImages(first, second);
  EXPECT_EQ(result.worstDifference, 100);
  EXPECT_DOUBLE_EQ(result.meanDifference, (3.0 + 2.0 + 100.0) / 6.0);
}

TEST(ImageCompare, picturesWhereTheyDiffer) {
  const Image plain(20, 20, white);
  Image marked = plain;
  marked.at(5, 7) = black;
  const Image difference = compareImages(plain, marked, {.smoothing = 0}).difference;
  const auto red = [&](int x, int y) {
    return difference.at(x, y).red > difference.at(x, y).green + 100;
  };
  EXPECT_TRUE(red(5, 7));
  EXPECT_FALSE(red(6, 7));
  EXPECT_FALSE(red(0, 0));
}

TEST(ImageCompare, rejectsWhatCannotBeCompared) {
  EXPECT_THROW(compareImages(Image(4, 5), Image(5, 4)), Error);
  EXPECT_THROW(compareImages(Image(4, 4), Image(4, 4), {.tolerance = 256}), Error);
  EXPECT_THROW(compareImages(Image(4, 4), Image(4, 4), {.reach = -1}), Error);
  EXPECT_THROW(compareImages(Image(4, 4), Image(4, 4), {.smoothing = 9}), Error);
  EXPECT_THROW(compareImages(Image(4, 4), Image(4, 4), {.mostDiffering = 1.1}), Error);
  EXPECT_THROW(compareImages(Image(4, 4), Image(4, 4), {.mostDifferingInTile = -0.1}), Error);
}

}  // namespace
}  // namespace bumper
