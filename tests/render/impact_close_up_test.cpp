#include "bumper/render/impact_close_up.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <string>

#include "bumper/render/image_compare.h"
#include "bumper/response/error.h"
#include "bumper/scenes/paper_scenes.h"
#include "find_in_image.h"
#include "synthetic_run.h"

namespace bumper {
namespace {

using Eigen::Vector2d;
using ::testing::HasSubstr;
using testing::isMarkColour;

/// Where the numbers begin, of 1280 pixels.
constexpr int diagramWidth = 970;

/// A saloon along the x axis whose front right corner, or what `arm` says, hits a wall on its
/// right.
Recording hit(const Vector2d& arm) {
  Recording run = testing::standingVehicle({20.0, 30.0}, 0.0);
  ImpactEvent event;
  event.vehicle = "saloon";
  event.barrier = "wall";
  event.contact = {20.0 + arm.x(), 30.0 + arm.y(), 0.56};
  event.normal = {0.0, 1.0, 0.0};
  event.arm = arm;
  event.deltaV = event.approachSpeed = 4.0;
  event.impulseNormal = 4.0 * testing::saloon().mass;
  event.velocityAfter = {20.0, 1.0, 0.0};
  run.addImpact(event);
  return run;
}

Scene wall() { return straightWall({0.0, 29.15}, {60.0, 29.15}, 1.0); }

bool isOutline(const Rgb& pixel) { return pixel.red > 150 && pixel.green < 60 && pixel.blue < 60; }

/// Around all pixels of the diagram of a kind.
Eigen::AlignedBox2d extentOf(const Image& image, const testing::ColourTest& belongs) {
  Eigen::AlignedBox2d box;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < diagramWidth; ++x) {
      if (belongs(image.at(x, y))) box.extend(Vector2d(x + 0.5, y + 0.5));
    }
  }
  return box;
}

/// The longest run of ink in the lower left: the bar of one metre.
int barLength(const Image& image) {
  int longest = 0;
  for (int y = image.height() * 3 / 4; y < image.height(); ++y) {
    int length = 0;
    for (int x = 0; x < image.width() / 3; ++x) {
      const Rgb& pixel = image.at(x, y);
      length = pixel.red < 60 && pixel.green < 60 && pixel.blue < 70 ? length + 1 : 0;
      longest = std::max(longest, length);
    }
  }
  return longest;
}

class CloseUp : public ::testing::TestWithParam<OffscreenBackend> {};

TEST_P(CloseUp, isToScale) {
  const Image image = impactCloseUp(wall(), hit({2.05, -0.85}), 0, {}, GetParam());
  const double scale = barLength(image);
  ASSERT_GT(scale, 50.0);
  const Eigen::AlignedBox2d outline = extentOf(image, isOutline);
  // A line is some pixels wide, and so are the ends of the bar.
  EXPECT_NEAR(outline.sizes().x(), 4.40 * scale, 0.05 * 4.40 * scale);
  EXPECT_NEAR(outline.sizes().y(), 1.70 * scale, 0.05 * 4.40 * scale);
}

TEST_P(CloseUp, marksTheContactAtTheEndOfTheArm) {
  // Ahead and to the right of the mass centre, which is 2.35 m ahead of the rear.
  for (const Vector2d& arm : {Vector2d(2.05, -0.85), Vector2d(-1.0, -0.85)}) {
    const Image image = impactCloseUp(wall(), hit(arm), 0, {}, GetParam());
    const double scale = barLength(image);
    const Eigen::AlignedBox2d outline = extentOf(image, isOutline);
    const Vector2d contact(outline.min().x() + (2.35 + arm.x()) * scale,
                           outline.min().y() + (0.85 - arm.y()) * scale);
    double nearest = 1e9;
    for (const auto& patch : testing::findPatches(image, isMarkColour)) {
      for (const Vector2d& pixel : patch.pixels)
        nearest = std::min(nearest, (pixel - contact).norm());
    }
    EXPECT_LT(nearest, 8.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Backends, CloseUp, ::testing::ValuesIn(builtBackends()),
                         [](const auto& instance) {
                           return instance.param == OffscreenBackend::osmesa ? "osmesa" : "egl";
                         });

TEST(ImpactCloseUp, showsTheLineOfInterference) {
  // The right side 0.1 m behind the wall's line: a and b are the front and the rear corner's side.
  const Image inside = impactCloseUp(wall(), hit({1.0, -0.75}), 0);
  const Image touch = impactCloseUp(wall(), hit({2.05, -0.85}), 0);
  EXPECT_GT(compareImages(inside, touch).worstTileShare, 0.1);
}

/// Pixels of the diagram in the shade that lies behind the surface which was hit.
Eigen::AlignedBox2d shadeOf(const Scene& scene, const Recording& run) {
  const auto isShade = [](const Rgb& pixel) {
    return std::abs(pixel.red - 221) < 4 && std::abs(pixel.green - 213) < 4 &&
           std::abs(pixel.blue - 205) < 4;
  };
  return extentOf(impactCloseUp(scene, run, 0), isShade);
}

TEST(ImpactCloseUp, shadesTheWallAsFarAsItGoes) {
  const Recording run = hit({2.05, -0.85});
  const double scale = barLength(impactCloseUp(wall(), run, 0));
  // The contact is at x = 22.05 m.
  const Scene ending = straightWall({0.0, 29.15}, {23.05, 29.15}, 1.0);
  const Eigen::AlignedBox2d outline = extentOf(impactCloseUp(ending, run, 0), isOutline);
  EXPECT_NEAR(shadeOf(ending, run).max().x(), outline.max().x() + scale, 4.0);
  EXPECT_GT(shadeOf(wall(), run).max().x(), diagramWidth - 4);
  // A barrier that is not in the scene has no end.
  const Scene elsewhere = straightWall({0.0, 80.0}, {60.0, 80.0}, 1.0);
  EXPECT_GT(shadeOf(elsewhere, run).max().x(), diagramWidth - 4);
}

/// The second vehicle's paint as a line.
bool isOtherOutline(const Rgb& pixel) {
  return std::abs(pixel.red - 75) < 25 && pixel.green < 70 && pixel.blue > 185;
}

TEST(ImpactCloseUp, showsBothVehiclesWhereTheyHit) {
  const Scene none = straightWall({0.0, 80.0}, {60.0, 80.0}, 1.0);
  const Image image = impactCloseUp(none, testing::sideHit(), 0);
  const double scale = barLength(image);
  ASSERT_GT(scale, 50.0);
  const Eigen::AlignedBox2d outline = extentOf(image, isOutline);
  const Eigen::AlignedBox2d other = extentOf(image, isOtherOutline);
  EXPECT_NEAR(outline.sizes().x(), 4.40 * scale, 0.05 * 4.40 * scale);
  EXPECT_NEAR(other.sizes().y(), 4.40 * scale, 0.05 * 4.40 * scale);
  EXPECT_NEAR(other.sizes().x(), 1.70 * scale, 0.05 * 4.40 * scale);
  // The front at the side; the other one goes up and is a little ahead.
  EXPECT_NEAR(other.min().x(), outline.max().x(), 4.0);
  EXPECT_NEAR(other.min().y(), outline.center().y() - (0.4 + 2.05) * scale, 6.0);
  // The impulses go both ways from the contact, as far.
  const Eigen::AlignedBox2d marks = extentOf(image, isMarkColour);
  EXPECT_GT(outline.max().x() - marks.min().x(), 60.0);
  EXPECT_GT(marks.max().x() - outline.max().x(), 60.0);
}

TEST(ImpactCloseUp, aVehicleThatWasNotRecordedIsOnlyNamed) {
  const Recording whole = testing::sideHit();
  Recording half;
  half.addVehicle("saloon", testing::saloon());
  half.addPose(0, whole.vehicles()[0].poses[0]);
  half.addImpact(whole.impacts()[0].event());
  const Scene none = straightWall({0.0, 80.0}, {60.0, 80.0}, 1.0);
  const Image image = impactCloseUp(none, half, 0);
  EXPECT_TRUE(extentOf(image, isOtherOutline).isEmpty());
  EXPECT_FALSE(extentOf(image, isOutline).isEmpty());
  // As an older file has it: the other one stands where it was recorded.
  Recording old = testing::sideHit();
  ImpactEvent event = whole.impacts()[0].event();
  event.time = 1.0;
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  event.otherArm.setConstant(unknown);
  event.velocityBefore.setConstant(unknown);
  event.otherVelocityBefore.setConstant(unknown);
  event.otherVelocityAfter.setConstant(unknown);
  event.otherYawRateBefore = event.otherYawRateAfter = unknown;
  old.addImpact(event);
  const Image known = impactCloseUp(none, old, 0);
  const Image lacking = impactCloseUp(none, old, 1);
  EXPECT_NEAR(extentOf(lacking, isOtherOutline).min().x(),
              extentOf(known, isOtherOutline).min().x(), 3.0);
}

TEST(ImpactCloseUp, rejectsWhatCannotBeDrawn) {
  const auto messageFor = [](const Recording& run, std::size_t impact,
                             const CloseUpOptions& options) {
    try {
      impactCloseUp(wall(), run, impact, options);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  const Recording run = hit({2.05, -0.85});
  EXPECT_THAT(messageFor(run, 1, {}), HasSubstr("the recording has 1"));
  EXPECT_THAT(messageFor(run, 0, {.width = 100}), HasSubstr("CloseUpOptions::width is 100"));
  EXPECT_THAT(messageFor(run, 0, {.height = 9000}), HasSubstr("CloseUpOptions::height is 9000"));
  Recording unseen;
  unseen.addVehicle("saloon", testing::saloon());
  unseen.addImpact(run.impacts()[0].event());
  EXPECT_THAT(messageFor(unseen, 0, {}), HasSubstr("was not recorded"));
  Scene broken = wall();
  broken.triangles[0].mesh = 9;
  EXPECT_THROW(impactCloseUp(broken, run, 0), Error);
}

}  // namespace
}  // namespace bumper
