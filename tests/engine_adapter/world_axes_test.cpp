// Worlds with another up axis or length unit, and chassis that point elsewhere: what happens is the
// same, seen in other axes.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "../response/random_impacts.h"
#include "bumper/response/error.h"
#include "bumper/scenes/paper_scenes.h"
#include "free_drive.h"
#include "turned_world.h"

namespace bumper::tests {
namespace {

constexpr double h = 0.005;
constexpr double pi = std::numbers::pi;

const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
const Eigen::Vector3d y = Eigen::Vector3d::UnitY();
const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();

// (x, y, z) with z up is (y, z, x) where y is up, and (z, x, y) where x is.
const Eigen::Matrix3d yUp = columns(z, x, y);
const Eigen::Matrix3d xUp = columns(y, z, x);

Eigen::Matrix3d tilted() {
  return (Eigen::AngleAxisd(0.7, z) * Eigen::AngleAxisd(1.1, x) * Eigen::AngleAxisd(-0.4, y))
      .toRotationMatrix();
}

struct Course {
  std::string name;
  std::function<void(TurnedWorld&)> build;
};

// A yard of 16 by 10 m, as walls of each kind.
const std::vector<Course>& courses() {
  const std::vector<Eigen::Vector2d> ring = {
      {-8.0, -5.0}, {8.0, -5.0}, {8.0, 5.0}, {-8.0, 5.0}, {-8.0, -5.0}};
  static const std::vector<Course> all = {
      {"scene", [=](TurnedWorld& w) { w.responder.addBarrier(w.there(sheets(ring))); }},
      {"scene with a geom",
       [=](TurnedWorld& w) {
         w.responder.addBarrier(w.there(sheets(ring)), {.space = w.space()});
       }},
      {"trimesh", [=](TurnedWorld& w) { w.responder.addBarrier(w.addMesh(sheets(ring))); }},
      {"boxes",
       [](TurnedWorld& w) {
         for (const double side : {-1.0, 1.0}) {
           w.responder.addBarrier(w.addBox({0.0, 5.5 * side, 0.5}, 0.0, {18.0, 1.0, 1.0}));
           w.responder.addBarrier(w.addBox({8.5 * side, 0.0, 0.5}, 0.0, {1.0, 12.0, 1.0}));
         }
       }},
      {"planes",
       [](TurnedWorld& w) {
         for (const double side : {-1.0, 1.0}) {
           w.responder.addBarrier(w.addPlane({0.0, -side, 0.0}, -5.0));
           w.responder.addBarrier(w.addPlane({-side, 0.0, 0.0}, -8.0));
         }
       }},
      {"posts", [](TurnedWorld& w) {
         // So far apart that no car is wedged between two, where rounding decides.
         for (int i = 0; i < 8; ++i) {
           const double angle = 2.0 * pi * i / 8.0;
           const Eigen::Vector3d place(8.0 * std::cos(angle), 5.0 * std::sin(angle), 0.5);
           if (i % 3 == 0) w.responder.addBarrier(w.addSphere(place, 0.6));
           if (i % 3 == 1) w.responder.addBarrier(w.addCapsule(place, z, 0.4, 1.0));
           if (i % 3 == 2) w.responder.addBarrier(w.addCylinder(place, z, 0.5, 1.0));
         }
       }}};
  return all;
}

TurnedWorld::Start randomStart(Random& random, double lean = 0.0) {
  const double course = random.uniform(-pi, pi);
  const double speed = random.uniform(3.0, 25.0);
  return {.place = {random.uniform(-3.0, 3.0), random.uniform(-1.0, 1.0), 0.55},
          .yaw = random.uniform(-pi, pi),
          .lean = random.uniform(-lean, lean),
          .velocity = {speed * std::cos(course), speed * std::sin(course), 0.0},
          .yawRate = random.uniform(-1.0, 1.0)};
}

// Everything that the events and the motion of two runs differ by, relative to 1 and the metre.
struct Difference {
  double most = 0.0;
  bool sameBits = true;
  void add(double a, double b) {
    most = std::max(most, std::abs(a - b) / std::max(1.0, std::abs(b)));
    sameBits = sameBits && a == b;
  }
  void add(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    for (int k = 0; k < 3; ++k) add(a[k], b[k]);
  }
};

void compare(const TurnedWorld::Step& a, const TurnedWorld::Step& b, double metre,
             Difference& difference) {
  ASSERT_EQ(a.events.size(), b.events.size()) << "other, usual";
  for (std::size_t i = 0; i < a.events.size(); ++i) {
    const ImpactEvent& one = a.events[i];
    const ImpactEvent& other = b.events[i];
    EXPECT_EQ(one.phase, other.phase);
    EXPECT_EQ(one.barrier, other.barrier);
    difference.add(one.time, other.time);
    difference.add(one.contact, other.contact);
    difference.add(one.normal, other.normal);
    difference.add(one.velocityAfter, other.velocityAfter);
    difference.add(one.arm.x() / metre, other.arm.x());
    difference.add(one.approachSpeed / metre, other.approachSpeed);
    difference.add(one.impulseNormal / metre / 1500.0, other.impulseNormal / 1500.0);
    difference.add(one.energyLost / (metre * metre) / 1500.0, other.energyLost / 1500.0);
  }
  for (std::size_t i = 0; i < a.places.size(); ++i) {
    difference.add(a.places[i], b.places[i]);
    difference.add(a.velocities[i], b.velocities[i]);
    difference.add(a.turning[i], b.turning[i]);
  }
}

/// Drives in that world and in the usual one, and what they differ by; at least half of the drives
/// hit something.
Difference drive(const OtherAxes& axes, const Course& course, int drives, int steps,
                 double lean = 0.0, Delivery delivery = Delivery::force_pulse) {
  Difference difference;
  Random random(7);
  int hits = 0;
  for (int i = 0; i < drives; ++i) {
    const ResponderOptions options{.delivery = delivery, .skipping = i % 2 == 0};
    TurnedWorld other(axes, options);
    TurnedWorld usual({}, options);
    course.build(other);
    course.build(usual);
    const TurnedWorld::Start start = randomStart(random, lean);
    TurnedWorld::Start second = randomStart(random, lean);
    second.place.x() = start.place.x() + (start.place.x() > 0.0 ? -5.5 : 5.5);
    for (TurnedWorld* each : {&other, &usual}) {
      each->addCar(start);
      if (i % 3 == 0) each->addCar(second);
    }
    bool hit = false;
    for (int k = 0; k < steps; ++k) {
      const TurnedWorld::Step expected = usual.step(h);
      hit = hit || !expected.events.empty();
      compare(other.step(h), expected, axes.metre, difference);
      if (::testing::Test::HasFailure()) {
        ADD_FAILURE() << course.name << ", drive " << i << ", step " << k;
        return difference;
      }
    }
    if (hit) ++hits;
  }
  EXPECT_GE(2 * hits, drives) << course.name;
  return difference;
}

TEST(WorldAxes, SwappedAxesGiveTheSameBits) {
  for (const Eigen::Matrix3d& world : {yUp, xUp}) {
    for (const Course& course : courses()) {
      const Difference difference = drive({.world = world, .chassis = world}, course, 12, 160);
      EXPECT_TRUE(difference.sameBits)
          << course.name << ", up " << world.col(2).transpose() << ": off by " << difference.most;
    }
  }
}

TEST(WorldAxes, SoDoVelocitiesThatAreReset) {
  const Difference difference =
      drive({.world = yUp, .chassis = yUp}, courses().front(), 12, 160, 0.0, Delivery::state_reset);
  EXPECT_TRUE(difference.sameBits) << difference.most;
}

TEST(WorldAxes, AnyUpAndAnyChassis) {
  const std::vector<OtherAxes> others = {
      {.world = tilted(), .chassis = tilted()},
      {.world = tilted()},
      {.world = columns(x, -y, -z)},                                 // down
      {.world = columns(x, -z, y), .chassis = columns(x, -z, y)},    // y up, x forward
      {.chassis = columns(y, -x, z)},                                // y forward: 3ds, Blender
      {.world = columns(-z, -x, y), .chassis = columns(-z, -x, y)},  // −z forward, y up: OpenGL
      {.world = yUp, .chassis = columns(-z, -x, y)}};
  for (const OtherAxes& axes : others) {
    for (const Course& course : courses()) {
      // ODE rounds a mesh to single precision.
      if (course.name == "trimesh" && axes.world == tilted()) continue;
      EXPECT_LT(drive(axes, course, 6, 80, 0.1).most, 1e-9) << course.name << '\n' << axes.world;
    }
  }
}

TEST(WorldAxes, AnotherUnitIsTheSameWorld) {
  for (const double metre : {100.0, 0.125, 3.28084}) {
    for (const Course& course : courses()) {
      if (course.name == "trimesh" && metre == 3.28084) continue;
      EXPECT_LT(drive({.metre = metre}, course, 6, 80).most, 1e-9) << course.name << ' ' << metre;
    }
    const OtherAxes both{.world = tilted(), .chassis = yUp, .metre = metre};
    EXPECT_LT(drive(both, courses()[1], 6, 80, 0.1).most, 1e-9) << metre;
  }
}

TEST(WorldAxes, WhatTheResponderTellsIsInTheWorldsAxes) {
  TurnedWorld world({.world = yUp, .chassis = yUp, .metre = 100.0});
  const BarrierId wall = world.responder.addBarrier(world.there(sheets({{5.0, -9.0}, {5.0, 9.0}})),
                                                    {.space = world.space()});
  const VehicleId car = world.addCar(
      {.place = {0.0, 1.0, 0.55}, .yaw = 0.0, .velocity = {10.0, 0.0, 0.0}, .yawRate = 0.0});
  EXPECT_TRUE(world.responder.warnings().empty()) << world.responder.warnings().front();
  EXPECT_LT((world.responder.position(car) - Eigen::Vector3d(100.0, 55.0, 0.0)).norm(), 1e-9);
  EXPECT_LT((world.responder.velocity(car) - Eigen::Vector3d(0.0, 0.0, 1000.0)).norm(), 1e-9);
  // Forward, left, up of the vehicle in the world.
  const Eigen::Matrix3d axes = world.responder.orientation(car).toRotationMatrix();
  EXPECT_LT((axes - yUp).norm(), 1e-12);
  std::vector<ImpactEvent> events;
  for (int i = 0; i < 100 && events.empty(); ++i) {
    const auto found = world.responder.step(h);
    events.assign(found.begin(), found.end());
    dWorldQuickStep(world.world(), h);
  }
  ASSERT_FALSE(events.empty());
  const ImpactEvent& hit = events.front();
  EXPECT_LT((hit.normal - Eigen::Vector3d(0.0, 0.0, -1.0)).norm(), 1e-9);
  EXPECT_NEAR(hit.contact.z(), 500.0, 5.0);
  EXPECT_NEAR(hit.contact.y(), 55.0, 1e-9);
  EXPECT_NEAR(hit.approachSpeed, 1000.0, 1e-6);
  EXPECT_NEAR(hit.arm.x(), 210.0, 5.0);
  // The geom of the walls stands where they are.
  dReal box[6];
  dGeomGetAABB(world.responder.geom(wall), box);
  EXPECT_NEAR(box[0], -900.0, 1e-3);
  EXPECT_NEAR(box[3], 150.0, 1e-3);
  EXPECT_NEAR(box[5], 500.0, 1e-3);

  const WorldAxes given{.up = y, .metre = 100.0};
  const ImpactEvent seen = zUp(hit, given);
  EXPECT_LT((seen.normal - Eigen::Vector3d(-1.0, 0.0, 0.0)).norm(), 1e-9);
  EXPECT_NEAR(seen.approachSpeed, 10.0, 1e-8);
  EXPECT_NEAR(seen.contact.z(), 0.55, 1e-9);
  EXPECT_LT(
      (zUp(Eigen::Vector3d(100.0, 55.0, 0.0), given) - Eigen::Vector3d(0.0, 1.0, 0.55)).norm(),
      1e-12);
  EXPECT_LT(
      zUp(world.responder.orientation(car), given).angularDistance(Eigen::Quaterniond::Identity()),
      1e-7);
}

TEST(WorldAxes, ParametersAreReadInThem) {
  const ChassisAxes own{.forward = -z, .up = y};
  const OtherAxes axes{.world = yUp, .chassis = columns(-z, -x, y), .metre = 100.0};
  TurnedWorld world(axes);
  world.addCar({.place = {3.0, 2.0, 0.55}, .yaw = 0.7});
  const VehicleParameters read = parametersFromGeoms(world.body(0), {}, 55.0, own);
  EXPECT_NEAR(read.mass, 1500.0, 1e-9);
  EXPECT_NEAR(read.yawInertia, 2600.0e4, 1e-2);
  EXPECT_NEAR(read.massCentreToFront, 210.0, 1e-9);
  EXPECT_NEAR(read.massCentreToRear, 250.0, 1e-9);
  EXPECT_NEAR(read.width, 180.0, 1e-9);
}

// A car on a block, and one at its side, where y is up.
TEST(WorldAxes, TopsAreGroundThere) {
  TurnedWorld world({.world = yUp, .chassis = yUp});
  const dGeomID block = world.addBox({0.0, 0.0, 0.5}, 0.0, {4.0, 4.0, 1.0});
  world.responder.addBarrier(block);
  world.addCar({.place = {0.0, 0.0, 1.34}});
  dGeomID car = dBodyGetFirstGeom(world.body(0));
  const auto kept = [&](const Eigen::Vector3d& place) {
    const Eigen::Vector3d p = world.there(place);
    dBodySetPosition(world.body(0), p.x(), p.y(), p.z());
    dContact contacts[16];
    const int count = dCollide(car, block, 16, &contacts[0].geom, sizeof(dContact));
    EXPECT_GT(count, 0);
    return world.responder.keepUnclaimed(car, block, contacts, count);
  };
  EXPECT_GT(kept({0.0, 0.0, 1.34}), 0);
  EXPECT_EQ(kept({-2.0 - 2.1 + 0.05, 0.0, 0.55}), 0);
}

// Joints act on it too: guard contacts hold it before the wall, in any axes.
TEST(WorldAxes, GuardContactsHoldThere) {
  const auto run = [](const OtherAxes& axes) {
    TurnedWorld world(axes);
    world.responder.addBarrier(world.there(sheets({{5.0, -9.0}, {5.0, 9.0}})));
    world.addCar({.place = {2.0, 0.3, 0.55}, .yaw = 0.1, .velocity = {2.0, 0.0, 0.0}});
    // A motor that pushes it against the wall.
    const Eigen::Vector3d ahead = axes.world.col(0);
    dJointID motor = dJointCreateLMotor(world.world(), nullptr);
    dJointAttach(motor, world.body(0), nullptr);
    dJointSetLMotorNumAxes(motor, 1);
    dJointSetLMotorAxis(motor, 0, 0, ahead.x(), ahead.y(), ahead.z());
    dJointSetLMotorParam(motor, dParamVel, 5.0 * axes.metre);
    dJointSetLMotorParam(motor, dParamFMax, 30000.0 * axes.metre);
    for (int i = 0; i < 300; ++i) {
      world.responder.step(h);
      dWorldStep(world.world(), h);
    }
    const Eigen::Vector3d place = world.here(dBodyGetPosition(world.body(0)));
    dJointDestroy(motor);
    return place;
  };
  const Eigen::Vector3d usual = run({});
  EXPECT_GT(usual.x(), 2.5);
  EXPECT_LT(usual.x(), 5.0 - 2.05);
  EXPECT_LT((run({.world = yUp, .chassis = yUp}) - usual).norm(), 1e-6);
  EXPECT_LT((run({.world = tilted(), .chassis = yUp}) - usual).norm(), 1e-6);
  EXPECT_LT((run({.metre = 100.0}) - usual).norm(), 1e-6);
}

TEST(WorldAxes, SavedAndRestored) {
  const OtherAxes axes{.world = yUp, .chassis = yUp, .metre = 100.0};
  TurnedWorld world(axes);
  world.responder.addBarrier(world.there(sheets({{3.0, -9.0}, {3.0, 9.0}})));
  world.addCar({.place = {0.0, 1.0, 0.55}, .velocity = {10.0, 1.0, 0.0}});
  bool pending = false;
  for (int i = 0; i < 60; ++i) {
    const SavedState saved = world.responder.save();
    pending = pending || !saved.vehicles.front().pulse.isEmpty();
    world.responder.restore(saved);
    world.step(h);
    EXPECT_EQ(world.responder.issues(), step_issue::none) << i;
  }
  EXPECT_TRUE(pending);
  EXPECT_LT(world.responder.velocity(world.car(0)).z(), 0.0);
}

std::string errorOf(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(WorldAxes, WhatIsNoAxisIsAnError) {
  OdeWorld ode;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& up :
       {Eigen::Vector3d(0.0, 0.0, 0.0), Eigen::Vector3d(0.0, 0.0, 2.0),
        Eigen::Vector3d(nan, 0.0, 1.0), Eigen::Vector3d(infinity, 0.0, 0.0)}) {
    EXPECT_NE(errorOf([&] { Responder(ode.world, {.axes = {.up = up}}); }).find("WorldAxes::up"),
              std::string::npos);
    BoxCar car(ode.world);
    Responder responder(ode.world);
    EXPECT_NE(errorOf([&] {
                responder.addVehicle(car.body, car.parameters, {.axes = {.forward = up}});
              }).find("ChassisAxes::forward"),
              std::string::npos);
    EXPECT_NE(errorOf([&] {
                responder.addVehicle(car.body, car.parameters, {.axes = {.up = up}});
              }).find("ChassisAxes::up"),
              std::string::npos);
  }
  for (const double metre : {0.0, -1.0, nan, infinity}) {
    EXPECT_NE(
        errorOf([&] { Responder(ode.world, {.axes = {.metre = metre}}); }).find("WorldAxes::metre"),
        std::string::npos);
  }
  BoxCar car(ode.world);
  EXPECT_NE(errorOf([&] {
              parametersFromBodies(car.body, {}, 2.0, 2.0, 1.8, 0.5, {.forward = z, .up = z});
            }).find("perpendicular"),
            std::string::npos);
}

// Gravity that is not along −up, and a chassis that lies: both are told when the vehicle is added.
TEST(WorldAxes, WhatIsInconsistentIsAWarning) {
  OdeWorld ode;
  dWorldSetGravity(ode.world, 0.0, -9.81, 0.0);
  BoxCar car(ode.world);
  const auto warned = [&](const ResponderOptions& options, const VehicleOptions& vehicle,
                          const std::string& text) {
    Responder responder(ode.world, options);
    responder.addVehicle(car.body, car.parameters, vehicle);
    const auto warnings = responder.warnings();
    return std::any_of(warnings.begin(), warnings.end(), [&](const std::string& each) {
      return each.find(text) != std::string::npos;
    });
  };
  EXPECT_TRUE(warned({}, {}, "gravity"));
  EXPECT_FALSE(warned({}, {}, "leans"));
  EXPECT_FALSE(warned({.axes = {.up = y}}, {}, "gravity"));
  EXPECT_TRUE(warned({.axes = {.up = y}}, {}, "leans"));
  car.parameters.yawInertia = 2400.0;  // about y
  EXPECT_FALSE(warned({.axes = {.up = y}}, {.axes = {.up = y}}, "leans"));
}

}  // namespace
}  // namespace bumper::tests
