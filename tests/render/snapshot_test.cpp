#include "bumper/render/snapshot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
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
using testing::standingVehicle;

constexpr double degree = std::numbers::pi / 180.0;

/// Pixels within which what is drawn lies where it should.
constexpr double placeTolerance = 1.5;

/// The top view's camera, worked out from the words at SnapshotView::top.
struct TopView {
  double width;
  double height;
  Vector2d centre;
  double scale;
  bool turned;

  TopView(const Recording& run, const SnapshotOptions& options)
      : width(options.width), height(options.height) {
    Eigen::AlignedBox2d frame;
    double growth = 6.0;
    for (const RecordedVehicle& vehicle : run.vehicles()) {
      const auto& p = vehicle.parameters;
      growth = std::max(growth, 1.5 * (p.massCentreToFront + p.massCentreToRear));
      for (const RecordedPose& pose : vehicle.poses)
        frame.extend(Vector2d(pose.position.x(), pose.position.y()));
    }
    for (const RecordedImpact& impact : run.impacts()) {
      const Vector3d contact = impact.event().contact;
      frame.extend(Vector2d(contact.x(), contact.y()));
    }
    centre = frame.center();
    const double x = frame.sizes().x() + 2.0 * growth;
    const double y = frame.sizes().y() + 2.0 * growth;
    turned = width > height ? y > x : y <= x;
    scale = turned ? std::min(0.92 * width / y, 0.76 * height / x)
                   : std::min(0.92 * width / x, 0.76 * height / y);
  }

  [[nodiscard]] Vector2d pixel(const Vector3d& point) const {
    const double x = point.x() - centre.x();
    const double y = point.y() - centre.y();
    return turned ? Vector2d(0.5 * width + scale * y, 0.5 * height + scale * x)
                  : Vector2d(0.5 * width + scale * x, 0.5 * height - scale * y);
  }
};

/// `run` with x and y of everything exchanged by a turn to the left.
Recording turnedLeft(const Recording& run) {
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(90.0 * degree, Vector3d::UnitZ()));
  Recording result;
  for (const RecordedVehicle& vehicle : run.vehicles()) {
    const std::size_t index = result.addVehicle(vehicle.name, vehicle.parameters);
    for (RecordedPose pose : vehicle.poses) {
      pose.position = turn * pose.position;
      pose.velocity = turn * pose.velocity;
      pose.orientation = turn * pose.orientation;
      result.addPose(index, pose);
    }
  }
  for (const RecordedImpact& impact : run.impacts()) {
    ImpactEvent event = impact.event();
    event.contact = turn * event.contact;
    event.normal = turn * event.normal;
    result.addImpact(event);
  }
  return result;
}

SnapshotOptions bare() {
  SnapshotOptions options;
  options.showPath = options.showImpacts = options.showScaleBar = options.showTitle = false;
  options.showTimes = false;
  return options;
}

/// The distance from where an impact should be marked to the nearest patch of the marks' colour.
double distanceToMark(const Image& image, const Vector2d& place) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& patch : findPatches(image, isMarkColour))
    least = std::min(least, (patch.centroid - place).norm());
  return least;
}

/// The largest patch of a solid vehicle's paint.
testing::Hull carIn(const Image& image) {
  const auto patches = findPatches(image, isPaint);
  EXPECT_FALSE(patches.empty());
  const auto largest =
      std::ranges::max_element(patches, {}, [](const auto& patch) { return patch.pixels.size(); });
  // All of it: windows may part the paint.
  std::vector<Vector2d> pixels;
  for (const auto& patch : patches) {
    if ((patch.centroid - largest->centroid).norm() < 150.0)
      pixels.insert(pixels.end(), patch.pixels.begin(), patch.pixels.end());
  }
  return hullOf(pixels);
}

Image drawStanding(double heading) {
  return renderSnapshot(testRail(), standingVehicle({20.0, 30.0}, heading), bare());
}

/// Rad in (−π/2, π/2] between two axes.
double angleBetween(double a, double b) { return std::remainder(a - b, std::numbers::pi); }

struct Hit {
  Vector2d contact;
  Vector2d normal;
  double deltaV;
};

/// A car that drives along y = 10 m from x = 30 m to x = 60 m in 2 s and then back to `end`; its
/// impacts all happen at the turn.
Recording thereAndBack(double end, const std::vector<Hit>& hits) {
  Recording run;
  const VehicleParameters parameters = testing::saloon();
  const std::size_t car = run.addVehicle("saloon", parameters);
  for (int k = 0; k <= 60; ++k) {
    RecordedPose pose;
    pose.time = 0.05 * k;
    pose.position = {k <= 40 ? 30.0 + 0.75 * k : 60.0 + (end - 60.0) * (k - 40) / 20.0, 10.0,
                     parameters.massCentreHeight};
    pose.velocity.x() = k <= 40 ? 15.0 : end - 60.0;
    run.addPose(car, pose);
  }
  for (const Hit& hit : hits) {
    ImpactEvent event;
    event.time = 2.0;
    event.vehicle = "saloon";
    event.contact << hit.contact, parameters.massCentreHeight;
    event.normal << hit.normal, 0.0;
    event.deltaV = hit.deltaV;
    run.addImpact(event);
  }
  return run;
}

bool isInk(const Rgb& pixel) { return pixel.red < 40 && pixel.green < 45 && pixel.blue < 55; }

/// The longest run of a mark's and a label's colours along a row or a column.
int longestRun(const Image& image, Eigen::Vector2i from, const Eigen::Vector2i& step) {
  int longest = 0;
  int length = 0;
  for (; from.x() < image.width() && from.y() < image.height(); from += step) {
    const Rgb& pixel = image.at(from.x(), from.y());
    const bool white = pixel.red > 245 && pixel.green > 245 && pixel.blue > 245;
    length = isInk(pixel) || white || isMarkColour(pixel) ? length + 1 : 0;
    longest = std::max(longest, length);
  }
  return longest;
}

/// From an impact's mark to the tip of its arrow, for a normal that points up in the picture.
double tipAbove(const Image& image, const Vector2d& mark) {
  const int x = static_cast<int>(mark.x());
  int last = static_cast<int>(mark.y());
  for (int y = last; y > last - 12 || isInk(image.at(x, y + 1)); --y) {
    if (isInk(image.at(x, y))) last = y;
    if (y <= 1) break;
  }
  return mark.y() - last;
}

TEST(TopView, everyMarkIsAtItsContactPoint) {
  for (const bool upright : {false, true}) {
    const Recording run = upright ? turnedLeft(testing::testRailRun()) : testing::testRailRun();
    const SnapshotOptions options;
    const Image image = renderSnapshot(testRail(), run, options);
    const TopView view(run, options);
    EXPECT_EQ(view.turned, upright);
    for (const RecordedImpact& impact : run.impacts()) {
      const Vector3d contact = impact.event().contact;
      const auto projected = projectToSnapshot(testRail(), run, options, contact);
      ASSERT_TRUE(projected);
      EXPECT_LT((*projected - view.pixel(contact)).norm(), 1e-6);
      EXPECT_LT(distanceToMark(image, view.pixel(contact)), placeTolerance);
    }
  }
}

TEST(TopView, aMissingMarkIsNoticed) {
  const Recording run = testing::testRailRun();
  SnapshotOptions options;
  for (std::size_t missing = 0; missing < run.impacts().size(); ++missing) {
    const Recording less = testing::withoutImpact(run, missing);
    const Image image = renderSnapshot(testRail(), less, options);
    const Vector3d contact = run.impacts()[missing].event().contact;
    EXPECT_GT(distanceToMark(image, TopView(less, options).pixel(contact)), placeTolerance);
  }
}

TEST(TopView, theCarIsWhereItStands) {
  for (const double heading : {0.0, 35.0 * degree, 90.0 * degree, -160.0 * degree}) {
    const Recording run = standingVehicle({20.0, 30.0}, heading);
    const TopView view(run, bare());
    const auto car = carIn(drawStanding(heading));
    const RecordedVehicle& vehicle = run.vehicles()[0];
    const RecordedPose& pose = vehicle.poses[0];
    const double ahead =
        0.5 * (vehicle.parameters.massCentreToFront - vehicle.parameters.massCentreToRear);
    const Vector3d middle = pose.position + pose.orientation * Vector3d(ahead, 0.0, 0.0);
    EXPECT_LT((car.centroid - view.pixel(middle)).norm(), placeTolerance) << heading;
  }
}

TEST(TopView, theCarFillsItsOutline) {
  const Recording run = standingVehicle({20.0, 30.0}, 0.0);
  const double scale = TopView(run, bare()).scale;
  const VehicleParameters vehicle = testing::saloon();
  Eigen::AlignedBox2d box;
  for (const Vector2d& corner : carIn(drawStanding(0.0)).corners) box.extend(corner);
  const double length = vehicle.massCentreToFront + vehicle.massCentreToRear;
  // Lamps stick out of the paint by less than a hundredth of the length.
  EXPECT_NEAR(box.sizes().x() + 1.0, scale * length, 0.02 * scale * length);
  EXPECT_NEAR(box.sizes().y() + 1.0, scale * vehicle.width, 0.05 * scale * vehicle.width);
}

TEST(TopView, theCarPointsWhereItHeads) {
  constexpr double tolerance = 0.3 * degree;
  for (const double heading : {0.0, 20.0 * degree, -50.0 * degree}) {
    EXPECT_LT(std::abs(angleBetween(carIn(drawStanding(heading)).direction, -heading)), tolerance);
    // A degree more is not taken for the same.
    EXPECT_GT(std::abs(angleBetween(carIn(drawStanding(heading + degree)).direction, -heading)),
              2.0 * tolerance);
  }
}

TEST(TopView, frontAndRearDiffer) {
  const Image ahead = drawStanding(0.0);
  const auto car = carIn(ahead);
  const auto lamps = findPatches(ahead, [](const Rgb& pixel) {
    return pixel.red > 215 && pixel.green > 200 && pixel.blue > 140 && pixel.blue < pixel.red - 25;
  });
  ASSERT_GE(lamps.size(), 2U);
  for (const auto& lamp : lamps) EXPECT_GT(lamp.centroid.x(), car.centroid.x() + 40.0);
}

TEST(TopView, instantsChooseWhereTheCarIsAndWhatIsFramed) {
  const Recording run = testing::testRailRun();
  SnapshotOptions options = bare();
  options.instants = {1.0, 0.5};  // in any order: the latest is solid
  const Image image = renderSnapshot(testRail(), run, options);
  const auto at = poseAt(run.vehicles()[0], 1.0);
  const auto place = projectToSnapshot(testRail(), run, options, at->position);
  // The frame is that of the 13.4 m between them, grown by 1.5 vehicles on every side.
  const double scale = std::min(0.92 * 1280.0 / (13.4 + 13.2), 0.76 * 720.0 / 13.2);
  const auto behind = projectToSnapshot(testRail(), run, options, at->position - Vector3d(1, 0, 0));
  EXPECT_NEAR((*place - *behind).norm(), scale, 0.05);
  // The outline's middle is 0.15 m behind the mass centre.
  EXPECT_LT((carIn(image).centroid - *place - Vector2d(-0.15 * scale, 0.0)).norm(), placeTolerance);
}

TEST(TopView, aVehicleThatHardlyMovesIsDrawnOnce) {
  // Its ghosts would lie over it while another goes by.
  Recording run;
  const std::size_t slow = run.addVehicle("slow", testing::saloon());
  const std::size_t fast = run.addVehicle("fast", testing::saloon());
  for (int k = 0; k <= 40; ++k) {
    const double time = 0.1 * k;
    run.addPose(slow, {.time = time, .position = {20.0 + 0.1 * time, 30.0, 0.56}});
    run.addPose(fast, {.time = time, .position = {15.0 * time, 40.0, 0.56}});
  }
  const SnapshotOptions options = bare();
  const Image image = renderSnapshot(testRail(), run, options);
  const double scale = TopView(run, options).scale;
  const auto paint = std::ranges::count_if(image.pixels(), isPaint);
  EXPECT_GT(static_cast<double>(paint), 0.4 * 4.40 * 1.70 * scale * scale);
}

TEST(TopView, theScaleBarIsOfRoundLengthAndToScale) {
  const Recording run = testing::testRailRun();
  const SnapshotOptions options;
  const Image image = renderSnapshot(testRail(), run, options);
  int longest = 0;
  for (int y = options.height * 3 / 4; y < options.height; ++y) {
    int length = 0;
    for (int x = 0; x < options.width / 2; ++x) {
      const Rgb& pixel = image.at(x, y);
      const bool ink = pixel.red < 60 && pixel.green < 60 && pixel.blue < 60;
      length = ink ? length + 1 : 0;
      longest = std::max(longest, length);
    }
  }
  EXPECT_NEAR(longest / TopView(run, options).scale, 10.0, 0.3);
}

TEST(TopView, arrowsAreProportionalToTheImpact) {
  SnapshotOptions options;
  options.showVehicles = options.showPath = false;
  const auto tips = [&](const std::vector<Hit>& hits) {
    const Recording run = thereAndBack(55.0, hits);
    const Image image = renderSnapshot(testRail(), run, options);
    std::vector<double> result;
    for (const RecordedImpact& impact : run.impacts()) {
      result.push_back(
          tipAbove(image, *projectToSnapshot(testRail(), run, options, impact.event().contact)));
    }
    return result;
  };
  const Vector2d up(0.0, 1.0);
  const auto strong = tips({{{33, 12}, up, 20.0}, {{43, 12}, up, 10.0}, {{53, 12}, up, 5.0}});
  const double full = 2.0 * (strong[0] - strong[1]);
  const double rim = strong[0] - full;
  // A tip ends in a part of a pixel.
  constexpr double tolerance = 3.0;
  EXPECT_GT(full, 50.0);
  EXPECT_GT(rim, 0.0);
  EXPECT_NEAR(strong[2], rim + 0.25 * full, tolerance);
  // The hardest has a full arrow from 5 m/s on.
  EXPECT_NEAR(tips({{{43, 12}, up, 5.0}})[0], rim + full, tolerance);
  EXPECT_NEAR(tips({{{43, 12}, up, 2.5}})[0], rim + 0.5 * full, tolerance);
}

TEST(TopView, weakImpactsAreDots) {
  const auto marksWith = [](double deltaV) {
    SnapshotOptions options;
    options.showVehicles = options.showPath = false;
    const Vector2d up(0.0, 1.0);
    const Recording run = thereAndBack(55.0, {{{35, 12}, up, 20.0}, {{50, 12}, up, deltaV}});
    return findPatches(renderSnapshot(testRail(), run, options), isMarkColour);
  };
  // A mark, and the field behind its number.
  EXPECT_EQ(marksWith(2.1).size(), 4U);
  const auto marks = marksWith(1.9);
  ASSERT_EQ(marks.size(), 3U);
  const auto smallest =
      std::ranges::min_element(marks, {}, [](const auto& patch) { return patch.pixels.size(); });
  EXPECT_GT(smallest->pixels.size(), 20U);
  for (auto patch = marks.begin(); patch != marks.end(); ++patch) {
    if (patch == smallest) continue;
    EXPECT_GT(patch->pixels.size(), 2 * smallest->pixels.size());
  }
}

TEST(TopView, wallsStandOutFromGroundOfTheirColour) {
  Scene scene = testRail();
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  for (const auto& [x, z] : {std::pair{30.0, 0.0}, {60.0, 0.0}, {60.0, 1.0}, {30.0, 1.0}})
    scene.vertices.emplace_back(x, 15.0, z);
  const auto grey = static_cast<std::uint32_t>(scene.meshes.size());
  scene.meshes.push_back({"wall", "wall", {0.37F, 0.38F, 0.39F}});
  scene.triangles.push_back({{first, first + 1, first + 2}, grey});
  scene.triangles.push_back({{first, first + 2, first + 3}, grey});
  const Recording run = thereAndBack(55.0, {});
  const Image image = renderSnapshot(scene, run, bare());
  for (const double x : {32.0, 45.0, 58.0}) {
    const auto place = projectToSnapshot(scene, run, bare(), {x, 15.0, 1.0});
    const int column = static_cast<int>(place->x());
    const int row = static_cast<int>(place->y());
    int brightest = 0;
    for (int y = row - 1; y <= row + 1; ++y)
      brightest = std::max<int>(brightest, image.at(column, y).red);
    EXPECT_GT(brightest, image.at(column, row - 12).red + 60) << x;
  }
}

TEST(TopView, whatIsFarAboveDoesNotHideTheRun) {
  Scene scene = testRail();
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  for (const auto& [x, y] : {std::pair{-100.0, -100.0}, {200.0, -100.0}, {50.0, 300.0}})
    scene.vertices.emplace_back(x, y, 20.0);
  scene.meshes.push_back({"roof", "roof", {1.0F, 1.0F, 1.0F}});
  scene.triangles.push_back(
      {{first, first + 1, first + 2}, static_cast<std::uint32_t>(scene.meshes.size() - 1)});
  const Recording run = testing::testRailRun();
  // The scene's middle is another: single precision rounds otherwise.
  EXPECT_EQ(
      compareImages(renderSnapshot(scene, run), renderSnapshot(testRail(), run)).differingShare,
      0.0);
}

TEST(TopView, fasterIsLighter) {
  Recording run;
  const std::size_t car = run.addVehicle("car", testing::saloon());
  for (int k = 0; k <= 100; ++k) {
    RecordedPose pose;
    pose.time = k;
    pose.position = {0.4 * k, 30.0, testing::saloon().massCentreHeight};
    pose.velocity = {0.3 * k, 0.0, 0.0};
    run.addPose(car, pose);
  }
  SnapshotOptions options = bare();
  options.showPath = true;
  options.showVehicles = false;
  const Image image = renderSnapshot(testRail(), run, options);
  double last = 0.0;
  for (int k = 2; k <= 98; k += 4) {
    const auto place = projectToSnapshot(
        testRail(), run, options, run.vehicles()[0].poses[static_cast<std::size_t>(k)].position);
    const Rgb pixel = image.at(static_cast<int>(place->x()), static_cast<int>(place->y()));
    const double lightness = 0.2126 * pixel.red + 0.7152 * pixel.green + 0.0722 * pixel.blue;
    EXPECT_GT(lightness, last) << k;
    last = lightness;
  }
  EXPECT_GT(last, 200.0);
}

TEST(ThreeQuarterView, framesTheHardestImpact) {
  const struct {
    Scene scene;
    Recording run;
  } cases[] = {{testRail(), testing::testRailRun()}, {course(), testing::courseRun()}};
  for (const auto& [scene, run] : cases) {
    SnapshotOptions options;
    options.view = SnapshotView::three_quarter;
    const Image image = renderSnapshot(scene, run, options);
    const ImpactEvent hardest = run.impacts().back().event();
    const auto place = projectToSnapshot(scene, run, options, hardest.contact);
    ASSERT_TRUE(place);
    EXPECT_LT(distanceToMark(image, *place), placeTolerance);
    for (const RecordedPose& pose : run.vehicles()[0].poses) {
      if ((pose.position - hardest.contact).norm() > 15.0) continue;
      const auto seen = projectToSnapshot(scene, run, options, pose.position);
      ASSERT_TRUE(seen);
      EXPECT_GT(seen->x(), 0.05 * options.width);
      EXPECT_LT(seen->x(), 0.95 * options.width);
      EXPECT_GT(seen->y(), 0.05 * options.height);
      EXPECT_LT(seen->y(), 0.95 * options.height);
    }
    EXPECT_GT(carIn(image).corners.size(), 3U);
  }
}

TEST(Snapshot, showsAGhostAtTheHardestImpact) {
  // The car ends half a length behind the place of the impact: only a ghost reaches to the wall.
  const Recording run =
      thereAndBack(58.0, {{{62.05, 10.0}, {-1.0, 0.0}, 20.0}, {{32.0, 10.0}, {-1.0, 0.0}, 3.0}});
  for (const auto view : {SnapshotView::top, SnapshotView::three_quarter}) {
    SnapshotOptions options = bare();
    options.view = view;
    const Image image = renderSnapshot(testRail(), run, options);
    const auto place = projectToSnapshot(testRail(), run, options, {61.3, 10.0, 0.6});
    int ghost = 0;
    for (int y = -12; y <= 12; ++y) {
      for (int x = -12; x <= 12; ++x) {
        const Rgb& pixel =
            image.at(static_cast<int>(place->x()) + x, static_cast<int>(place->y()) + y);
        if (pixel.red > pixel.green + 40 && pixel.green > pixel.red / 3) ++ghost;
      }
    }
    EXPECT_GT(ghost, 25);
  }
}

TEST(ThreeQuarterView, labelsLieInThePictureWhole) {
  SnapshotOptions options;
  options.view = SnapshotView::three_quarter;
  options.showVehicles = options.showPath = options.showTitle = false;
  // Labels stand where the arrow does not point to.
  Vector2d normal(0.0, 1.0);
  const auto runWith = [&](double x) {
    return thereAndBack(58.0, {{{62.05, 10.0}, {-1.0, 0.0}, 20.0}, {{x, 8.0}, normal, 2.1}});
  };
  // How far the second mark lies inside the picture, pixels.
  const auto inside = [&](double x) {
    const auto mark = projectToSnapshot(testRail(), runWith(x), options, {x, 8.0, 0.56});
    if (!mark) return -1e9;
    return std::min({mark->x(), options.width - mark->x(), mark->y(), options.height - mark->y()});
  };
  for (const double wanted : {-30.0, 12.0, 25.0, 40.0}) {
    double out = 30.0;
    double in = 58.0;
    ASSERT_LT(inside(out), wanted);
    ASSERT_GT(inside(in), wanted);
    for (int k = 0; k < 30; ++k) (inside(0.5 * (out + in)) < wanted ? out : in) = 0.5 * (out + in);
    for (const Vector2d& way : {Vector2d(0, 1), Vector2d(0, -1), Vector2d(1, 0), Vector2d(-1, 0)}) {
      normal = way;
      const Image image = renderSnapshot(testRail(), runWith(in), options);
      // A label is 30 pixels high and more than 150 wide, a mark 15, its arrow less.
      for (const int column : {0, options.width - 1})
        EXPECT_LT(longestRun(image, {column, 0}, {0, 1}), 24) << wanted;
      for (const int row : {0, options.height - 1})
        EXPECT_LT(longestRun(image, {0, row}, {1, 0}), 24) << wanted;
    }
  }
}

TEST(ThreeQuarterView, thePathDoesNotSinkIntoBumps) {
  Scene scene = testRail();
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  // A low ridge across the path.
  for (const auto& [x, z] : {std::pair{46.0, 0.0}, {48.0, 0.15}, {50.0, 0.0}}) {
    scene.vertices.emplace_back(x, 5.0, z);
    scene.vertices.emplace_back(x, 15.0, z);
  }
  const auto mesh = static_cast<std::uint32_t>(scene.meshes.size());
  scene.meshes.push_back({"ridge", "ground", {0.3F, 0.3F, 0.3F}});
  for (const std::uint32_t k : {first, first + 2}) {
    scene.triangles.push_back({{k, k + 2, k + 3}, mesh});
    scene.triangles.push_back({{k, k + 3, k + 1}, mesh});
  }
  const Recording run = thereAndBack(55.0, {{{62.05, 10.0}, {-1.0, 0.0}, 20.0}});
  SnapshotOptions options = bare();
  options.view = SnapshotView::three_quarter;
  options.showPath = true;
  options.showVehicles = false;
  const Image image = renderSnapshot(scene, run, options);
  for (const double x : {46.5, 47.5, 48.0, 48.5, 49.5}) {
    const auto place = projectToSnapshot(scene, run, options, {x, 10.0, 0.02});
    const Rgb& pixel = image.at(static_cast<int>(place->x()), static_cast<int>(place->y()));
    // Yellow: the top speed.
    EXPECT_GT(pixel.red, pixel.blue + 60) << x;
  }
}

TEST(ThreeQuarterView, looksOverNoWall) {
  // The end wall is hit, but from the side wall's other side that would hide the way there.
  const Recording run = testing::testRailRun();
  SnapshotOptions options;
  options.view = SnapshotView::three_quarter;
  const auto foot = projectToSnapshot(testRail(), run, options, {60.0, 0.96, 0.0});
  const auto road = projectToSnapshot(testRail(), run, options, {60.0, 2.0, 0.0});
  // The road before the wall is nearer to the camera: lower in the picture.
  EXPECT_GT(road->y(), foot->y());
}

TEST(ThreeQuarterView, doesNotProjectWhatIsBehindTheCamera) {
  SnapshotOptions options;
  options.view = SnapshotView::three_quarter;
  EXPECT_FALSE(projectToSnapshot(testRail(), testing::testRailRun(), options, {-500, 0, 0}));
}

TEST(Snapshot, isTheSameEveryTime) {
  for (const auto view : {SnapshotView::top, SnapshotView::three_quarter}) {
    SnapshotOptions options;
    options.view = view;
    const Image first = renderSnapshot(testRail(), testing::testRailRun(), options);
    EXPECT_EQ(renderSnapshot(testRail(), testing::testRailRun(), options), first);
  }
}

TEST(Snapshot, canBeMadeInSeveralThreads) {
  SnapshotOptions small;
  small.width = 320;
  small.height = 180;
  const Scene rail = testRail();
  const Recording run = testing::testRailRun();
  const Image expected = renderSnapshot(rail, run, small);
  std::vector<Image> drawn(2, Image(1, 1));
  {
    std::vector<std::jthread> threads;
    threads.reserve(drawn.size());
    for (Image& image : drawn)
      threads.emplace_back([&] { image = renderSnapshot(rail, run, small); });
  }
  for (const Image& image : drawn) EXPECT_EQ(image, expected);
}

TEST(Snapshot, showsASceneInWhichNothingHappened) {
  for (const auto view : {SnapshotView::top, SnapshotView::three_quarter}) {
    SnapshotOptions options;
    options.view = view;
    const Image image = renderSnapshot(testRail(), {}, options);
    // The dark ground of the scene, and no car.
    const auto ground = findPatches(image, [](const Rgb& pixel) { return pixel.red < 115; });
    EXPECT_TRUE(std::ranges::any_of(
        ground, [](const auto& patch) { return patch.pixels.size() > 50'000; }));
    EXPECT_TRUE(findPatches(image, isPaint).empty());
  }
}

TEST(Snapshot, overlaysCanBeLeftOut) {
  const Recording run = testing::testRailRun();
  const Image all = renderSnapshot(testRail(), run);
  for (bool SnapshotOptions::*part :
       {&SnapshotOptions::showVehicles, &SnapshotOptions::showPath, &SnapshotOptions::showImpacts,
        &SnapshotOptions::showScaleBar, &SnapshotOptions::showTimes, &SnapshotOptions::showTitle}) {
    SnapshotOptions options;
    options.*part = false;
    EXPECT_NE(renderSnapshot(testRail(), run, options), all);
  }
  EXPECT_TRUE(findPatches(renderSnapshot(testRail(), run, bare()), isMarkColour).empty());
}

TEST(Snapshot, drawsAnyTitle) {
  SnapshotOptions options;
  options.width = 320;
  options.height = 180;
  for (const char* title :
       {"35° at 60 mph", "\x80\xFF\n\t", "100 % {}",
        "a title far too long for a picture of this width, whatever the letters"}) {
    options.title = title;
    EXPECT_NO_THROW(renderSnapshot(testRail(), testing::testRailRun(), options)) << title;
  }
}

TEST(Snapshot, rejectsWhatCannotBeDrawn) {
  const auto messageFor = [](const Scene& scene, const SnapshotOptions& options) -> std::string {
    try {
      renderSnapshot(scene, testing::testRailRun(), options);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  };
  SnapshotOptions options;
  options.width = 8193;
  EXPECT_THAT(messageFor(testRail(), options), HasSubstr("SnapshotOptions::width is 8193"));
  options = {};
  options.height = 0;
  EXPECT_THAT(messageFor(testRail(), options), HasSubstr("SnapshotOptions::height is 0"));
  options = {};
  options.instants = {1.0, 4.5};
  EXPECT_THAT(messageFor(testRail(), options), HasSubstr("4.5 s"));
  options.instants = {std::numeric_limits<double>::quiet_NaN()};
  EXPECT_THAT(messageFor(testRail(), options), HasSubstr("nan"));
  Scene broken = testRail();
  broken.triangles[0].mesh = 99;
  EXPECT_NE(messageFor(broken, {}), "no error");
}

}  // namespace
}  // namespace bumper
