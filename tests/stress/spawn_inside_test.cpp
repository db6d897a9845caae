// Cars that a teleport or a spawn puts into walls: they leave gently, or stay where they are.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "bumper/engine_adapter/responder.h"
#include "extent.h"
#include "ode_joints.h"
#include "ode_world.h"
#include "random_situations.h"

namespace bumper::tests {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double gentle = 2.0 + 1e-9;  // m/s, and rounding

enum class Into { wall, slab, corner, post };

std::string nameOf(Into into) {
  switch (into) {
    case Into::wall:
      return "Wall";
    case Into::slab:
      return "Slab";
    case Into::corner:
      return "Corner";
    case Into::post:
      return "Post";
  }
  return {};
}

void PrintTo(Into into, std::ostream* out) { *out << nameOf(into); }

Plan planOf(Into into, Random& random) {
  switch (into) {
    case Into::wall:
      return {{{0.0, -30.0}, {0.0, 30.0}}};
    case Into::slab:
      return slab({{0.0, -30.0}, {0.0, 30.0}}, 0.3);
    case Into::corner: {
      const double opening = random.uniform(pi / 4.0, pi);
      return {{{0.0, 0.0}, {30.0, 0.0}},
              {30.0 * Vector2(std::cos(opening), std::sin(opening)), {0.0, 0.0}}};
    }
    case Into::post:
      return slab({{-0.05, 0.0}, {0.05, 0.0}}, 0.1);
  }
  return {};
}

struct Spawn {
  Plan plan;
  PlanarMotion motion;
};

// A car with a wall in it.
std::optional<Spawn> randomSpawn(Random& random, const VehicleParameters& car, Into into,
                                 bool atRest) {
  Spawn spawn{.plan = planOf(into, random), .motion = {}};
  spawn.motion.position = {random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0)};
  spawn.motion.yaw = random.uniform(-pi, pi);
  if (!atRest) {
    spawn.motion.velocity =
        random.uniform(0.0, 30.0) * rotated(Vector2::UnitX(), random.uniform(-pi, pi));
    spawn.motion.yawRate = random.uniform(-3.0, 3.0);
  }
  if (deepestIntrusion(car, spawn.motion, spawn.plan) < 0.01) return std::nullopt;
  return spawn;
}

// Between the faces of a slab or a post there is no side to stay on.
bool startsInSolid(const Spawn& spawn) {
  return spawn.plan.size() == 4 &&
         std::all_of(spawn.plan.begin(), spawn.plan.end(), [&](const Line& face) {
           return cross(face.end - face.start, spawn.motion.position - face.start) > 0.0;
         });
}

struct Leaving {
  double topSpeed = 0.0;    // m/s, by which the car moved in any step
  double topRate = 0.0;     // rad/s
  double mostEnergy = 0.0;  // J
  double inside = 0.0;      // m, at the end
  double moved = 0.0;       // m, from start to end
  bool through = false;
};

Leaving leave(const Spawn& spawn, double h) {
  OdeWorld ode;
  Responder responder(ode.world);
  responder.addBarrier(standing(spawn.plan));
  BoxCar car(ode.world);
  responder.addVehicle(car.body, car.parameters);
  place(car, spawn.motion);
  Leaving result;
  PlanarMotion before = spawn.motion;
  for (int i = 0; i * h < 5.0; ++i) {
    responder.step(h);
    dWorldQuickStep(ode.world, h);
    const PlanarMotion now = motionOf(car.body);
    result.topSpeed = std::max(
        {result.topSpeed, (now.position - before.position).norm() / h, now.velocity.norm()});
    result.topRate = std::max(result.topRate, std::abs(now.yawRate));
    result.mostEnergy = std::max(result.mostEnergy, energyOf(car.body));
    result.through = result.through || leadsThrough(before.position, now.position, spawn.plan);
    before = now;
  }
  result.inside = deepestIntrusion(car.parameters, before, spawn.plan);
  result.moved = (before.position - spawn.motion.position).norm();
  return result;
}

class SpawnInside : public ::testing::TestWithParam<Into> {};

TEST_P(SpawnInside, LeavesGently) {
  Random random(51);
  OdeWorld unused;
  const VehicleParameters car = BoxCar(unused.world).parameters;
  double fastest = 0.0;
  double deepest = 0.0;
  int stuck = 0;
  for (int i = 0; i < extent(20, 125);) {
    const std::optional<Spawn> spawn = randomSpawn(random, car, GetParam(), true);
    if (!spawn) continue;
    ++i;
    const double h = i % 3 == 0 ? 0.02 : 0.005;
    const Leaving result = leave(*spawn, h);
    std::ostringstream what;
    printExactly(what, car, spawn->motion, spawn->plan)
        << "step " << h << ", moved " << result.moved << " m, still inside " << result.inside
        << " m, top speed " << result.topSpeed << " m/s, top yaw rate " << result.topRate;
    EXPECT_LE(result.topSpeed, gentle) << what.str();
    EXPECT_FALSE(result.through && !startsInSolid(*spawn)) << what.str();
    // Out of it, or held from all sides.
    const bool out = result.inside <= 1e-3;
    const bool still = result.moved <= 1e-3;
    EXPECT_TRUE(out || still) << what.str();
    stuck += out ? 0 : 1;
    fastest = std::max(fastest, result.topSpeed);
    deepest = std::max(deepest, out ? result.inside : 0.0);
  }
  std::printf("[ figures  ] top speed %.3f m/s, %d still inside, others at most %.3g mm inside\n",
              fastest, stuck, 1e3 * deepest);
}

TEST_P(SpawnInside, MovingCarsAreNotThrown) {
  Random random(52);
  OdeWorld unused;
  const VehicleParameters car = BoxCar(unused.world).parameters;
  double mostGained = 0.0;
  for (int i = 0; i < extent(20, 125);) {
    const std::optional<Spawn> spawn = randomSpawn(random, car, GetParam(), false);
    if (!spawn) continue;
    ++i;
    const double h = i % 3 == 0 ? 0.02 : 0.005;
    const Leaving result = leave(*spawn, h);
    std::ostringstream what;
    printExactly(what, car, spawn->motion, spawn->plan)
        << "step " << h << ", moved " << result.moved << " m, still inside " << result.inside
        << " m, top speed " << result.topSpeed << " m/s, top yaw rate " << result.topRate;
    // Turning may become speed; beyond the energy there was, only the gentle push out.
    const double energyAtStart = yawPlaneEnergy(spawn->motion, car.mass, car.yawInertia);
    const double fastest = std::sqrt(2.0 * energyAtStart / car.mass) + gentle;
    EXPECT_LE(result.topSpeed, fastest) << what.str();
    EXPECT_LE(result.inside, 1e-3) << what.str();
    mostGained = std::max(mostGained, result.topSpeed - fastest + gentle);
  }
  std::printf("[ figures  ] at most %.3f m/s above the energy at the start\n", mostGained);
}

INSTANTIATE_TEST_SUITE_P(All, SpawnInside,
                         ::testing::Values(Into::wall, Into::slab, Into::corner, Into::post),
                         [](const auto& each) { return nameOf(each.param); });

// ODE moves a car out by a fifth of its depth in each step, and leaves it that speed.
TEST(SpawnInside, ContactJointsThrowCarsOut) {
  Random random(51);
  OdeWorld unused;
  const VehicleParameters car = BoxCar(unused.world).parameters;
  double fastest = 0.0;
  int thrown = 0;
  constexpr int cars = 40;
  for (int i = 0; i < cars;) {
    const std::optional<Spawn> spawn = randomSpawn(random, car, Into::wall, true);
    if (!spawn) continue;
    ++i;
    const JointRun run =
        runWithJoints(spawn->plan, spawn->motion,
                      {.step = 0.005, .duration = 1.0, .bounce = 0.0, .panels = 60, .rows = 2});
    fastest = std::max(fastest, run.topSpeed);
    thrown += run.topSpeed > 10.0 ? 1 : 0;
  }
  std::printf("[ figures  ] joints: %d of %d thrown at over 10 m/s, at most %.1f m/s\n", thrown,
              cars, fastest);
  EXPECT_GT(thrown, cars / 4);
}

}  // namespace
}  // namespace bumper::tests
