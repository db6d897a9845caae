// Cars that are put down over walls leave them slowly, straight and without energy, and what
// pushes a car on cannot keep it there.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "free_drive.h"
#include "sanitized.h"

namespace bumper::tests {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double h = 0.005;
constexpr double speedLimit = 2.0;  // m/s, of penetration recovery
constexpr int steps = 2000;         // 10 s

/// A closed block: eight corners, twelve triangles.
Scene block(const Vector2d& low, const Vector2d& high) {
  Scene scene;
  scene.meshes.emplace_back();
  for (const double z : {0.0, 2.0}) {
    scene.vertices.emplace_back(low.x(), low.y(), z);
    scene.vertices.emplace_back(high.x(), low.y(), z);
    scene.vertices.emplace_back(high.x(), high.y(), z);
    scene.vertices.emplace_back(low.x(), high.y(), z);
  }
  const auto addQuad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    scene.triangles.push_back({.corners = {a, b, c}});
    scene.triangles.push_back({.corners = {a, c, d}});
  };
  for (std::uint32_t k = 0; k < 4; ++k) addQuad(k, (k + 1) % 4, (k + 1) % 4 + 4, k + 4);
  addQuad(4, 5, 6, 7);
  addQuad(3, 2, 1, 0);
  return scene;
}

std::vector<Vector2d> around(const Vector2d& low, const Vector2d& high) {
  return {low, {high.x(), low.y()}, high, {low.x(), high.y()}, low};
}

/// Runs a car that was put down at rest and checks what holds for every such scene. `walls` are
/// what it must be out of at the end.
void expectOut(FreeDrive& drive, const std::vector<std::vector<Vector2d>>& walls, double thrust) {
  const Vector2d start = drive.position();
  const auto intrusion = [&] {
    double deepest = -1e9;
    for (const std::vector<Vector2d>& line : walls) {
      deepest = std::max(deepest, drive.intrusion(line));
    }
    return deepest;
  };
  Vector2d last = start;
  double fastest = 0.0;
  double path = 0.0;
  bool wasOut = false;  // half a second ago
  for (int i = 0; i < steps; ++i) {
    drive.step(h, thrust);
    fastest = std::max(fastest, (drive.position() - last).norm() / h);
    path += (drive.position() - last).norm();
    last = drive.position();
    if (i % 100 == 99) {
      const bool isOut = intrusion() <= 1e-3;
      if (isOut && wasOut) break;
      wasOut = isOut;
    }
  }
  EXPECT_LE(intrusion(), 1e-3) << "at " << last.transpose();
  if (thrust != 0.0) return;
  EXPECT_LE(fastest, speedLimit + 1e-9);
  EXPECT_LE(path, 1.2 * (last - start).norm() + 1e-3);
  EXPECT_LE(drive.energy(), 1e-9);
}

TEST(SpawnedInside, ABlock) {
  const Vector2d low(-1.0, -1.0);
  const Vector2d high(1.0, 1.0);
  for (const double thrust : {0.0, 4500.0}) {
    for (const bool asBox : {false, true}) {
      for (const Vector2d& place : {Vector2d(0.0, 0.0), Vector2d(0.0, 0.2), Vector2d(0.7, 0.3),
                                    Vector2d(1.3, -0.4), Vector2d(-2.0, 0.9)}) {
        for (const double yaw : {0.0, 0.4, 1.2}) {
          SCOPED_TRACE(testing::Message() << thrust << " N, box " << asBox << ", at "
                                          << place.transpose() << ", yaw " << yaw);
          FreeDrive drive;
          if (asBox) {
            const dGeomID geom = dCreateBox(drive.ode.space, 2.0, 2.0, 2.0);
            dGeomSetPosition(geom, 0.0, 0.0, 1.0);
            drive.responder.addBarrier(geom);
          } else {
            drive.responder.addBarrier(block(low, high));
          }
          drive.start(place, yaw, 0.0);
          expectOut(drive, {around(low, high)}, thrust);
        }
      }
    }
  }
}

// 10 cm thick, with the mass centre in it.
TEST(SpawnedInside, AThinWall) {
  const Vector2d low(-6.0, -0.05);
  const Vector2d high(6.0, 0.05);
  for (const double thrust : {0.0, 4500.0}) {
    for (const double across : {-0.03, 0.0, 0.01, 0.04}) {
      for (const double yaw : {0.0, 0.6, 1.5707963267948966, -2.0}) {
        SCOPED_TRACE(testing::Message() << thrust << " N, " << across << ", yaw " << yaw);
        FreeDrive drive;
        drive.responder.addBarrier(block(low, high));
        drive.start({0.4, across}, yaw, 0.0);
        expectOut(drive, {around(low, high)}, thrust);
      }
    }
  }
}

// The mass centre is on the free side of both walls, and stays there.
TEST(SpawnedInside, AnInsideCorner) {
  for (const double corner : {1.0, 1.5707963267948966, 2.2}) {
    for (const double thrust : {0.0, 4500.0}) {
      for (const double yaw : {0.0, 0.7, 1.9, -2.2}) {
        SCOPED_TRACE(testing::Message() << corner << ", " << thrust << " N, yaw " << yaw);
        const Vector2d along(std::cos(corner), std::sin(corner));
        const Vector2d into(std::cos(0.5 * corner), std::sin(0.5 * corner));
        const std::vector<Vector2d> line{{15.0, 0.0}, {0.0, 0.0}, 15.0 * along};
        FreeDrive drive;
        drive.responder.addBarrier(sheets(line));
        drive.start(0.6 / std::sin(0.5 * corner) * into, yaw, 0.0);
        expectOut(drive, {line}, thrust);
        const Vector2d end = drive.position();
        EXPECT_GT(end.y(), 0.0);
        EXPECT_GT(end.x() * along.y() - end.y() * along.x(), 0.0);
      }
    }
  }
}

/// Small, steep triangles without order; `cuts` are their parts at the heights of the band.
Scene leaves(std::mt19937_64& random, int count, const Vector2d& half,
             std::vector<std::vector<Vector2d>>& cuts) {
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  Scene scene;
  scene.meshes.emplace_back();
  for (int i = 0; i < count; ++i) {
    const Vector3d centre(half.x() * share(random), half.y() * share(random),
                          0.75 + 0.75 * share(random));
    const double heading = std::numbers::pi * share(random);
    const double lean = 0.2 * share(random);
    const Vector3d across(std::cos(heading), std::sin(heading), 0.0);
    const Vector3d up(-std::sin(lean) * std::sin(heading), std::sin(lean) * std::cos(heading),
                      std::cos(lean));
    std::array<Vector3d, 3> corners;
    const auto first = static_cast<std::uint32_t>(scene.vertices.size());
    for (Vector3d& corner : corners) {
      corner = centre + 0.1 * (share(random) * across + share(random) * up);
      scene.vertices.push_back(corner);
    }
    scene.triangles.push_back({.corners = {first, first + 1, first + 2}});
    // Sides cut at 0.3 and 0.75 m; a level cut joins two sides' cuts and lies between them.
    for (std::size_t k = 0; k < 3; ++k) {
      Vector3d a = corners[k];
      Vector3d b = corners[(k + 1) % 3];
      if (a.z() > b.z()) std::swap(a, b);
      if (b.z() < 0.3 || a.z() > 0.75) continue;
      const auto at = [&](double z) -> Vector2d {
        return (a + (z - a.z()) / (b.z() - a.z()) * (b - a)).head<2>();
      };
      cuts.push_back({a.z() < 0.3 ? at(0.3) : a.head<2>(), b.z() > 0.75 ? at(0.75) : b.head<2>()});
    }
  }
  return scene;
}

TEST(SpawnedInside, Leaves) {
  std::mt19937_64 random(7);
  for (const double thrust : {0.0, 4500.0}) {
    for (int run = 0; run < 2; ++run) {
      SCOPED_TRACE(testing::Message() << thrust << " N, run " << run);
      std::vector<std::vector<Vector2d>> cuts;
      FreeDrive drive;
      drive.responder.addBarrier(leaves(random, sanitized ? 500 : 2000, {2.0, 1.5}, cuts));
      drive.start({0.3 * run, 0.4}, 0.5 * run, 0.0);
      expectOut(drive, cuts, thrust);
    }
  }
}

// The end of a thin wall in front of the middle of the front: a car never takes the wall in.
class WallEnd : public ::testing::Test {
 protected:
  static constexpr double push = 6000.0;  // N
  const std::vector<Vector2d> line_{{0.0, 0.0}, {30.0, 0.0}};
};

TEST_F(WallEnd, IsNotDrivenOverInALongContact) {
  constexpr double speed = 15.0;
  for (const double contactTime : {0.02, 0.035, 0.05}) {
    for (const double aside : {0.0, 0.1, 0.3, -0.5}) {
      for (const double yaw : {0.0, 0.1}) {
        SCOPED_TRACE(testing::Message() << contactTime << ' ' << aside << ' ' << yaw);
        ResponseSettings settings;
        settings.contactTime = contactTime;
        settings.restitution = AngleCurve::constant(0.0);
        FreeDrive drive({.response = settings});
        drive.responder.addBarrier(sheets(line_));
        drive.start({-3.1, aside}, yaw, speed);
        double pulseEnd = 1e9;
        double deepest = -1.0;
        double later = -1.0;
        for (int i = 0; i < 1000; ++i) {
          for (const ImpactEvent& event : drive.step(h, push)) {
            if (pulseEnd > 1e8) pulseEnd = event.time + contactTime + h;
          }
          const double now = drive.intrusion(line_);
          double& most = i * h < pulseEnd ? deepest : later;
          most = std::max(most, now);
        }
        EXPECT_LE(deepest, 0.5 * speed * contactTime);
        // The turning car may meet the end again, at a third of its speed at most.
        EXPECT_LE(later, 0.5 * (1.0 + 1.0 / 3.0) * speed * contactTime);
        EXPECT_LE(drive.intrusion(line_), 1e-3);
      }
    }
  }
}

TEST_F(WallEnd, PutDownOnItACarIsPushedBack) {
  for (const double depth : {0.03, 0.049, 0.051, 0.1, 0.25, 0.5}) {
    for (const double aside : {0.0, 0.1, -0.3}) {
      for (const double yaw : {0.0, 0.2}) {
        SCOPED_TRACE(testing::Message() << depth << ' ' << aside << ' ' << yaw);
        FreeDrive drive;
        drive.responder.addBarrier(sheets(line_));
        drive.start({0.0, 0.0}, yaw, 0.0);
        // The wall's end is that far behind the front.
        const Vector2d place = drive.world({2.1 - depth, -aside});
        dBodySetPosition(drive.car.body, -place.x(), -place.y(), 0.55);
        const double start = drive.intrusion(line_);
        ASSERT_GE(start, 0.03 - 1e-9);
        double deepest = start;
        for (int i = 0; i < 1000; ++i) {
          drive.step(h, push);
          deepest = std::max(deepest, drive.intrusion(line_));
        }
        EXPECT_LE(deepest, start + 1e-3);
        EXPECT_LE(drive.intrusion(line_), 1e-3);
      }
    }
  }
}

}  // namespace
}  // namespace bumper::tests
