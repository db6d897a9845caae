// What a scene hides, beside a test of every triangle; and scenes that hide everything.

#include "sight_lines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include "bumper/render/snapshot.h"
#include "bumper/response/error.h"
#include "bumper/scenes/paper_scenes.h"
#include "long_run.h"

namespace bumper::drawing {
namespace {

using Eigen::Vector3d;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// Where the nearest triangle cuts the way, from the linear system of plane and line.
double nearestCut(const Scene& scene, const Vector3d& from, const Vector3d& to) {
  double nearest = 1.0;
  for (const Scene::Triangle& triangle : scene.triangles) {
    const Vector3d& a = scene.corner(triangle, 0);
    Eigen::Matrix3d sides;
    sides << scene.corner(triangle, 1) - a, scene.corner(triangle, 2) - a, from - to;
    if (std::abs(sides.determinant()) < 1e-12) continue;
    const Vector3d place = sides.fullPivLu().solve(from - a);
    const bool isInside = place.x() >= 0.0 && place.y() >= 0.0 && place.x() + place.y() <= 1.0;
    if (isInside && place.z() > 0.0) nearest = std::min(nearest, place.z());
  }
  return nearest;
}

/// Triangles as large as the whole, one below the other.
Scene stack(std::uint32_t count) {
  constexpr double size = 1000.0;
  Scene scene;
  scene.meshes.resize(1);
  for (std::uint32_t k = 0; k < count; ++k) {
    const double z = -0.0625 * k;
    scene.vertices.insert(scene.vertices.end(),
                          {{-size, -size, z}, {size, -size, z}, {0.0, size, z}});
    scene.triangles.push_back({{3 * k, 3 * k + 1, 3 * k + 2}, 0});
  }
  return scene;
}

void expectLikeEveryTriangle(const Scene& scene, int count) {
  const SightLines sight(scene);
  const Eigen::AlignedBox3d& box = sight.box();
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(-0.1, 1.1);
  int cuts = 0;
  for (int k = 0; k < count; ++k) {
    const auto point = [&] {
      const Vector3d place(share(random), share(random), share(random));
      return Vector3d(box.min() + place.cwiseProduct(box.sizes() + Vector3d::Ones()));
    };
    const Vector3d from = point();
    Vector3d to = point();
    if (k % 4 == 0) to.y() = from.y();  // along an axis
    if (k % 8 == 0) to.z() = from.z();
    const double expected = nearestCut(scene, from, to);
    EXPECT_NEAR(sight.visibleShare(from, to), expected, 1e-9);
    cuts += expected < 1.0 ? 1 : 0;
  }
  EXPECT_GT(cuts, count / 20);
  EXPECT_LT(cuts, count);
}

TEST(SightLines, findTheNearestTriangle) {
  expectLikeEveryTriangle(course(), 400);
  expectLikeEveryTriangle(testRail(), 400);
  expectLikeEveryTriangle(stack(500), 200);
  expectLikeEveryTriangle(stack(1), 100);
}

TEST(SightLines, takeMemoryInProportionHoweverTheTrianglesLie) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer's allocator keeps what was freed";
#endif
  const Scene scene = stack(131072);
  const std::uint64_t before = testing::peakMemory();
  const SightLines sight(scene);
  constexpr double mostOfATriangle = 1000.0;  // bytes, with what building takes
  EXPECT_LT(static_cast<double>(testing::peakMemory() - before), mostOfATriangle * 131072);
  EXPECT_LT(sight.visibleShare({0.0, 0.0, 1.0}, {0.0, 0.0, -1e4}), 1e-3);
}

SnapshotOptions smallPicture() {
  SnapshotOptions options;
  options.width = 160;
  options.height = 120;
  return options;
}

TEST(PictureOfALargeMesh, isRefusedIfItsTrianglesLieInTooManyLayers) {
  SnapshotOptions options = smallPicture();
  EXPECT_THAT([&] { renderSnapshot(stack(131072), {}, options); },
              ThrowsMessage<Error>(HasSubstr("SnapshotOptions::mostOverdraw, 10000,")));
  options.mostOverdraw = 200.0;
  EXPECT_NO_THROW(renderSnapshot(stack(200), {}, options));
  EXPECT_THROW(renderSnapshot(stack(1000), {}, options), Error);
  options.mostOverdraw = 1e9;
  EXPECT_NO_THROW(renderSnapshot(stack(20000), {}, options));
}

TEST(PictureOfALargeMesh, isDrawnIfTheyLieBesideEachOther) {
  // 80,000 on the ground: a layer is some 400 of them in each square.
  constexpr std::uint32_t side = 200;
  Scene ground;
  ground.meshes.resize(1);
  for (std::uint32_t k = 0; k <= side; ++k) {
    for (std::uint32_t i = 0; i <= side; ++i) ground.vertices.emplace_back(k, i, 0.0);
  }
  for (std::uint32_t k = 0; k < side; ++k) {
    for (std::uint32_t i = 0; i < side; ++i) {
      const std::uint32_t a = k * (side + 1) + i;
      const std::uint32_t b = a + side + 1;
      ground.triangles.push_back({{a, b, b + 1}, 0});
      ground.triangles.push_back({{a, b + 1, a + 1}, 0});
    }
  }
  SnapshotOptions options = smallPicture();
  options.mostOverdraw = 1000.0;
  EXPECT_NO_THROW(renderSnapshot(ground, {}, options));
}

}  // namespace
}  // namespace bumper::drawing
