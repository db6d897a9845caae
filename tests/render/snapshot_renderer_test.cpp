#include "bumper/render/snapshot_renderer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "bumper/render/image_compare.h"
#include "bumper/response/error.h"
#include "bumper/scenes/paper_scenes.h"
#include "find_in_image.h"
#include "synthetic_run.h"

namespace bumper {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::findPatches;
using ::testing::HasSubstr;
using testing::hullOf;
using testing::isMarkColour;
using testing::isPaint;

/// Pixels within which what is drawn lies where it should.
constexpr double placeTolerance = 1.5;
/// The share of pixels in which Mesa's two libraries may differ.
constexpr double backendTolerance = 0.001;

constexpr SnapshotView allViews[] = {SnapshotView::top, SnapshotView::three_quarter,
                                     SnapshotView::chase, SnapshotView::fixed, SnapshotView::orbit};

SnapshotOptions optionsFor(SnapshotView view) {
  SnapshotOptions options;
  options.width = 640;
  options.height = 360;
  options.view = view;
  options.fixed = {{30.0, 45.0, 25.0}, {52.0, 2.0, 0.5}, 50.0};
  return options;
}

SnapshotOptions bare(SnapshotView view) {
  SnapshotOptions options = optionsFor(view);
  options.showPath = options.showImpacts = options.showScaleBar = options.showTitle = false;
  options.showTimes = false;
  return options;
}

double distanceToMark(const Image& image, const Vector2d& place) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& patch : findPatches(image, isMarkColour))
    least = std::min(least, (patch.centroid - place).norm());
  return least;
}

std::size_t count(const Image& image, const testing::ColourTest& belongs) {
  return static_cast<std::size_t>(std::ranges::count_if(image.pixels(), belongs));
}

std::string messageOf(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

/// Straight ahead along y = 10 m at 10 m/s for 6 s, turning about itself all the while.
Recording spinning(double turns) {
  Recording run;
  const std::size_t car = run.addVehicle("saloon", testing::saloon());
  for (int k = 0; k <= 600; ++k) {
    RecordedPose pose;
    pose.time = 0.01 * k;
    pose.position = {0.1 * k, 10.0, testing::saloon().massCentreHeight};
    pose.velocity.x() = 10.0;
    pose.orientation =
        Eigen::AngleAxisd(2.0 * std::numbers::pi * turns * k / 600.0, Vector3d::UnitZ());
    run.addPose(car, pose);
  }
  return run;
}

class EveryBackend : public ::testing::TestWithParam<OffscreenBackend> {};

TEST_P(EveryBackend, isTheOneThatWasAskedFor) {
  EXPECT_EQ(SnapshotRenderer(testRail(), GetParam()).backend(), GetParam());
}

TEST_P(EveryBackend, drawsOneAfterTheOtherAsEachAlone) {
  const Recording run = testing::testRailRun();
  SnapshotRenderer renderer(testRail(), GetParam());
  for (const SnapshotView view : allViews) {
    SnapshotOptions options = optionsFor(view);
    if (view == SnapshotView::chase) options.width = 480;
    EXPECT_EQ(renderer.draw(run, options), renderSnapshot(testRail(), run, options, GetParam()));
  }
}

TEST_P(EveryBackend, marksEveryImpactInEveryView) {
  const Recording run = testing::testRailRun();
  SnapshotRenderer renderer(testRail(), GetParam());
  for (const SnapshotView view : allViews) {
    SnapshotOptions options = optionsFor(view);
    options.moment = 2.5;
    options.instants = {0.0, 2.5};
    const Image image = renderer.draw(run, options);
    int seen = 0;
    for (std::size_t k = 0; k < run.impacts().size(); ++k) {
      const auto place = renderer.project(run, options, run.impacts()[k].event().contact);
      if (!place || (place->array() < 12.0).any() || place->x() > options.width - 12.0 ||
          place->y() > options.height - 12.0)
        continue;
      ++seen;
      EXPECT_LT(distanceToMark(image, *place), placeTolerance) << static_cast<int>(view);
      // The same picture without the impact has no mark there.
      const Image less = renderer.draw(testing::withoutImpact(run, k), options);
      if (view != SnapshotView::three_quarter && view != SnapshotView::orbit) {
        EXPECT_GT(distanceToMark(less, *place), placeTolerance) << static_cast<int>(view);
      }
    }
    EXPECT_GT(seen, 0) << static_cast<int>(view);
  }
}

TEST_P(EveryBackend, goesOnAfterAnErrorAndInOtherThreads) {
  const Recording run = testing::testRailRun();
  SnapshotRenderer renderer(testRail(), GetParam());
  const SnapshotOptions options = optionsFor(SnapshotView::top);
  const Image first = renderer.draw(run, options);
  SnapshotOptions wrong = options;
  wrong.moment = 99.0;
  EXPECT_THROW(renderer.draw(run, wrong), Error);
  Image second(1, 1);
  std::jthread([&] { second = renderer.draw(run, options); }).join();
  EXPECT_EQ(second, first);
  SnapshotRenderer moved = std::move(renderer);
  EXPECT_EQ(moved.draw(run, options), first);
}

INSTANTIATE_TEST_SUITE_P(Backends, EveryBackend, ::testing::ValuesIn(builtBackends()),
                         [](const auto& instance) {
                           return instance.param == OffscreenBackend::osmesa ? "osmesa" : "egl";
                         });

TEST(Backends, drawAlike) {
  if (builtBackends().size() < 2) GTEST_SKIP() << "bumper was built with one backend";
  const Recording run = testing::courseRun();
  SnapshotRenderer osmesa(course(), OffscreenBackend::osmesa);
  SnapshotRenderer egl(course(), OffscreenBackend::egl);
  for (const SnapshotView view : allViews) {
    const SnapshotOptions options = optionsFor(view);
    const auto comparison = compareImages(osmesa.draw(run, options), egl.draw(run, options));
    EXPECT_LE(comparison.differingShare, backendTolerance) << static_cast<int>(view);
  }
}

TEST(Replay, showsWhatHasHappenedSoFar) {
  const Recording run = testing::testRailRun();
  SnapshotRenderer renderer(testRail());
  SnapshotOptions options = optionsFor(SnapshotView::top);
  const Vector3d last = run.impacts()[2].event().contact;
  options.moment = 2.4;
  EXPECT_GT(distanceToMark(renderer.draw(run, options), *renderer.project(run, options, last)),
            placeTolerance);
  options.moment = 2.5;
  EXPECT_LT(distanceToMark(renderer.draw(run, options), *renderer.project(run, options, last)),
            placeTolerance);
}

TEST(Replay, standsStillInTheFrameOfTheWholeRun) {
  const Recording run = testing::testRailRun();
  const SnapshotRenderer renderer(testRail());
  for (const SnapshotView view : {SnapshotView::top, SnapshotView::three_quarter}) {
    SnapshotOptions options = optionsFor(view);
    const Vector3d place(50.0, 1.0, 0.0);
    const Vector2d whole = *renderer.project(run, options, place);
    for (const double moment : {0.0, 1.2, 4.0}) {
      options.moment = moment;
      EXPECT_LT((*renderer.project(run, options, place) - whole).norm(), 1e-9);
    }
  }
}

TEST(Replay, theCarIsWhereItWas) {
  const Recording run = testing::testRailRun();
  SnapshotRenderer renderer(testRail());
  SnapshotOptions options = bare(SnapshotView::top);
  options.width = 1280;
  options.height = 720;
  for (const double moment : {0.5, 1.0, 2.0}) {
    options.moment = moment;
    const RecordedPose pose = *poseAt(run.vehicles()[0], moment);
    // The outline's middle is 0.15 m behind the mass centre.
    const Vector3d middle = pose.position - pose.orientation * Vector3d(0.15, 0.0, 0.0);
    std::vector<Vector2d> pixels;
    for (const auto& patch : findPatches(renderer.draw(run, options), isPaint))
      pixels.insert(pixels.end(), patch.pixels.begin(), patch.pixels.end());
    ASSERT_FALSE(pixels.empty());
    EXPECT_LT((hullOf(pixels).centroid - *renderer.project(run, options, middle)).norm(),
              placeTolerance);
  }
}

TEST(Replay, rejectsAMomentOutsideTheRun) {
  SnapshotRenderer renderer(testRail());
  SnapshotOptions options;
  for (const double moment : {-0.1, 9.0, std::numeric_limits<double>::quiet_NaN()}) {
    options.moment = moment;
    EXPECT_THAT(messageOf([&] { renderer.draw(testing::testRailRun(), options); }),
                HasSubstr("SnapshotOptions::moment"));
  }
  EXPECT_THAT(messageOf([&] { renderer.draw({}, options); }), HasSubstr("nothing was recorded"));
}

TEST(ChaseView, looksAlongTheWayAndTurnsGently) {
  const Recording run = spinning(2.0);
  const SnapshotRenderer renderer(testRail());
  SnapshotOptions options = bare(SnapshotView::chase);
  std::vector<Vector2d> places;
  for (int k = 0; k <= 40; ++k) {
    options.moment = 4.0 + 0.05 * k;
    const RecordedPose pose = *poseAt(run.vehicles()[0], *options.moment);
    const auto car = renderer.project(run, options, pose.position);
    ASSERT_TRUE(car);
    // 40 m of straight way: the rope lies along it, whatever the car's heading.
    EXPECT_NEAR(car->x(), 0.5 * options.width, 2.0);
    EXPECT_GT(car->y(), 0.5 * options.height);
    EXPECT_LT(car->y(), 0.9 * options.height);
    const auto ahead = renderer.project(run, options, pose.position + Vector3d(100.0, 0.0, 0.0));
    EXPECT_NEAR(ahead->x(), 0.5 * options.width, 2.0);
    EXPECT_LT(ahead->y(), car->y());
    places.push_back(*car);
  }
  for (std::size_t k = 1; k < places.size(); ++k)
    EXPECT_LT((places[k] - places[k - 1]).norm(), 1.0);
}

TEST(ChaseView, noWallStandsBetween) {
  const Recording run = spinning(0.0);
  const Scene wall = straightWall({35.0, 0.0}, {35.0, 20.0}, 6.0);
  SnapshotOptions options = bare(SnapshotView::chase);
  // 8 m behind the wall, 10 m of rope.
  options.moment = 4.0;
  EXPECT_GT(count(renderSnapshot(wall, run, options), isPaint), 2000U);
  // From where the rope ends the wall hides the car.
  options.view = SnapshotView::fixed;
  options.fixed = {{30.0, 10.0, 4.36}, {43.0, 10.0, 0.56}, 52.0};
  EXPECT_LT(count(renderSnapshot(wall, run, options), isPaint), 20U);
}

TEST(FixedView, isAPinholeCamera) {
  const SnapshotRenderer renderer(testRail());
  const SnapshotOptions options = optionsFor(SnapshotView::fixed);
  const Vector3d ahead = (options.fixed.target - options.fixed.eye).normalized();
  const Vector3d right = ahead.cross(Vector3d::UnitZ()).normalized();
  const Vector3d up = right.cross(ahead);
  const double focal =
      0.5 * options.height / std::tan(0.5 * options.fixed.fieldOfView * std::numbers::pi / 180.0);
  for (const Vector3d& point : {Vector3d(52.0, 2.0, 0.5), {40.0, 0.0, 0.0}, {67.0, 4.0, 0.9}}) {
    const Vector3d way = point - options.fixed.eye;
    const Vector2d expected(0.5 * options.width + focal * right.dot(way) / ahead.dot(way),
                            0.5 * options.height - focal * up.dot(way) / ahead.dot(way));
    const auto place = renderer.project(testing::testRailRun(), options, point);
    ASSERT_TRUE(place);
    EXPECT_LT((*place - expected).norm(), 1e-6);
  }
}

TEST(FixedView, mayLookStraightDown) {
  SnapshotOptions options = bare(SnapshotView::fixed);
  options.fixed = {{20.0, 30.0, 40.0}, {20.0, 30.0, 0.0}, 40.0};
  const Recording run = testing::standingVehicle({20.0, 30.0}, 0.0);
  EXPECT_GT(count(renderSnapshot(testRail(), run, options), isPaint), 200U);
}

TEST(OrbitView, keepsItsCentreInTheMiddle) {
  const Recording run = testing::testRailRun();
  const SnapshotRenderer renderer(testRail());
  SnapshotOptions options = optionsFor(SnapshotView::orbit);
  const Vector2d middle(0.5 * options.width, 0.5 * options.height);
  for (const double angle : {-135.0, 0.0, 77.0}) {
    options.orbit = {};
    options.orbit.angle = angle;
    EXPECT_LT((*renderer.project(run, options, run.impacts()[2].event().contact) - middle).norm(),
              1e-6);
    options.orbit.around = OrbitCamera::Around::vehicle;
    EXPECT_LT(
        (*renderer.project(run, options, run.vehicles()[0].poses.back().position) - middle).norm(),
        1e-6);
    options.orbit.centre = Vector3d(1.0, 2.0, 3.0);
    EXPECT_LT((*renderer.project(run, options, {1.0, 2.0, 3.0}) - middle).norm(), 1e-6);
    // What is to the camera's right lies to the right: −sin, cos of its angle.
    const double a = angle * std::numbers::pi / 180.0;
    const Vector3d right = Vector3d(1.0, 2.0, 3.0) + Vector3d(-std::sin(a), std::cos(a), 0.0);
    EXPECT_GT(renderer.project(run, options, right)->x(), middle.x() + 10.0);
  }
}

TEST(VehicleMesh, standsInTheOutlineAtItsOwnSize) {
  // A green slab of 4 × 1 m, anywhere in its file.
  auto slab = std::make_shared<Scene>();
  slab->vertices = {{7.0, 3.0, 5.0}, {11.0, 3.0, 5.0}, {11.0, 4.0, 5.0}, {7.0, 4.0, 5.0}};
  slab->meshes = {{"slab", "paint", {0.1F, 0.9F, 0.1F}}};
  slab->triangles = {{{0, 1, 2}, 0}, {{0, 2, 3}, 0}};
  const auto isGreen = [](const Rgb& pixel) {
    return pixel.green > pixel.red + 60 && pixel.green > pixel.blue + 60;
  };
  const Recording run = testing::standingVehicle({20.0, 30.0}, 0.0);
  SnapshotOptions options = bare(SnapshotView::top);
  options.vehicleMeshes["saloon"] = slab;
  SnapshotRenderer renderer(straightWall({0.0, 0.0}, {60.0, 0.0}, 1.0));
  const Image image = renderer.draw(run, options);
  EXPECT_EQ(count(image, isPaint), 0U);
  const auto patches = findPatches(image, isGreen);
  ASSERT_EQ(patches.size(), 1U);
  const Vector2d middle = *renderer.project(run, options, {20.0 - 0.15, 30.0, 0.0});
  EXPECT_LT((patches[0].centroid - middle).norm(), placeTolerance);
  const double scale = (*renderer.project(run, options, {21.0, 30.0, 0.0}) -
                        *renderer.project(run, options, {20.0, 30.0, 0.0}))
                           .norm();
  EXPECT_NEAR(static_cast<double>(patches[0].pixels.size()), 4.0 * scale * scale,
              0.1 * 4.0 * scale * scale);
}

TEST(VehicleMesh, rejectsWhatCannotBeDrawn) {
  SnapshotRenderer renderer(testRail());
  SnapshotOptions options;
  options.vehicleMeshes["lorry"] = std::make_shared<Scene>(testRail());
  EXPECT_THAT(messageOf([&] { renderer.draw(testing::testRailRun(), options); }),
              HasSubstr("'lorry' is no vehicle"));
  options.vehicleMeshes = {{"saloon", nullptr}};
  EXPECT_THAT(messageOf([&] { renderer.draw(testing::testRailRun(), options); }),
              HasSubstr("'saloon' has no mesh"));
  options.vehicleMeshes = {{"saloon", std::make_shared<Scene>()}};
  EXPECT_THAT(messageOf([&] { renderer.draw(testing::testRailRun(), options); }),
              HasSubstr("'saloon'"));
}

TEST(Views, rejectWhatCannotBeSeen) {
  SnapshotRenderer renderer(testRail());
  const auto messageFor = [&](const SnapshotOptions& options) {
    return messageOf([&] { renderer.draw(testing::testRailRun(), options); });
  };
  SnapshotOptions options = optionsFor(SnapshotView::chase);
  options.chase.vehicle = 1;
  EXPECT_THAT(messageFor(options), HasSubstr("vehicle 1"));
  options.chase = {.distance = 1.0};
  EXPECT_THAT(messageFor(options), HasSubstr("ChaseCamera::distance is 1"));
  options.view = SnapshotView::fixed;
  options.fixed.target = options.fixed.eye;
  EXPECT_THAT(messageFor(options), HasSubstr("FixedCamera"));
  options.fixed = {.fieldOfView = 180.0};
  EXPECT_THAT(messageFor(options), HasSubstr("FixedCamera::fieldOfView is 180"));
  options.view = SnapshotView::orbit;
  options.orbit.elevation = 90.0;
  EXPECT_THAT(messageFor(options), HasSubstr("OrbitCamera::elevation is 90"));
}

TEST(Writing, hasAccentsAndGreek) {
  SnapshotOptions options = optionsFor(SnapshotView::top);
  std::vector<Image> drawn;
  for (const char* title : {"?", "°", "Δ", "é", "·"}) {
    options.title = title;
    drawn.push_back(renderSnapshot(testRail(), testing::testRailRun(), options));
  }
  for (std::size_t a = 0; a < drawn.size(); ++a) {
    for (std::size_t b = a + 1; b < drawn.size(); ++b) EXPECT_NE(drawn[a], drawn[b]);
  }
}

}  // namespace
}  // namespace bumper
