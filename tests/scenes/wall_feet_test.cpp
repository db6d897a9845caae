#include "bumper/scenes/wall_feet.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "bumper/scenes/walls.h"

namespace bumper::tests {
namespace {

using Points = std::vector<Eigen::Vector2d>;

/// Sheets along y from -5 to 5 m, each given as its cross-section, in quads of some size.
class Sheets {
 public:
  explicit Sheets(double fineness = 100.0) : fineness_(fineness) {
    scene.meshes.push_back({.name = "all", .material = "", .colour = {0.5F, 0.5F, 0.5F}});
  }

  /// Points (x, z); the number of the sheet.
  int add(const Points& section, double from = -5.0, double to = 5.0) {
    const auto count = [&](double size) {
      return std::max(1, static_cast<int>(std::ceil(size / fineness_)));
    };
    const int along = count(to - from);
    for (std::size_t k = 0; k + 1 < section.size(); ++k) {
      const Eigen::Vector2d across = section[k + 1] - section[k];
      const int rows = count(across.norm());
      const auto corner = [&](int i, int j) {
        const Eigen::Vector2d point = section[k] + across * i / rows;
        scene.vertices.emplace_back(point.x(), from + (to - from) * j / along, point.y());
        return static_cast<std::uint32_t>(scene.vertices.size() - 1);
      };
      for (int i = 0; i < rows; ++i) {
        for (int j = 0; j < along; ++j) {
          const std::uint32_t a = corner(i, j);
          const std::uint32_t b = corner(i + 1, j);
          const std::uint32_t c = corner(i + 1, j + 1);
          const std::uint32_t d = corner(i, j + 1);
          scene.triangles.push_back({.corners = {a, b, c}, .mesh = 0});
          scene.triangles.push_back({.corners = {a, c, d}, .mesh = 0});
          sheetOf_.insert(sheetOf_.end(), 2, sheets_);
        }
      }
    }
    return sheets_++;
  }

  /// The feet of a sheet; expects all or none of its triangles to be some.
  std::vector<WallFoot> feetOf(int sheet) const {
    std::vector<WallFoot> feet;
    for (const WallFoot& foot : wallFeet(scene, selectWalls(scene).walls)) {
      if (sheetOf_[static_cast<std::size_t>(foot.triangle)] == sheet) feet.push_back(foot);
    }
    if (!feet.empty()) {
      EXPECT_EQ(static_cast<long>(feet.size()),
                std::count(sheetOf_.begin(), sheetOf_.end(), sheet));
    }
    return feet;
  }
  bool isFoot(int sheet) const { return !feetOf(sheet).empty(); }

  Scene scene;

 private:
  double fineness_;
  int sheets_ = 0;
  std::vector<int> sheetOf_;
};

class WallFeet : public ::testing::TestWithParam<double> {
 protected:
  Sheets sheets{GetParam()};
};

TEST_P(WallFeet, APlinthIsAndTheWallAndTheRoadAreNot) {
  const int road = sheets.add({{-6.0, 0.0}, {-0.3, 0.0}});
  const int riser = sheets.add({{-0.3, 0.0}, {-0.3, 0.25}});
  const int ledge = sheets.add({{-0.3, 0.25}, {0.0, 0.25}});
  const int wall = sheets.add({{0.0, 0.25}, {0.0, 1.2}});
  EXPECT_FALSE(sheets.isFoot(road));
  EXPECT_FALSE(sheets.isFoot(wall));
  for (const int sheet : {riser, ledge}) {
    const std::vector<WallFoot> feet = sheets.feetOf(sheet);
    ASSERT_FALSE(feet.empty());
    for (const WallFoot& foot : feet) {
      EXPECT_DOUBLE_EQ(foot.foot, 0.25);
      EXPECT_DOUBLE_EQ(foot.top, 1.2);
    }
  }
  // Windings may be wrong, and scenes lie anywhere.
  for (Scene::Triangle& triangle : sheets.scene.triangles) {
    std::swap(triangle.corners[0], triangle.corners[1]);
  }
  const Eigen::AngleAxisd turn(2.0, Eigen::Vector3d::UnitZ());
  for (Eigen::Vector3d& vertex : sheets.scene.vertices) {
    vertex = turn * vertex + Eigen::Vector3d(2e4, -5e3, 300.0);
  }
  EXPECT_TRUE(sheets.isFoot(riser));
  EXPECT_TRUE(sheets.isFoot(ledge));
  EXPECT_FALSE(sheets.isFoot(road));
}

TEST_P(WallFeet, WithinHalfAMetre) {
  sheets.add({{0.0, 0.0}, {0.0, 1.2}});
  const int near = sheets.add({{-0.49, 0.0}, {-0.49, 0.12}});
  const int far = sheets.add({{-0.51, 0.0}, {-0.51, 0.12}});
  const int behind = sheets.add({{0.3, 0.0}, {0.3, 0.12}});
  EXPECT_TRUE(sheets.isFoot(near));
  EXPECT_FALSE(sheets.isFoot(far));
  EXPECT_TRUE(sheets.isFoot(behind));
}

TEST_P(WallFeet, ASlopeIsAndABankIsNot) {
  sheets.add({{0.0, 0.33}, {0.0, 0.81}});
  const int slope = sheets.add({{-0.178, 0.075}, {0.0, 0.33}});
  const int toe = sheets.add({{-0.178, 0.0}, {-0.178, 0.075}});
  sheets.add({{20.0, 0.0}, {20.0, 1.0}});
  const int bank = sheets.add({{17.0, -1.5}, {20.0, 0.0}});
  EXPECT_TRUE(sheets.isFoot(slope));
  EXPECT_TRUE(sheets.isFoot(toe));
  EXPECT_FALSE(sheets.isFoot(bank));
}

TEST_P(WallFeet, ASidewalkIsGround) {
  const int kerb = sheets.add({{-1.5, 0.0}, {-1.5, 0.15}});
  const int sidewalk = sheets.add({{-1.5, 0.15}, {0.0, 0.15}});
  sheets.add({{0.0, 0.15}, {0.0, 1.2}});
  EXPECT_FALSE(sheets.isFoot(kerb));
  EXPECT_FALSE(sheets.isFoot(sidewalk));
}

// A guard rail that stands above its kerb without touching it.
TEST_P(WallFeet, BelowARailAndNotBelowABridge) {
  sheets.add({{0.0, 0.43}, {0.0, 0.75}});
  const int kerb = sheets.add({{-0.1, 0.0}, {-0.1, 0.12}});
  sheets.add({{20.0, 3.0}, {20.0, 4.0}});
  const int underBridge = sheets.add({{19.9, 0.0}, {19.9, 0.12}});
  EXPECT_TRUE(sheets.isFoot(kerb));
  EXPECT_FALSE(sheets.isFoot(underBridge));
}

// A fence on top of it, not in one line with it, is another wall.
TEST_P(WallFeet, StandsBeforeAllThatIsBehindIt) {
  sheets.add({{0.0, 0.33}, {0.0, 0.81}});
  sheets.add({{0.1, 0.81}, {0.1, 3.0}});
  const int slope = sheets.add({{-0.178, 0.075}, {0.0, 0.33}});
  for (const WallFoot& foot : sheets.feetOf(slope)) EXPECT_DOUBLE_EQ(foot.foot, 0.33);
  EXPECT_TRUE(sheets.isFoot(slope));
}

TEST_P(WallFeet, OfTheWallAloneTheLowWalls) {
  const int riser = sheets.add({{-0.3, 0.0}, {-0.3, 0.25}});
  const int ledge = sheets.add({{-0.3, 0.25}, {0.0, 0.25}});
  sheets.add({{0.0, 0.25}, {0.0, 1.2}});
  const std::vector<WallFoot> all = wallFeet(sheets.scene, selectWalls(sheets.scene).walls);
  const std::vector<WallFoot> low = wallFeet(selectWalls(sheets.scene).walls);
  EXPECT_EQ(low.size(), sheets.feetOf(riser).size());
  EXPECT_EQ(all.size(), low.size() + sheets.feetOf(ledge).size());
  const auto byTriangle = [](const WallFoot& a, const WallFoot& b) {
    return a.triangle < b.triangle;
  };
  EXPECT_TRUE(std::is_sorted(all.begin(), all.end(), byTriangle));
}

// Banked by 30°, up to a wall: as steep as ovals are.
TEST_P(WallFeet, ABankedRoadIsGround) {
  const int road = sheets.add({{-10.0, -10.0 * std::tan(std::numbers::pi / 6.0)}, {0.0, 0.0}});
  sheets.add({{0.0, 0.0}, {0.0, 1.0}});
  EXPECT_FALSE(sheets.isFoot(road));
}

INSTANTIATE_TEST_SUITE_P(Fineness, WallFeet, ::testing::Values(100.0, 0.3, 0.11));

// The ledge goes on round the corner, where the place before one wall lies on the other's ledge.
TEST(WallFeetRoundCorners, ALedgeRoundAnInsideCorner) {
  Sheets sheets(0.1);
  const int road = sheets.add({{-4.0, 0.0}, {-0.4, 0.0}}, -4.0, -0.4);
  const int ledge = sheets.add({{-4.0, 0.2}, {0.0, 0.2}}, -0.4, 0.0);
  const int other = sheets.add({{-0.4, 0.2}, {0.0, 0.2}}, -4.0, -0.4);
  sheets.add({{0.0, 0.2}, {0.0, 1.2}}, -4.0, 0.0);
  // The same wall, turned by a quarter about the corner.
  const std::size_t first = sheets.scene.vertices.size();
  const int wall = sheets.add({{0.0, 0.2}, {0.0, 1.2}}, 0.0, 4.0);
  for (std::size_t i = first; i < sheets.scene.vertices.size(); ++i) {
    Eigen::Vector3d& vertex = sheets.scene.vertices[i];
    vertex = {-vertex.y(), vertex.x(), vertex.z()};
  }
  EXPECT_FALSE(sheets.isFoot(road));
  EXPECT_TRUE(sheets.isFoot(ledge));
  EXPECT_TRUE(sheets.isFoot(other));
  EXPECT_FALSE(sheets.isFoot(wall));
}

// Large walls one upon another: the search gives up rather than compare each with each.
TEST(WallFeetOfHostileMeshes, TakeBoundedTime) {
  Scene scene;
  scene.meshes.push_back({.name = "all", .material = "", .colour = {0.5F, 0.5F, 0.5F}});
  for (std::uint32_t i = 0; i < 30000; ++i) {
    const double shift = 1e-4 * i;
    scene.vertices.insert(
        scene.vertices.end(),
        {{-500 + shift, -120, 0}, {500 + shift, 120, 0}, {shift, 0, 0.5 + shift}});
    scene.triangles.push_back({.corners = {3 * i, 3 * i + 1, 3 * i + 2}, .mesh = 0});
  }
  Walls walls = selectWalls(scene, {.groundReach = std::nullopt});
  for (Wall& wall : walls.walls) wall.foot = wall.top - 0.5;
  // Without a bound it takes seconds.
  EXPECT_LE(wallFeet(walls.walls).size(), walls.walls.size());
}

}  // namespace
}  // namespace bumper::tests
