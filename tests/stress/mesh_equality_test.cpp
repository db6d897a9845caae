// The same two walls, however they are meshed: the same trajectory over several impacts.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "../response/random_impacts.h"
#include "bumper/engine_adapter/responder.h"
#include "ode_car.h"
#include "ode_joints.h"
#include "ode_world.h"
#include "plan.h"

namespace bumper::tests {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double sixtyMph = 26.8224;
constexpr double h = 0.005;
constexpr double duration = 5.0;
constexpr double sameTrajectory = 1e-6;  // m

// A lane of 8 m: off one wall to the other and back.
const Plan lane{{{-20.0, -4.0}, {200.0, -4.0}}, {{200.0, 4.0}, {-20.0, 4.0}}};

// Starts whose trajectories do not magnify: a shift of the start stays below 20 times as large over
// all impacts. Others, with a side nearly flush at some impact, magnify it 10,000 times, and 100 km
// from the origin a position has no more than 1.5e-11 m.
struct Start {
  double heading;  // deg against the walls
  double yawRate;  // rad/s
};
constexpr std::array<Start, 6> starts{
    {{12.0, 0.0}, {24.0, 0.5}, {28.0, 0.0}, {36.0, 0.0}, {64.0, 0.0}, {68.0, 0.0}}};

PlanarMotion startOf(const Start& start) {
  const double heading = start.heading * degree;
  return {.position = {0.3, -0.5},
          .yaw = heading,
          .velocity = sixtyMph * rotated(Vector2::UnitX(), heading),
          .yawRate = start.yawRate};
}

// The lane reflects more than a real wall, so that 5 s hold several impacts.
ResponseSettings lively() {
  ResponseSettings settings;
  settings.restitution = AngleCurve::constant(0.6);
  settings.friction = AngleCurve::constant(0.1);
  return settings;
}

struct Trajectory {
  std::vector<PlanarMotion> motions;
  std::size_t impacts = 0;
};

Trajectory trajectory(const std::vector<Scene>& barriers, const PlanarMotion& start,
                      const Vector2& origin = Vector2::Zero()) {
  OdeWorld ode;
  Responder responder(ode.world, {.response = lively()});
  for (const Scene& scene : barriers) responder.addBarrier(scene);
  BoxCar car(ode.world);
  responder.addVehicle(car.body, car.parameters);
  PlanarMotion moved = start;
  moved.position += origin;
  place(car, moved);
  Trajectory result;
  for (int i = 0; i * h < duration; ++i) {
    result.impacts += static_cast<std::size_t>(std::ranges::count_if(
        responder.step(h),
        [](const ImpactEvent& event) { return event.phase == EventPhase::impact; }));
    dWorldQuickStep(ode.world, h);
    PlanarMotion motion = motionOf(car.body);
    motion.position -= origin;
    result.motions.push_back(motion);
  }
  return result;
}

double difference(const Trajectory& a, const Trajectory& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.motions.size(); ++i) {
    most = std::max(most, (a.motions[i].position - b.motions[i].position).norm());
  }
  return most;
}

Scene turnedRound(Scene scene) {
  for (Scene::Triangle& triangle : scene.triangles) {
    std::swap(triangle.corners[1], triangle.corners[2]);
  }
  return scene;
}

// Each triangle twice: again with the same corners, and again as another face over the same place.
Scene doubled(Scene scene) {
  const std::size_t count = scene.triangles.size();
  for (std::size_t i = 0; i < count; ++i) {
    const auto [a, b, c] = scene.triangles[i].corners;
    scene.triangles.push_back({.corners = {a, c, b}, .mesh = 0});
    const auto first = static_cast<std::uint32_t>(scene.vertices.size());
    for (const std::uint32_t corner : {a, b, c}) {
      const Eigen::Vector3d again = scene.vertices[corner];  // the list moves when it grows
      scene.vertices.push_back(again);
    }
    scene.triangles.push_back({.corners = {first, first + 1, first + 2}, .mesh = 0});
  }
  return scene;
}

Scene shuffled(Scene scene) {
  Random random(3);
  std::shuffle(scene.triangles.begin(), scene.triangles.end(), random.engine());
  return scene;
}

Scene moved(Scene scene, const Vector2& by) {
  for (Eigen::Vector3d& vertex : scene.vertices) vertex.head<2>() += by;
  return scene;
}

// Rows whose panels end at different places: corners in the middle of other rows' edges.
Scene withJunctions() {
  Scene scene = standing(lane, 0.4, 31, 1);
  Scene upper = standing(lane, 0.35, 47, 1);
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  for (Eigen::Vector3d vertex : upper.vertices) {
    vertex.z() += 0.4;
    scene.vertices.push_back(vertex);
  }
  for (Scene::Triangle triangle : upper.triangles) {
    for (std::uint32_t& corner : triangle.corners) corner += first;
    scene.triangles.push_back(triangle);
  }
  return scene;
}

// Gaps of 5 mm between panels.
Scene withCracks() {
  Plan pieces;
  for (const Line& wall : lane) {
    constexpr int count = 40;
    const Vector2 panel = (wall.end - wall.start) / count;
    const Vector2 crack = 0.005 * panel.normalized();
    for (int i = 0; i < count; ++i) {
      pieces.push_back({wall.start + i * panel, wall.start + (i + 1) * panel - crack});
    }
  }
  return standing(pieces);
}

// Panels of random length, down to slivers, in two rows.
Scene inUnevenPanels() {
  Random random(4);
  Plan pieces;
  for (const Line& wall : lane) {
    double share = 0.0;
    while (share < 1.0) {
      const double next = std::min(1.0, share + std::pow(10.0, random.uniform(-7.0, -1.0)));
      pieces.push_back({wall.start + share * (wall.end - wall.start),
                        wall.start + next * (wall.end - wall.start)});
      share = next;
    }
  }
  return standing(pieces, 1.0, 1, 2);
}

struct Mesh {
  const char* name;
  std::function<std::vector<Scene>()> barriers;
  Vector2 origin = Vector2::Zero();
};

void PrintTo(const Mesh& mesh, std::ostream* out) { *out << mesh.name; }

class MeshEquality : public ::testing::TestWithParam<Mesh> {};

TEST_P(MeshEquality, SameTrajectory) {
  const Mesh& mesh = GetParam();
  double worst = 0.0;
  std::size_t fewest = 1000;
  const std::vector<Scene> barriers = mesh.barriers();
  for (const Start& start : starts) {
    const Trajectory reference = trajectory({standing(lane)}, startOf(start));
    fewest = std::min(fewest, reference.impacts);
    const Trajectory other = trajectory(barriers, startOf(start), mesh.origin);
    const double most = difference(reference, other);
    worst = std::max(worst, most);
    EXPECT_LE(most, sameTrajectory) << start.heading << "°";
    EXPECT_EQ(other.impacts, reference.impacts) << start.heading << "°";
  }
  EXPECT_GE(fewest, 3U);
  std::printf("[ figures  ] at most %.3g m apart, at least %zu impacts\n", worst, fewest);
}

const Vector2 farAway(100e3, -70e3);

INSTANTIATE_TEST_SUITE_P(
    Meshes, MeshEquality,
    ::testing::Values(
        Mesh{"Triangles1224", [] { return std::vector{standing(lane, 1.0, 153, 2)}; }},
        Mesh{"Triangles100000", [] { return std::vector{standing(lane, 1.0, 6250, 4)}; }},
        Mesh{"Reversed", [] { return std::vector{turnedRound(standing(lane, 1.0, 20, 2))}; }},
        Mesh{"Doubled", [] { return std::vector{doubled(standing(lane, 1.0, 20, 2))}; }},
        Mesh{"Junctions", [] { return std::vector{withJunctions()}; }},
        Mesh{"Shuffled", [] { return std::vector{shuffled(standing(lane, 1.0, 153, 4))}; }},
        Mesh{"UnevenPanels", [] { return std::vector{shuffled(inUnevenPanels())}; }},
        Mesh{"TwoBarriers",
             [] {
               return std::vector{standing(Plan{lane[0]}, 1.0, 7, 1), standing(Plan{lane[1]})};
             }},
        Mesh{"FarAway", [] { return std::vector{moved(standing(lane), farAway)}; }, farAway},
        Mesh{"FarAwayInPieces",
             [] { return std::vector{moved(standing(lane, 1.0, 153, 2), farAway)}; }, farAway}),
    [](const auto& each) { return std::string(each.param.name); });

// Cracks that no corner of the car goes into are not there.
TEST(MeshEquality, Cracks) {
  for (const Start& start : starts) {
    const double apart = difference(trajectory({standing(lane)}, startOf(start)),
                                    trajectory({withCracks()}, startOf(start)));
    std::printf("[ figures  ] %g deg: %.3g m apart\n", start.heading, apart);
    EXPECT_LE(apart, sameTrajectory) << start.heading << "°";
  }
}

// Contact joints: each mesh another trajectory.
TEST(MeshEquality, ContactJointsDependOnTheMesh) {
  double most = 0.0;
  for (const Start& start : starts) {
    const auto end = [&](std::size_t panels, std::size_t rows) {
      return runWithJoints(lane, startOf(start),
                           {.step = h,
                            .duration = duration,
                            .friction = 0.1,
                            .bounce = 0.6,
                            .panels = panels,
                            .rows = rows})
          .end.position;
    };
    most = std::max(most, (end(1, 1) - end(153, 2)).norm());
  }
  std::printf("[ figures  ] joints: %.3g m apart\n", most);
  EXPECT_GT(most, 1.0);
}

/// A wall that breaks, and 20 m behind it one that does not.
struct Breaking {
  double angle;  // rad, of the way against the walls
  double energyRemaining;
};

class BreakThrough : public ::testing::TestWithParam<Breaking> {};

TEST_P(BreakThrough, OnceWithTheEnergyAskedFor) {
  const auto [angle, energyRemaining] = GetParam();
  for (const double step : {0.001, 0.005, 0.02}) {
    OdeWorld ode;
    Responder responder(ode.world);
    ResponseSettings breaks;
    breaks.law = Law::energy;
    breaks.energyRoot = EnergyRoot::break_through;
    breaks.energyRemaining = AngleCurve::constant(energyRemaining);
    responder.addBarrier(standing(Plan{{{0.0, -200.0}, {0.0, 200.0}}}, 1.0, 40, 2),
                         {.name = "fence", .response = breaks});
    const Plan solid{{{20.0, -200.0}, {20.0, 200.0}}};
    responder.addBarrier(standing(solid), {.name = "wall"});
    BoxCar car(ode.world);
    responder.addVehicle(car.body, car.parameters);
    const double heading = 0.5 * std::numbers::pi - angle;  // against the x axis
    place(car, {.position = {-7.0, -20.0 * std::sin(heading)},
                .yaw = heading,
                .velocity = sixtyMph * rotated(Vector2::UnitX(), heading),
                .yawRate = 0.0});
    const double energyBefore = energyOf(car.body);
    double energyBetween = 0.0;  // with all of the fence's pulse, before the wall
    int fence = 0;
    int wall = 0;
    double ratio = 0.0;
    bool wasBetween = false;
    bool through = false;
    double deepest = 0.0;
    for (int i = 0; i * step < 6.0; ++i) {
      const Vector2 before = motionOf(car.body).position;
      for (const ImpactEvent& event : responder.step(step)) {
        if (event.phase != EventPhase::impact) continue;
        (event.barrier == "fence" ? fence : wall) += 1;
        if (event.barrier == "fence") ratio = event.energyRatio;
      }
      if (fence == 1 && wall == 0) energyBetween = energyOf(car.body);
      dWorldQuickStep(ode.world, step);
      const PlanarMotion now = motionOf(car.body);
      wasBetween = wasBetween || (wall == 0 && now.position.x() > 3.0);
      through = through || leadsThrough(before, now.position, solid);
      deepest = std::max(deepest, deepestIntrusion(car.parameters, now, solid));
    }
    EXPECT_EQ(fence, 1) << step;
    EXPECT_NEAR(ratio, energyRemaining, 1e-12) << step;
    EXPECT_NEAR(energyBetween / energyBefore, energyRemaining, 1e-11) << step;
    EXPECT_TRUE(wasBetween) << step;
    EXPECT_GE(wall, 1) << step;
    EXPECT_FALSE(through) << step;
    EXPECT_LE(deepest, 1e-6) << step;
  }
}

INSTANTIATE_TEST_SUITE_P(Angles, BreakThrough,
                         ::testing::Values(Breaking{30.0 * degree, 0.9},
                                           Breaking{90.0 * degree, 0.6}),
                         [](const auto& each) {
                           return std::to_string(std::lround(each.param.angle / degree)) + "deg";
                         });

// To contact joints every wall is solid.
TEST(BreakThrough, ContactJointsKnowNoBreaking) {
  const Plan fence{{{0.0, -200.0}, {0.0, 200.0}}};
  for (const double angle : {30.0 * degree, 90.0 * degree}) {
    const double heading = 0.5 * std::numbers::pi - angle;
    const JointRun run = runWithJoints(fence,
                                       {.position = {-7.0, -20.0 * std::sin(heading)},
                                        .yaw = heading,
                                        .velocity = sixtyMph * rotated(Vector2::UnitX(), heading),
                                        .yawRate = 0.0},
                                       {.duration = 2.0});
    EXPECT_LT(run.end.position.x(), 0.0);
  }
}

}  // namespace
}  // namespace bumper::tests
