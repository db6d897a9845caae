// A car on wheels whose motor drives it at a wall, for minutes: it neither sinks in nor jitters,
// and the wall does no work on it.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "bumper/engine_adapter/responder.h"
#include "extent.h"
#include "hinge2_car.h"
#include "ode_world.h"
#include "plan.h"

namespace bumper::tests {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double gravity = 9.81;
constexpr double tyreFriction = 0.9;
constexpr double speed = 8.0;     // m/s, of the motor
constexpr double torque = 200.0;  // N m, on each wheel

enum class Against {
  nothing,
  bumper,        ///< a wall of panels of 0.7 m
  plane_joints,  ///< contact joints of the chassis with a plane geom: true normals
  mesh_joints    ///< contact joints with the same triangles
};

struct Lean {
  double heading;  // deg against the wall
  double step;     // s
  double steer;    // deg, front wheels towards the wall: 0 aligns and rolls along it
};

void PrintTo(const Lean& lean, std::ostream* out) {
  *out << lean.heading << "° at " << 1e3 * lean.step << " ms, steered by " << lean.steer << "°";
}

struct Drive {
  std::array<double, 4> deepest{};  // m of penetration, by quarter of the run
  double aligned = 0.0;             // s, when the car came to drive along the wall; 0: never
  std::vector<double> yawRates;     // rad/s, after each step
  double work = 0.0;                // J, done by the wall
  double workOfLastHalf = 0.0;
  double largestJolt = 0.0;  // m/s, change of velocity in one step in the second half
  std::size_t events = 0;
  bool touched = false;
};

// The force on the car's bodies that has been added up so far, and its moment about the vertical
// through the common mass centre.
struct Push {
  Vector2 force = Vector2::Zero();
  double moment = 0.0;
};

Push pushOn(const Hinge2Car& car) {
  std::vector<dBodyID> bodies(car.wheels.begin(), car.wheels.end());
  bodies.push_back(car.chassis);
  const Vector2 centre = car.massCentre().head<2>();
  Push push;
  for (dBodyID body : bodies) {
    const dReal* force = dBodyGetForce(body);
    const Vector2 arm = Vector2(dBodyGetPosition(body)[0], dBodyGetPosition(body)[1]) - centre;
    push.force += Vector2(force[0], force[1]);
    push.moment += cross(arm, Vector2(force[0], force[1])) + dBodyGetTorque(body)[2];
  }
  return push;
}

/// A wall along the x axis as true-normal contact joints know it, for a car's chassis. The tyres
/// stand out of the outline; Bumper's wall does not see them either.
class PlaneJoints {
 public:
  PlaneJoints() : plane_(dCreatePlane(nullptr, 0.0, 1.0, 0.0, 0.0)) {}
  ~PlaneJoints() { dGeomDestroy(plane_); }
  PlaneJoints(const PlaneJoints&) = delete;
  PlaneJoints& operator=(const PlaneJoints&) = delete;
  PlaneJoints(PlaneJoints&&) = delete;
  PlaneJoints& operator=(PlaneJoints&&) = delete;

  void add(const OdeWorld& ode, const Hinge2Car& car) const {
    std::array<dContact, 8> contacts{};
    const int count = dCollide(car.box, plane_, static_cast<int>(contacts.size()),
                               &contacts[0].geom, sizeof(dContact));
    for (int i = 0; i < count; ++i) {
      dContact& contact = contacts[static_cast<std::size_t>(i)];
      contact.surface.mode = dContactBounce | dContactApprox1;
      contact.surface.mu = 0.3;  // the paper's, grazing
      contact.surface.bounce = 0.3;
      contact.surface.bounce_vel = 0.1;
      dJointAttach(dJointCreateContact(ode.world, ode.joints, &contact), car.chassis, nullptr);
    }
  }

 private:
  dGeomID plane_;
};

// The motor pushes through wheel joints and ground contacts, of which nothing is known when a step
// is answered.
Drive drive(const Lean& lean, Against against, double duration) {
  OdeWorld ode(gravity);
  ode.friction = tyreFriction;
  dCreatePlane(ode.space, 0.0, 0.0, 1.0, 0.0);
  const double length = speed * duration + 100.0;
  const Scene scene = standing(Plan{{{-50.0, 0.0}, {length - 50.0, 0.0}}}, 1.0,
                               static_cast<std::size_t>(length / 0.7), 2);
  std::unique_ptr<OdeMesh> mesh;
  if (against == Against::mesh_joints) mesh = std::make_unique<OdeMesh>(ode.space, scene);

  const double angle = lean.heading * degree;
  const auto reach = [](double turn) {
    return std::abs(std::sin(turn)) * Hinge2Car::front +
           std::abs(std::cos(turn)) * 0.5 * Hinge2Car::width;
  };
  Hinge2Car car(ode.world, ode.space, {0.0, reach(angle) + 0.01}, 0.0, -angle, 0.0);
  for (const std::size_t wheel : {0U, 1U}) {
    dJointSetHinge2Param(car.axles[wheel], dParamLoStop, lean.steer * degree);
    dJointSetHinge2Param(car.axles[wheel], dParamHiStop, lean.steer * degree);
  }
  Responder responder(ode.world);
  if (against == Against::bumper) {
    responder.addBarrier(scene);
    responder.addVehicle(car.chassis, car.parameters(), {.linkedBodies = car.wheels});
  }

  const PlaneJoints plane;
  Drive run;
  const int steps = static_cast<int>(std::lround(duration / lean.step));
  for (int i = 0; i < steps; ++i) {
    car.drive(speed, torque);
    const Vector2 velocity = car.velocity().head<2>();
    const double yawRate = dBodyGetAngularVel(car.chassis)[2];
    Push push;
    ode.step(lean.step, against == Against::bumper ? &responder : nullptr, [&] {
      if (against == Against::plane_joints) plane.add(ode, car);
      if (against != Against::bumper) return;
      run.events += responder.step(lean.step).size();
      push = pushOn(car);  // no other force is added in this loop
    });
    const double yawRateAfter = dBodyGetAngularVel(car.chassis)[2];
    const double work = 0.5 * lean.step *
                        (push.force.dot(velocity + car.velocity().head<2>()) +
                         push.moment * (yawRate + yawRateAfter));
    run.work += work;
    if (2 * i >= steps) {
      run.workOfLastHalf += work;
      run.largestJolt = std::max(run.largestJolt, (car.velocity().head<2>() - velocity).norm());
    }
    run.yawRates.push_back(yawRateAfter);

    const dReal* r = dBodyGetRotation(car.chassis);
    const double depth = std::abs(r[4]) * Hinge2Car::front +
                         std::abs(r[5]) * 0.5 * Hinge2Car::width - dBodyGetPosition(car.chassis)[1];
    double& deepest = run.deepest[static_cast<std::size_t>(4LL * i / steps)];
    deepest = std::max(deepest, depth);
    if (run.aligned == 0.0 && std::abs(r[4]) < std::sin(0.1 * degree)) {
      run.aligned = (i + 1) * lean.step;
    }
    run.touched = run.touched || depth > -0.005;
  }
  return run;
}

// The change of the yaw rate from step to step after a time, root mean square, rad/s.
double yawNoise(const Drive& run, double from, double step) {
  const auto first = static_cast<std::size_t>(from / step) + 1;
  double squares = 0.0;
  for (std::size_t i = first; i < run.yawRates.size(); ++i) {
    const double change = run.yawRates[i] - run.yawRates[i - 1];
    squares += change * change;
  }
  return std::sqrt(squares / static_cast<double>(run.yawRates.size() - first));
}

class LeaningLong : public ::testing::TestWithParam<Lean> {};

TEST_P(LeaningLong, NeitherSinksInNorJitters) {
  const Lean lean = GetParam();
  const double duration = extent(60.0, 600.0);  // s
  const Drive wall = drive(lean, Against::bumper, duration);
  const Drive free = drive(lean, Against::nothing, duration);
  const Drive joints = drive(lean, Against::plane_joints, duration);

  // Joints act after the step has been answered; tyres can add no more than this.
  const double mostDepth = std::max(1e-3, lean.step * lean.step * tyreFriction * gravity);
  EXPECT_TRUE(wall.touched);
  EXPECT_GT(wall.aligned, 0.0);
  for (const double depth : wall.deepest) EXPECT_LE(depth, mostDepth);
  // The last quarter against the first half: it may have left the wall in any of them.
  constexpr double drift = 1e-4;  // m
  EXPECT_LE(wall.deepest[3], std::max({wall.deepest[0], wall.deepest[1], 0.0}) + drift);
  const double settled = wall.aligned + 1.0;
  const double noise = yawNoise(wall, settled, lean.step);
  const double freeNoise = yawNoise(free, settled, lean.step);
  const double jointNoise = yawNoise(joints, settled, lean.step);
  if (lean.steer == 0.0) {
    EXPECT_LE(noise, 2.0 * freeNoise);
    // A minute is too short to tell the two apart.
    if (duration >= 600.0) {
      // At 30° it is 0.7 % above.
      EXPECT_LE(noise, 1.02 * jointNoise);
    }
  }
  EXPECT_LE(wall.work, 0.0);
  EXPECT_LE(wall.workOfLastHalf, 0.0);
  EXPECT_LE(wall.events, 10U);

  std::printf(
      "[ figures  ] aligned at %.1f s, deepest %.4f %.4f %.4f %.4f mm (joints %.4f), yaw noise "
      "%.3g (free %.3g, "
      "joints "
      "%.3g) rad/s, work %.6g J, of last half %.6g J, %zu events\n",
      wall.aligned, 1e3 * wall.deepest[0], 1e3 * wall.deepest[1], 1e3 * wall.deepest[2],
      1e3 * wall.deepest[3], 1e3 * *std::ranges::max_element(joints.deepest), noise, freeNoise,
      jointNoise, wall.work, wall.workOfLastHalf, wall.events);
}

std::string nameOf(const ::testing::TestParamInfo<Lean>& each) {
  return std::to_string(std::lround(each.param.heading)) + "deg" +
         std::to_string(std::lround(1e3 * each.param.step)) + "ms" +
         (each.param.steer == 0.0 ? "" : "Steered");
}

INSTANTIATE_TEST_SUITE_P(At5ms, LeaningLong,
                         ::testing::Values(Lean{0.0, 0.005, 0.0}, Lean{1.0, 0.005, 0.0},
                                           Lean{3.0, 0.005, 0.0}, Lean{10.0, 0.005, 0.0},
                                           Lean{20.0, 0.005, 0.0}, Lean{30.0, 0.005, 0.0},
                                           Lean{3.0, 0.005, 1.0}),
                         nameOf);
INSTANTIATE_TEST_SUITE_P(At1ms, LeaningLong,
                         ::testing::ValuesIn(inLong({Lean{0.0, 0.001, 0.0}, Lean{10.0, 0.001, 0.0},
                                                     Lean{30.0, 0.001, 0.0},
                                                     Lean{3.0, 0.001, 1.0}})),
                         nameOf);

// Contact joints with the wall's own triangles: now and then a normal of the car's own sides, and
// the car is jolted.
TEST(LeaningLong, ContactJointsWithTheMeshJolt) {
  double jolt = 0.0;
  double noise = 0.0;
  for (const double heading : {1.0, 10.0, 30.0}) {
    const Lean lean{heading, 0.005, 0.0};
    const Drive joints = drive(lean, Against::mesh_joints, 60.0);
    const Drive wall = drive(lean, Against::bumper, 60.0);
    jolt = std::max(jolt, joints.largestJolt / wall.largestJolt);
    const double settled = wall.aligned + 1.0;
    const double jointNoise = yawNoise(joints, settled, lean.step);
    const double wallNoise = yawNoise(wall, settled, lean.step);
    noise = std::max(noise, jointNoise / wallNoise);
    std::printf("[ figures  ] %g deg: joints' noise %.3g, jolt %.3g; wall's %.3g, %.3g\n", heading,
                jointNoise, joints.largestJolt, wallNoise, wall.largestJolt);
  }
  EXPECT_GT(jolt, 3.0);
  EXPECT_GT(noise, 3.0);
}

}  // namespace
}  // namespace bumper::tests
