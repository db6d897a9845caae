// What no vehicle on the ground can hit: by hand-made scenes, and by cars that stand anywhere on
// random hills with decks above them, cut with the walls by code of the tests' own.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <random>

#include "bumper/response/error.h"
#include "bumper/scenes/walls.h"
#include "standing_car.h"

namespace bumper {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

const WallSelection everything{.dropRepeated = false, .groundReach = std::nullopt};

void addQuad(Scene& scene, const Vector3d& a, const Vector3d& b, const Vector3d& c,
             const Vector3d& d) {
  if (scene.meshes.empty()) scene.meshes.resize(1);
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  scene.vertices.insert(scene.vertices.end(), {a, b, c, d});
  scene.triangles.push_back({{first, first + 1, first + 2}, 0});
  scene.triangles.push_back({{first, first + 2, first + 3}, 0});
}

/// A level rectangle.
void addFloor(Scene& scene, const Vector2d& low, const Vector2d& high, double height) {
  addQuad(scene, {low.x(), low.y(), height}, {high.x(), low.y(), height},
          {high.x(), high.y(), height}, {low.x(), high.y(), height});
}

/// A wall 4 m long, along x.
void addWall(Scene& scene, const Vector2d& place, double foot, double top) {
  const double x = place.x();
  const double y = place.y();
  addQuad(scene, {x, y, foot}, {x + 4.0, y, foot}, {x + 4.0, y, top}, {x, y, top});
}

Scene plain() {
  Scene scene;
  addFloor(scene, {-50, -50}, {50, 50}, 3.0);
  return scene;
}

TEST(GroundReach, KeepsWhatStandsOnTheGround) {
  Scene scene = plain();
  addWall(scene, {0, 0}, 3.0, 4.0);
  addWall(scene, {0, 5}, 3.0, 30.0);
  addWall(scene, {0, 10}, 6.9, 9.0);  // 3.9 m above the ground
  addWall(scene, {0, 15}, -9.0, 1.1);
  const WallReport report = selectWalls(scene).report;
  EXPECT_EQ(report.walls, 8U);
  EXPECT_EQ(report.dropped(), 2U);
}

TEST(GroundReach, DropsWhatHangsTooHigh) {
  Scene scene = plain();
  addWall(scene, {0, 0}, 3.0, 4.0);
  addWall(scene, {0, 5}, 7.1, 9.0);
  const Walls walls = selectWalls(scene);
  EXPECT_EQ(walls.report.walls, 2U);
  EXPECT_EQ(walls.report.droppedOverhead, 2U);
  EXPECT_EQ(walls.report.inDoubt, 0U);
  EXPECT_EQ(walls.report.highestTop, 4.0);
  EXPECT_EQ(walls.report.lowestFoot, 3.0);
  EXPECT_EQ(walls.report.walls + walls.report.dropped(), scene.triangles.size());
  EXPECT_EQ(walls.report.memory, 2 * sizeof(Wall));
}

TEST(GroundReach, KeepsWhatLiesBelowAllGround) {
  // What is over it may be a roof, and its own ground not in the scene.
  Scene scene = plain();
  addWall(scene, {0, 10}, -9.0, 0.9);
  const WallReport report = selectWalls(scene).report;
  EXPECT_EQ(report.walls, 2U);
  EXPECT_EQ(report.inDoubt, 2U);
}

TEST(GroundReach, IsASetting) {
  Scene scene = plain();
  addFloor(scene, {-20, -20}, {20, 20}, 13.0);
  addWall(scene, {0, 5}, 7.1, 8.0);
  addWall(scene, {0, 10}, 7.5, 10.9);
  EXPECT_EQ(selectWalls(scene).report.walls, 0U);
  EXPECT_EQ(selectWalls(scene, {.groundReach = std::nullopt}).report.walls, 4U);
  EXPECT_EQ(selectWalls(scene, {.groundReach = GroundReach{.above = 4.2}}).report.walls, 2U);
  EXPECT_EQ(selectWalls(scene, {.groundReach = GroundReach{.below = 2.2}}).report.walls, 2U);
}

TEST(GroundReach, IsNotLookedAtWithoutGround) {
  Scene scene;
  addWall(scene, {0, 5}, 0.0, 1.0);
  addWall(scene, {0, 5}, 10.0, 12.0);
  EXPECT_EQ(selectWalls(scene).report.walls, 4U);
  // The top of a wall is none.
  addFloor(scene, {0, 5}, {4, 5.3}, 1.0);
  EXPECT_EQ(selectWalls(scene).report.walls, 4U);
}

TEST(GroundReach, KeepsWhatStandsWhereTheSceneHasNoGround) {
  Scene scene = plain();
  addWall(scene, {90, 0}, 20.0, 21.0);
  const WallReport report = selectWalls(scene).report;
  EXPECT_EQ(report.walls, 2U);
  EXPECT_EQ(report.withoutGround, 2U);
}

TEST(GroundReach, LooksAFewMetresAround) {
  Scene scene = plain();
  addFloor(scene, {0, -50}, {50, 50}, 23.0);
  addWall(scene, {-11, 0}, 23.0, 24.0);  // 7 m from the upper plain
  addWall(scene, {-40, 0}, 23.0, 24.0);
  EXPECT_EQ(selectWalls(scene).report.walls, 2U);
  EXPECT_EQ(selectWalls(scene).report.droppedOverhead, 2U);
}

TEST(GroundReach, KeepsWhatHangsWhereTheGroundBelowEnds) {
  // Beyond its end the ground may be as high as the wall.
  Scene scene = plain();
  addWall(scene, {46, 0}, 23.0, 24.0);  // at the end itself
  addWall(scene, {45, 5}, 23.0, 24.0);  // a metre before it
  addWall(scene, {44, 10}, 23.0, 24.0);
  const WallReport report = selectWalls(scene).report;
  EXPECT_EQ(report.inDoubt, 4U);
  EXPECT_EQ(report.droppedOverhead, 2U);
}

TEST(GroundReach, BeamsAreNoGround) {
  Scene scene = plain();
  // A gantry 14 m wide: a closed box of 0.5 x 0.5 m.
  addFloor(scene, {-7, 0}, {7, 0.5}, 10.0);
  addFloor(scene, {-7, 0}, {7, 0.5}, 10.5);
  for (const double y : {0.0, 0.5}) {
    addQuad(scene, {-7, y, 10.0}, {7, y, 10.0}, {7, y, 10.5}, {-7, y, 10.5});
  }
  EXPECT_EQ(selectWalls(scene).report.droppedOverhead, 4U);
}

TEST(GroundReach, KnowsStoreys) {
  Scene scene = plain();
  for (const double deck : {13.0, 23.0}) addFloor(scene, {-20, -20}, {20, 20}, deck);
  addWall(scene, {0, 0}, 3.0, 4.0);
  addWall(scene, {0, 1}, 13.0, 14.0);
  addWall(scene, {0, 2}, 23.0, 24.0);
  addWall(scene, {0, 3}, 7.5, 10.5);   // between the ground and the first deck
  addWall(scene, {0, 4}, 18.0, 20.0);  // between the decks
  addWall(scene, {0, 5}, 27.5, 28.0);
  EXPECT_EQ(selectWalls(scene).report.walls, 6U);
  EXPECT_EQ(selectWalls(scene).report.droppedOverhead, 2U);
  EXPECT_EQ(selectWalls(scene).report.droppedBuried, 4U);
}

TEST(GroundReach, KeepsTheFootOfAHouseWhoseRoofIsTheOnlyGround) {
  Scene scene;
  addFloor(scene, {0, 0}, {4, 10}, 10.0);
  for (int row = 0; row < 10; ++row) addWall(scene, {0, 0}, row, row + 1.0);
  EXPECT_EQ(selectWalls(scene).report.walls, 20U);
}

TEST(GroundReach, RejectsWhatIsNoDistance) {
  const Scene scene = plain();
  for (const double bad :
       {-1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THAT([&] { selectWalls(scene, {.groundReach = GroundReach{.distance = bad}}); },
                ThrowsMessage<Error>(HasSubstr("GroundReach::distance")));
    EXPECT_THAT([&] { selectWalls(scene, {.groundReach = GroundReach{.above = bad}}); },
                ThrowsMessage<Error>(HasSubstr("GroundReach::above")));
    EXPECT_THAT([&] { selectWalls(scene, {.groundReach = GroundReach{.below = bad}}); },
                ThrowsMessage<Error>(HasSubstr("GroundReach::below")));
  }
}

/// Hills, with decks over parts of them, and walls anywhere between deep below and high above.
class RandomScene {
 public:
  explicit RandomScene(std::uint64_t seed) : random_(seed) {
    for (Wave& wave : waves_) {
      wave = {uniform(0.0, 3.0), uniform(0.02, 0.12), uniform(0.0, 6.3), uniform(0.0, 6.3)};
    }
    storeys_ = 1 + static_cast<int>(uniform(0.0, 3.0));
    rise_ = uniform(4.0, 15.0);
    for (int storey = 0; storey < storeys_; ++storey) addSheet(storey);
    for (int i = 0; i < 300; ++i) addRandomWall();
  }

  Scene scene;

  double uniform(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random_);
  }

  [[nodiscard]] int storeys() const { return storeys_; }

  /// Of the ground's triangles, not of the hills that they follow.
  [[nodiscard]] double height(const Vector2d& place, int storey) const {
    const Vector2d cell(std::floor(place.x() / mesh), std::floor(place.y() / mesh));
    const Vector2d share = place / mesh - cell;
    const auto corner = [&](int i, int k) { return hill((cell + Vector2d(i, k)) * mesh, storey); };
    const double diagonal = corner(1, 1) - corner(0, 0);
    return corner(0, 0) + (share.x() > share.y()
                               ? share.x() * (corner(1, 0) - corner(0, 0)) +
                                     share.y() * (diagonal - corner(1, 0) + corner(0, 0))
                               : share.y() * (corner(0, 1) - corner(0, 0)) +
                                     share.x() * (diagonal - corner(0, 1) + corner(0, 0)));
  }

  /// Nothing if it would lean beyond 30°.
  std::optional<tests::StandingCar> car() {
    const int storey = static_cast<int>(uniform(0.0, storeys_));
    const Vector2d place(uniform(-30.0, 30.0), uniform(-30.0, 30.0));
    const double yaw = uniform(-std::numbers::pi, std::numbers::pi);
    const Vector2d forward(std::cos(yaw), std::sin(yaw));
    const Vector2d left(-forward.y(), forward.x());
    const double size = uniform(1.0, 2.5);
    std::array<Vector3d, 4> wheels;
    for (std::size_t i = 0; i < 4; ++i) {
      const Vector2d wheel = place + (i < 2 ? 1.0 : -1.0) * 1.3 * size * forward +
                             (i % 2 == 0 ? 1.0 : -1.0) * std::min(0.9 * size, 1.3) * left;
      wheels.at(i) << wheel, height(wheel, storey);
    }
    const tests::StandingCar result =
        tests::carOn(wheels, 0.9 * size, 0.3, uniform(0.75, 1.0) * size);
    if (result.axes(2, 2) < std::cos(30.0 * std::numbers::pi / 180.0)) return std::nullopt;
    return result;
  }

 private:
  struct Wave {
    double height, number, phase, direction;
  };
  static constexpr double mesh = 2.0;
  static constexpr int half = 20;  // cells to each side

  [[nodiscard]] double hill(const Vector2d& place, int storey) const {
    double height = storey * rise_;
    for (const Wave& wave : waves_) {
      const Vector2d direction(std::cos(wave.direction), std::sin(wave.direction));
      height += wave.height * std::sin(wave.phase + 6.3 * wave.number * direction.dot(place));
    }
    return height;
  }

  void addSheet(int storey) {
    const auto vertex = [&](int i, int k) {
      const Vector2d place(mesh * i, mesh * k);
      return Vector3d(place.x(), place.y(), hill(place, storey));
    };
    for (int i = -half; i < half; ++i) {
      for (int k = -half; k < half; ++k) {
        addQuad(scene, vertex(i, k), vertex(i + 1, k), vertex(i + 1, k + 1), vertex(i, k + 1));
      }
    }
  }

  void addRandomWall() {
    const Vector2d place(uniform(-35.0, 35.0), uniform(-35.0, 35.0));
    const double above = uniform(-20.0, 35.0);
    const double yaw = uniform(-std::numbers::pi, std::numbers::pi);
    const double length = uniform(0.2, 8.0);
    const double tall = uniform(0.1, 4.0);
    const double lean = uniform(-0.25, 0.25) * tall;
    const Vector3d along(length * std::cos(yaw), length * std::sin(yaw), uniform(-0.5, 0.5));
    const Vector3d up(-lean * std::sin(yaw), lean * std::cos(yaw), tall);
    const Vector3d foot(place.x(), place.y(), height(place, 0) + above);
    addQuad(scene, foot, foot + along, foot + along + up, foot + up);
  }

  std::mt19937_64 random_;
  std::array<Wave, 3> waves_{};
  int storeys_ = 1;
  double rise_ = 0.0;
};

TEST(GroundReach, NoCarOnRandomHillsTouchesWhatIsDropped) {
  std::size_t touching = 0;
  std::size_t dropped = 0;
  std::size_t cars = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    RandomScene random(seed);
    const Walls all = selectWalls(random.scene, everything);
    const Walls kept = selectWalls(random.scene, {.dropRepeated = false});
    dropped += kept.report.droppedOverhead + kept.report.droppedBuried;
    ASSERT_LE(kept.report.walls, all.report.walls);
    for (int i = 0; i < 300; ++i) {
      const std::optional<tests::StandingCar> car = random.car();
      if (!car) continue;
      ++cars;
      const auto unreduced = tests::touchingWalls(*car, all.walls);
      touching += unreduced.size();
      ASSERT_EQ(tests::touchingWalls(*car, kept.walls), unreduced) << "scene " << seed;
    }
  }
  EXPECT_GT(cars, 3000U);
  EXPECT_GT(touching, 3000U);
  EXPECT_GT(dropped, 5000U);
}

}  // namespace
}  // namespace bumper
