// Into a wedge of two walls that close to nothing, pushed on: impacts without end in finite time.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bumper/engine_adapter/responder.h"
#include "bumper/response/collision_step.h"
#include "extent.h"
#include "ode_joints.h"
#include "ode_world.h"

namespace bumper::tests {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double push = 3.0;  // m/s², into the wedge: an engine

// J: what a car has that crawls at 1e-9 m/s.
constexpr double atRest = 1e-15;

// The wedge opens along +x and closes at the origin.
Plan wedgeOf(double opening) {
  const double length = 2.2 / std::sin(0.5 * opening) + 15.0;
  return {{Vector2::Zero(), rotated({length, 0.0}, 0.5 * opening)},
          {rotated({length, 0.0}, -0.5 * opening), Vector2::Zero()}};
}

// Nose first, a metre before it touches.
PlanarMotion entry(const VehicleParameters& car, const Plan& plan, double speed, double aside,
                   double yaw) {
  PlanarMotion motion{.position = {0.0, aside},
                      .yaw = std::numbers::pi + yaw,
                      .velocity = {-speed, 0.0},
                      .yawRate = 0.0};
  while (deepestIntrusion(car, motion, plan) > 0.0) motion.position.x() += 0.05;
  motion.position.x() += 1.0;
  return motion;
}

struct Ride {
  double rest = 0.0;     // s, when the car came to rest; 0: never
  double gained = 0.0;   // J, most in one step, beyond the push's work
  double deepest = 0.0;  // m
  bool through = false;  // the mass centre went through a wall
  unsigned issues = 0;
  std::size_t mostEvents = 0;  // in one step
  PlanarMotion end;
};

// Pushed on until it moves by less than 0.1 mm in a second, at most a minute. In a wide wedge that
// takes a while: nose first the car stands on a knife's edge, and turns until a side lies flat.
Ride pushInto(const Plan& plan, const PlanarMotion& start, double h) {
  OdeWorld ode;
  BoxCar car(ode.world);
  Responder responder(ode.world);
  responder.addBarrier(standing(plan));
  responder.addVehicle(car.body, car.parameters);
  place(car, start);
  Ride ride;
  double energy = lawEnergyOf(car, responder);
  const Vector2 pushed(-push * h, 0.0);
  PlanarMotion before = start;
  PlanarMotion secondAgo = start;
  const int second = static_cast<int>(std::lround(1.0 / h));
  for (int i = 1; i <= 60 * second && ride.rest == 0.0; ++i) {
    energy += car.parameters.mass * pushed.dot(lawMotionOf(car, responder).velocity + 0.5 * pushed);
    dBodyAddForce(car.body, -push * car.parameters.mass, 0.0, 0.0);
    ride.mostEvents = std::max(ride.mostEvents, responder.step(h).size());
    ride.issues |= responder.issues();
    dWorldQuickStep(ode.world, h);
    const PlanarMotion now = motionOf(car.body);
    const double energyBefore = energy;
    energy = lawEnergyOf(car, responder);
    ride.gained = std::max(ride.gained, energy - energyBefore);
    ride.through = ride.through || leadsThrough(before.position, now.position, plan);
    ride.deepest = std::max(ride.deepest, deepestIntrusion(car.parameters, now, plan));
    before = now;
    if (i % second == 0) {
      const double moved = (now.position - secondAgo.position).norm();
      if (moved < 1e-3 && std::abs(now.yaw - secondAgo.yaw) < 1e-3) ride.rest = i * h;
      secondAgo = now;
    }
  }
  ride.end = before;
  return ride;
}

struct Entry {
  double opening;  // deg
  double step;     // s
};

void PrintTo(const Entry& entry, std::ostream* out) {
  *out << entry.opening << "° at " << 1e3 * entry.step << " ms";
}

class Wedge : public ::testing::TestWithParam<Entry> {};

TEST_P(Wedge, EndsAtRest) {
  const auto [opening, h] = GetParam();
  const Plan plan = wedgeOf(opening * degree);
  OdeWorld unused;
  const VehicleParameters car = BoxCar(unused.world).parameters;
  Ride worst;
  for (const double speed : {5.0, 20.0, 50.0}) {
    for (const double aside : {0.0, 0.05, 0.3}) {
      for (const double yaw : {0.5 * degree, 8.0 * degree, -20.0 * degree}) {
        const PlanarMotion start = entry(car, plan, speed, aside, yaw);
        const Ride ride = pushInto(plan, start, h);
        std::ostringstream what;
        printExactly(what, car, start, plan)
            << "end (" << ride.end.position.transpose() << "), yaw " << ride.end.yaw
            << ", velocity (" << ride.end.velocity.transpose() << "), yaw rate "
            << ride.end.yawRate;
        EXPECT_FALSE(ride.through) << what.str();
        EXPECT_LE(ride.deepest, 1e-3) << what.str();
        // Rounding of the energy there was.
        EXPECT_LE(ride.gained, 1e-11 * yawPlaneEnergy(start, car.mass, car.yawInertia))
            << what.str();
        EXPECT_GT(ride.rest, 0.0) << what.str();
        EXPECT_EQ(ride.issues & ~step_issue::unsettled, 0U) << what.str();
        EXPECT_LE(ride.mostEvents, static_cast<std::size_t>(CollisionStep::maxImpacts))
            << what.str();
        if (::testing::Test::HasFailure()) return;
        worst.rest = std::max(worst.rest, ride.rest);
        worst.deepest = std::max(worst.deepest, ride.deepest);
        worst.mostEvents = std::max(worst.mostEvents, ride.mostEvents);
      }
    }
  }
  std::printf("[ figures  ] at rest after %.0f s, deepest %.4g mm, at most %zu events a step\n",
              worst.rest, 1e3 * worst.deepest, worst.mostEvents);
}

std::string nameOf(const ::testing::TestParamInfo<Entry>& each) {
  return std::to_string(std::lround(each.param.opening)) + "deg" +
         std::to_string(std::lround(1e3 * each.param.step)) + "ms";
}

INSTANTIATE_TEST_SUITE_P(Openings, Wedge,
                         ::testing::Values(Entry{1.0, 0.005}, Entry{5.0, 0.005}, Entry{20.0, 0.02},
                                           Entry{60.0, 0.005}),
                         nameOf);
INSTANTIATE_TEST_SUITE_P(MoreOpenings, Wedge,
                         ::testing::ValuesIn(inLong({Entry{1.0, 0.001}, Entry{2.0, 0.02},
                                                     Entry{5.0, 0.02}, Entry{10.0, 0.001},
                                                     Entry{10.0, 0.005}, Entry{30.0, 0.005},
                                                     Entry{45.0, 0.02}, Entry{60.0, 0.001}})),
                         nameOf);

// Without a push there is only energy to lose.
TEST(WedgeWithoutPush, LosesEnergy) {
  for (const double opening : {1.0, 3.0, 10.0, 30.0, 60.0}) {
    const Plan plan = wedgeOf(opening * degree);
    for (const double restitution : {0.0, 0.3, 1.0}) {
      for (const double friction : {0.0, 0.3, 1.0}) {
        for (const double h : {0.001, 0.02}) {
          ResponseSettings settings;
          settings.restitution = AngleCurve::constant(restitution);
          settings.friction = AngleCurve::constant(friction);
          OdeWorld ode;
          Responder responder(ode.world, {.response = settings});
          responder.addBarrier(standing(plan));
          BoxCar car(ode.world);
          responder.addVehicle(car.body, car.parameters);
          const PlanarMotion start = entry(car.parameters, plan, 30.0, 0.04, 2.0 * degree);
          place(car, start);
          double energy = lawEnergyOf(car, responder);
          PlanarMotion before = start;
          for (int i = 0; i * h < extent(2.0, 10.0); ++i) {
            responder.step(h);
            dWorldQuickStep(ode.world, h);
            const PlanarMotion now = motionOf(car.body);
            std::ostringstream what;
            what << opening << "°, e " << restitution << ", μ " << friction << ", step " << h
                 << ", at step " << i << ", issues " << responder.issues();
            const double energyBefore = energy;
            energy = lawEnergyOf(car, responder);
            ASSERT_LE(energy, energyBefore * (1.0 + 1e-11) + atRest) << what.str();
            ASSERT_FALSE(leadsThrough(before.position, now.position, plan)) << what.str();
            ASSERT_LE(deepestIntrusion(car.parameters, now, plan), 1e-3) << what.str();
            before = now;
          }
        }
      }
    }
  }
}

// Contact joints: driven in deep, or through.
TEST(WedgeWithContactJoints, SinksInOrLetsThrough) {
  double deepest = 0.0;
  int through = 0;
  OdeWorld unused;
  const VehicleParameters parameters = BoxCar(unused.world).parameters;
  for (const double opening : {1.0, 5.0, 20.0, 60.0}) {
    for (const double speed : {20.0, 50.0}) {
      const Plan plan = wedgeOf(opening * degree);
      const JointRun run = runWithJoints(
          plan, entry(parameters, plan, speed, 0.05, 0.5 * degree),
          {.step = 0.005, .duration = 5.0, .panels = 20, .rows = 2},
          [](BoxCar& car) { dBodyAddForce(car.body, -push * car.parameters.mass, 0.0, 0.0); });
      std::printf("[ figures  ] joints, %g deg, %g m/s: deepest %.3f m, energy %.3f, through %d\n",
                  opening, speed, run.deepest, run.mostEnergy, static_cast<int>(run.ledThrough));
      deepest = std::max(deepest, run.deepest);
      through += run.ledThrough ? 1 : 0;
    }
  }
  EXPECT_GT(deepest, 0.1);
  EXPECT_GT(through, 0);
}

}  // namespace
}  // namespace bumper::tests
