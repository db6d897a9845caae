// A finely meshed prop: its crowd of segments is answered as the few of a coarse one, and its
// outside is kept. The oracle for the outside is the distance of each end to the polygon.

#include "crowded_walls.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "box_car.h"
#include "bumper/engine_adapter/responder.h"
#include "bumper/scenes/scene.h"
#include "ode_world.h"

namespace bumper::tests {
namespace {

constexpr double radius = 0.05;

// A ball of so many rings, its triangles in any order.
Scene ball(int rings, const Eigen::Vector3d& middle) {
  Scene scene;
  scene.name = "ball";
  scene.meshes.resize(1);
  const int around = 2 * rings;
  for (int j = 0; j <= rings; ++j) {
    for (int i = 0; i < around; ++i) {
      const double polar = std::numbers::pi * j / rings;
      const double turn = std::numbers::pi * i / rings;
      scene.vertices.emplace_back(
          middle + radius * Eigen::Vector3d(std::sin(polar) * std::cos(turn),
                                            std::sin(polar) * std::sin(turn), std::cos(polar)));
    }
  }
  const auto vertex = [&](int i, int j) {
    return static_cast<std::uint32_t>(j * around + i % around);
  };
  for (int j = 0; j < rings; ++j) {
    for (int i = 0; i < around; ++i) {
      if (j > 0) {
        scene.triangles.push_back({{vertex(i, j), vertex(i + 1, j + 1), vertex(i + 1, j)}, 0});
      }
      if (j < rings - 1) {
        scene.triangles.push_back({{vertex(i, j), vertex(i, j + 1), vertex(i + 1, j + 1)}, 0});
      }
    }
  }
  std::mt19937 random(1);
  std::shuffle(scene.triangles.begin(), scene.triangles.end(), random);
  return scene;
}

struct Outcome {
  Eigen::Vector3d velocity;
  Eigen::Vector3d angular;
  std::size_t events = 0;
};

// A car whose front, or a corner of it, meets the ball at the height of its band.
Outcome afterMeeting(int rings, double aside) {
  OdeWorld ode;
  Responder responder(ode.world);
  BarrierOptions options;
  options.walls.maxNormalUp = 0.9;
  responder.addBarrier(ball(rings, {2.3, aside, 0.55}), options);
  BoxCar car(ode.world);
  responder.addVehicle(car.body, car.parameters);
  car.place({0.0, 0.0, 0.55}, Eigen::Matrix3d::Identity());
  car.move({20.0, 1.0, 0.0}, Eigen::Vector3d::Zero());
  Outcome outcome;
  for (int i = 0; i < 10; ++i) {
    outcome.events += responder.step(0.005).size();
    dWorldQuickStep(ode.world, 0.005);
  }
  outcome.velocity = car.velocity();
  outcome.angular = car.angularVelocity();
  return outcome;
}

TEST(CrowdedWalls, AFineBallIsHitAsACoarseOne) {
  for (const double aside : {0.0, 0.4, -0.7}) {
    const Outcome coarse = afterMeeting(6, aside);
    ASSERT_GT(coarse.events, 0U);
    ASSERT_LT(coarse.velocity.x(), 15.0);
    for (const int rings : {16, 40, 64}) {
      const Outcome fine = afterMeeting(rings, aside);
      EXPECT_EQ(fine.events, coarse.events) << rings;
      EXPECT_NEAR(fine.velocity.x(), coarse.velocity.x(), 0.3) << rings << ' ' << aside;
      EXPECT_NEAR(fine.velocity.y(), coarse.velocity.y(), 0.3) << rings << ' ' << aside;
      EXPECT_NEAR(fine.angular.z(), coarse.angular.z(), 0.1) << rings << ' ' << aside;
    }
  }
}

// So many segments of 5 mm, on a ring of a radius, around a place.
void addRing(std::vector<Segment>& segments, int count, const Vector2& middle, double size) {
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / count;
    const Vector2 out(std::cos(angle), std::sin(angle));
    Segment segment;
    segment.start = middle + size * out;
    segment.end = segment.start + 0.005 * turnedLeft(out);
    segment.normal = out;
    segment.id = static_cast<int>(segments.size());
    segments.push_back(segment);
  }
}

// How far a point is outside the nearest polygon: beyond all of its sides by no more than that.
double distanceTo(const std::vector<Segment>& sides, const Vector2& point) {
  double least = 1e9;
  for (const Segment& side : sides) {
    const Vector2 along = side.end - side.start;
    const double share =
        std::clamp((point - side.start).dot(along) / along.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (point - side.start - share * along).norm());
  }
  return least;
}

// A car in its own frame, beside all of these.
const Outline besides{VehicleParameters{.mass = 1500.0,
                                        .yawInertia = 2600.0,
                                        .massCentreToFront = 2.1,
                                        .massCentreToRear = 2.5,
                                        .width = 1.8,
                                        .massCentreHeight = 0.55}};

TEST(CrowdedWalls, OneThatAVehicleWasPutIntoStaysAsItIs) {
  std::vector<Segment> given;
  addRing(given, 300, {0.5, 0.2}, 0.06);
  std::vector<Segment> kept = given;
  CrowdedWalls crowds;
  crowds.reduce(kept, besides);
  EXPECT_EQ(kept.size(), given.size());
}

TEST(CrowdedWalls, FarTooManyAreReducedEvenThere) {
  std::vector<Segment> many;
  addRing(many, static_cast<int>(CrowdedWalls::mostEntered) + 1, {0.5, 0.2}, 0.06);
  CrowdedWalls crowds;
  crowds.reduce(many, besides);
  EXPECT_LE(many.size(), 16U);
}

TEST(CrowdedWalls, TheOutsideIsKept) {
  std::vector<Segment> given;
  addRing(given, 3000, {1.0, 2.0}, 0.06);
  addRing(given, 3000, {-1.0, 2.0}, 0.03);
  Segment wall;
  wall.start = {-5.0, 3.0};
  wall.end = {5.0, 3.0};
  wall.normal = {0.0, -1.0};
  given.push_back(wall);
  std::vector<Segment> few = given;
  CrowdedWalls crowds;
  crowds.reduce(few, besides);
  EXPECT_LE(few.size(), 2U * 16U + 1U);
  EXPECT_EQ(std::count_if(few.begin(), few.end(),
                          [&](const Segment& each) { return each.start == wall.start; }),
            1);
  for (const Segment& each : given) {
    EXPECT_LT(distanceTo(few, each.start), 0.02 * 0.12);
  }
  for (const Segment& side : few) {
    if (side.start == wall.start) continue;
    // It is a piece of what was given, and faces outwards.
    const Segment& own = given[static_cast<std::size_t>(side.id)];
    EXPECT_TRUE(side.start == own.start || side.start == own.end);
    const Vector2 middle(side.start.x() > 0.0 ? 1.0 : -1.0, 2.0);
    EXPECT_GT(side.normal.dot(side.start - middle), 0.0);
  }
}

TEST(CrowdedWalls, SurfacesStayApart) {
  std::vector<Segment> segments;
  addRing(segments, 200, {1.0, 2.0}, 0.06);
  for (Segment& each : segments) each.surface = each.id % 2;
  CrowdedWalls crowds;
  crowds.reduce(segments, besides);
  EXPECT_LE(segments.size(), 32U);
  for (const Segment& each : segments) EXPECT_EQ(each.surface, each.id % 2);
}

TEST(CrowdedWalls, AFewAreLeftAlone) {
  std::vector<Segment> segments;
  addRing(segments, static_cast<int>(CrowdedWalls::most), {1.0, 2.0}, 0.06);
  CrowdedWalls crowds;
  crowds.reduce(segments, besides);
  ASSERT_EQ(segments.size(), CrowdedWalls::most);
  EXPECT_EQ(segments[7].id, 7);
}

}  // namespace
}  // namespace bumper::tests
