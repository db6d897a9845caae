// What pushes a vehicle against a wall through contacts and joints, of which nothing is known when
// a step is answered: queues, lorries, trailers, motors. The wall holds, and tells little.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <string>
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

enum class Against { bumper, contact_joints };
enum class Wall { sheet, fine_mesh, box, plane };

/// A level road with a wall along a line through the origin, on whose left side everything happens.
/// Its normal points to `heading`, rad.
class Road {
 public:
  Road(double heading, Wall wall, Against against)
      : ode(gravity), heading_(heading), responder_(ode.world) {
    dCreatePlane(ode.space, 0.0, 0.0, 1.0, 0.0);
    ode.bounce = 0.05;
    const Vector2 along = turnedLeft(normal());
    const Line line{-150.0 * along, 150.0 * along};
    switch (wall) {
      case Wall::sheet:
      case Wall::fine_mesh: {
        const bool fine = wall == Wall::fine_mesh;
        mesh_ = std::make_unique<OdeMesh>(ode.space,
                                          standing(Plan{line}, 4.0, fine ? 600 : 1, fine ? 3 : 1));
        geom_ = mesh_->geom;
        break;
      }
      case Wall::box: {
        geom_ = dCreateBox(ode.space, 1.0, 300.0, 4.0);
        dMatrix3 rotation;
        dRFromAxisAndAngle(rotation, 0.0, 0.0, 1.0, heading);
        dGeomSetRotation(geom_, rotation);
        dGeomSetPosition(geom_, -0.5 * normal().x(), -0.5 * normal().y(), 2.0);
        break;
      }
      case Wall::plane:
        geom_ = dCreatePlane(ode.space, normal().x(), normal().y(), 0.0, 0.0);
        break;
    }
    if (against == Against::bumper) {
      responder_.addBarrier(geom_);
      isAnswered_ = true;
    }
  }

  [[nodiscard]] Vector2 normal() const { return {std::cos(heading_), std::sin(heading_)}; }
  /// A place so far off the wall and so far along it.
  [[nodiscard]] Vector2 at(double off, double along) const {
    return off * normal() + along * turnedLeft(normal());
  }
  /// The heading of somebody who drives at the wall at an angle to it, rad; π/2 is head-on.
  [[nodiscard]] double drivingAt(double angle) const {
    return heading_ + std::numbers::pi + 0.5 * std::numbers::pi - angle;
  }

  /// Cars roll freely unless told otherwise.
  Hinge2Car& addCar(const Vector2& place, double yaw, double speed) {
    cars.push_back(std::make_unique<Hinge2Car>(ode.world, ode.space, place, 0.0, yaw, speed));
    Hinge2Car& car = *cars.back();
    ids.push_back(isAnswered_ ? responder_.addVehicle(car.chassis, car.parameters(),
                                                      {.linkedBodies = car.wheels})
                              : VehicleId{});
    return car;
  }

  /// A box that slides without weight; no vehicle.
  dBodyID addLoad(const Vector2& place, double yaw, double mass, double speed) {
    const dBodyID body = dBodyCreate(ode.world);
    dMass inertia;
    dMassSetBoxTotal(&inertia, mass, 6.0, 2.4, 0.9);
    dBodySetMass(body, &inertia);
    dBodySetGravityMode(body, 0);
    dBodySetPosition(body, place.x(), place.y(), 0.62);
    dMatrix3 rotation;
    dRFromAxisAndAngle(rotation, 0.0, 0.0, 1.0, yaw);
    dBodySetRotation(body, rotation);
    dBodySetLinearVel(body, speed * std::cos(yaw), speed * std::sin(yaw), 0.0);
    dGeomSetBody(dCreateBox(ode.space, 6.0, 2.4, 0.9), body);
    loads.push_back(body);
    return body;
  }

  void step(double h, Stepper stepper) {
    ode.step(
        h, isAnswered_ ? &responder_ : nullptr,
        [&] {
          if (!isAnswered_) return;
          for (const ImpactEvent& event : responder_.step(h)) {
            impacts += event.phase == EventPhase::impact ? 1 : 0;
            begins += event.phase == EventPhase::contact_begin ? 1 : 0;
            ends += event.phase == EventPhase::contact_end ? 1 : 0;
            if (event.phase == EventPhase::contact_end) lastEnd = event;
          }
        },
        stepper);
    const Hinge2Car& first = *cars.front();
    for (const double x : {Hinge2Car::front, -Hinge2Car::rear}) {
      for (const double y : {0.5 * Hinge2Car::width, -0.5 * Hinge2Car::width}) {
        dVector3 corner;
        dBodyGetRelPointPos(first.chassis, x, y, 0.0, corner);
        past = std::max(past, -normal().dot(Vector2(corner[0], corner[1])));
      }
    }
    mostEnergy = std::max(mostEnergy, energy());
  }

  /// Of all bodies, moving, J.
  [[nodiscard]] double energy() const {
    double sum = 0.0;
    const auto add = [&sum](dBodyID body) {
      dMass mass;
      dBodyGetMass(body, &mass);
      const Eigen::Map<const Eigen::Vector3d> velocity(dBodyGetLinearVel(body));
      sum += 0.5 * mass.mass * velocity.squaredNorm();
    };
    for (const auto& car : cars) {
      add(car->chassis);
      for (dBodyID wheel : car->wheels) add(wheel);
    }
    for (dBodyID load : loads) add(load);
    return sum;
  }

  OdeWorld ode;
  std::vector<std::unique_ptr<Hinge2Car>> cars;
  std::vector<VehicleId> ids;
  std::vector<dBodyID> loads;
  double past = -1.0;  // m, the first car's deepest point behind the wall
  double mostEnergy = 0.0;
  int impacts = 0;
  int begins = 0;
  int ends = 0;
  ImpactEvent lastEnd;

 private:
  double heading_;
  dGeomID geom_ = nullptr;
  std::unique_ptr<OdeMesh> mesh_;
  Responder responder_;
  bool isAnswered_ = false;
};

struct Situation {
  double heading = 0.0;  // rad, of the wall's normal
  Wall wall = Wall::sheet;
  double step = 0.005;  // s
  Stepper stepper = Stepper::quick;
};

std::ostream& operator<<(std::ostream& out, const Situation& s) {
  return out << "heading " << s.heading << ", wall " << static_cast<int>(s.wall) << ", step "
             << 1e3 * s.step << " ms, stepper " << static_cast<int>(s.stepper);
}

Situation randomSituation(std::mt19937& random, bool quickOnly = false) {
  const auto pick = [&random](int count) {
    return std::uniform_int_distribution<int>(0, count - 1)(random);
  };
  constexpr std::array<double, 4> steps = {0.002, 0.005, 0.01, 0.0167};
  return {.heading = std::uniform_real_distribution<double>(-3.0, 3.0)(random),
          .wall = static_cast<Wall>(pick(4)),
          .step = steps[static_cast<std::size_t>(pick(4))],
          .stepper = quickOnly || pick(2) == 0 ? Stepper::quick : Stepper::exact};
}

double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

struct Queue {
  int cars = 6;
  double speed = 30.0;  // m/s
  double gap = 0.8;     // m between cars
  double aside = 0.1;   // m, each further than the one before
  double off = 2.5;     // m, the first one's bumper from the wall
};

double drive(Road& road, const Queue& queue, const Situation& s) {
  const double yaw = road.drivingAt(90.0 * degree);
  for (int i = 0; i < queue.cars; ++i) {
    const double off = queue.off + Hinge2Car::front + (4.2 + queue.gap) * i;
    road.addCar(road.at(off, queue.aside * i), yaw, queue.speed);
  }
  const double duration = 1.0 + queue.cars * (4.2 + queue.gap) / queue.speed;
  for (double t = 0.0; t < duration; t += s.step) road.step(s.step, s.stepper);
  return road.past;
}

// The largest of a series, for a line of figures.
struct Largest {
  double value = 0.0;
  void include(double other) { value = std::max(value, other); }
};

TEST(Pushed, AQueueDoesNotPushItsFirstCarThrough) {
  std::mt19937 random(20261129);
  Largest deepest;
  Largest deepestOfJoints;
  for (int i = 0; i < extent(6, 150); ++i) {
    const Situation s = randomSituation(random, true);
    const Queue queue{.cars = std::uniform_int_distribution<int>(2, extent(8, 20))(random),
                      .speed = uniform(random, 10.0, 40.0),
                      .gap = uniform(random, 0.2, 3.0),
                      .aside = uniform(random, -0.2, 0.2),
                      .off = uniform(random, 0.05, 6.0)};
    Road road(s.heading, s.wall, Against::bumper);
    Road joints(s.heading, s.wall, Against::contact_joints);
    const double past = drive(road, queue, s);
    const double byJoints = drive(joints, queue, s);
    EXPECT_LE(past, 0.05) << s << "; " << queue.cars << " cars, " << queue.speed << " m/s";
    EXPECT_LE(past, byJoints) << s << "; " << queue.cars << " cars, " << queue.speed << " m/s";
    // Of a motor's own work little: a part in a thousand.
    EXPECT_LE(road.mostEnergy, 1.001 * joints.mostEnergy) << s;
    deepest.include(past);
    deepestOfJoints.include(byJoints);
  }
  std::printf("[ figures  ] queues: deepest %.1f mm (joints %.1f)\n", 1e3 * deepest.value,
              1e3 * deepestOfJoints.value);
}

struct Blow {
  double mass = 30000.0;  // kg
  double speed = 20.0;    // m/s, of a load that comes from behind
  double force = 0.0;     // N, with which it pushes on
  double off = 0.05;      // m, the parked car's bumper from the wall
  double angle = 90.0;    // deg, of the car against the wall
  double duration = 3.0;  // s
};

// Car and load in one line at the wall.
double run(Road& road, const Blow& blow, const Situation& s) {
  const double yaw = road.drivingAt(blow.angle * degree);
  const Vector2 ahead{std::cos(yaw), std::sin(yaw)};
  // The corner that is nearest stands `off` the wall.
  const double reach = Hinge2Car::front * std::sin(blow.angle * degree) +
                       0.5 * Hinge2Car::width * std::cos(blow.angle * degree);
  const Vector2 place = road.at(blow.off + reach, 0.0);
  road.addCar(place, yaw, 0.0);
  const Vector2 behind = place - (Hinge2Car::rear + 3.0 + 0.2) * ahead;
  const dBodyID load = road.addLoad(behind, yaw, blow.mass, blow.speed);
  for (double t = 0.0; t < blow.duration; t += s.step) {
    dBodyAddForce(load, blow.force * ahead.x(), blow.force * ahead.y(), 0.0);
    road.step(s.step, s.stepper);
  }
  return road.past;
}

TEST(Pushed, ALorryDoesNotRamAParkedCarThrough) {
  std::mt19937 random(4711);
  Largest deepest;
  Largest deepestOfJoints;
  double sum = 0.0;
  double sumOfJoints = 0.0;
  for (int i = 0; i < extent(12, 300); ++i) {
    const Situation s = randomSituation(random, true);
    const Blow blow{.mass = uniform(random, 1000.0, 30000.0),
                    .speed = uniform(random, 5.0, 20.0),
                    .off = uniform(random, 0.0, 1.0),
                    .angle = uniform(random, 60.0, 90.0)};
    Road road(s.heading, s.wall, Against::bumper);
    Road joints(s.heading, s.wall, Against::contact_joints);
    const double past = run(road, blow, s);
    const double byJoints = run(joints, blow, s);
    EXPECT_LE(past, 0.1) << s << "; " << blow.mass << " kg, " << blow.speed << " m/s, off "
                         << blow.off << ", " << blow.angle << " deg";
    // QuickStep's iterations end where they end: less in the mean, not in each single run.
    sum += std::max(past, 0.0);
    sumOfJoints += std::max(byJoints, 0.0);
    EXPECT_LE(road.mostEnergy, 1.001 * joints.mostEnergy) << s;
    deepest.include(past);
    deepestOfJoints.include(byJoints);
  }
  EXPECT_LE(sum, 0.3 * sumOfJoints);
  std::printf("[ figures  ] rammed: deepest %.1f mm (joints %.1f)\n", 1e3 * deepest.value,
              1e3 * deepestOfJoints.value);
}

// … and is heard once, not at every step.
TEST(Pushed, ALoadThatPressesACarForTenSecondsIsOneContact) {
  std::mt19937 random(42);
  Largest deepest;
  Largest impacts;
  for (int i = 0; i < extent(4, 60); ++i) {
    const Situation s = randomSituation(random, true);
    const Blow blow{.mass = uniform(random, 1000.0, 30000.0),
                    .speed = 0.0,
                    .force = uniform(random, 2e4, 2e5),
                    .off = uniform(random, 0.02, 0.3),
                    .duration = 10.0};
    Road road(s.heading, s.wall, Against::bumper);
    const double past = run(road, blow, s);
    EXPECT_LE(past, 0.02) << s << "; " << blow.mass << " kg, " << blow.force << " N";
    EXPECT_LE(road.impacts, 20) << s << "; " << blow.mass << " kg, " << blow.force << " N";
    EXPECT_LE(road.begins, 1 + road.ends) << s;
    deepest.include(past);
    impacts.include(road.impacts);
  }
  std::printf("[ figures  ] pressed: deepest %.2f mm, at most %.0f impacts\n", 1e3 * deepest.value,
              impacts.value);
}

// The sum that the end of a contact tells is the load's.
TEST(Pushed, AContactTellsTheLoadThatItCarried) {
  const double h = 0.005;
  Road road(0.3, Wall::sheet, Against::bumper);
  const double yaw = road.drivingAt(90.0 * degree);
  const Hinge2Car& car = road.addCar(road.at(Hinge2Car::front + 0.02, 0.0), yaw, 0.0);
  const Vector2 ahead{std::cos(yaw), std::sin(yaw)};
  constexpr double force = 50e3;
  const int steps = static_cast<int>(10.0 / h);
  for (int i = 0; i < steps; ++i) {
    dBodyAddForce(car.chassis, force * ahead.x(), force * ahead.y(), 0.0);
    road.step(h, Stepper::quick);
  }
  EXPECT_EQ(road.begins, 1);
  EXPECT_LE(road.impacts, 2);
  EXPECT_EQ(road.ends, 0);
  // Away from it again.
  for (int i = 0; i < static_cast<int>(3.0 / h); ++i) {
    dBodyAddForce(car.chassis, -3e3 * ahead.x(), -3e3 * ahead.y(), 0.0);
    road.step(h, Stepper::quick);
  }
  ASSERT_EQ(road.ends, 1);
  EXPECT_NEAR(road.lastEnd.impulseNormal, 10.0 * force, 0.02 * 10.0 * force);
}

// Two bodies on a ball joint, without ground: what the rear one does to the front one comes through
// the joint.
struct Hitch {
  double frontMass = 8000.0;
  double rearMass = 32000.0;
  double speed = 25.0;
  double angle = 90.0;  // deg, of their way against the wall
};

double crash(const Hitch& hitch, Against against, const Situation& s) {
  const dWorldID world = dWorldCreate();
  const auto body = [&](double mass, double length, double x, double y, double yaw) {
    const dBodyID made = dBodyCreate(world);
    dMass inertia;
    dMassSetBoxTotal(&inertia, mass, length, 2.5, 2.0);
    dBodySetMass(made, &inertia);
    dBodySetPosition(made, x, y, 1.2);
    dMatrix3 rotation;
    dRFromAxisAndAngle(rotation, 0.0, 0.0, 1.0, yaw);
    dBodySetRotation(made, rotation);
    dBodySetLinearVel(made, hitch.speed * std::cos(yaw), hitch.speed * std::sin(yaw), 0.0);
    return made;
  };
  // The wall is the line x = 14.
  const double yaw = (90.0 - hitch.angle) * degree;
  const dBodyID front = body(hitch.frontMass, 6.0, 0.0, 0.0, yaw);
  const dBodyID rear = body(hitch.rearMass, 12.0, -9.2 * std::cos(yaw), -9.2 * std::sin(yaw), yaw);
  const dJointID joint = dJointCreateBall(world, nullptr);
  dJointAttach(joint, front, rear);
  dJointSetBallAnchor(joint, -3.1 * std::cos(yaw), -3.1 * std::sin(yaw), 1.2);
  double past = -100.0;
  {
    Responder responder(world);
    responder.addBarrier(standing(Plan{{{14.0, -200.0}, {14.0, 200.0}}}, 4.0, 1, 1));
    const auto add = [&](dBodyID chassis, double length) {
      responder.addVehicle(chassis,
                           parametersFromBodies(chassis, {}, 0.5 * length, 0.5 * length, 2.5, 1.2));
    };
    if (against == Against::bumper) {
      add(front, 6.0);
      add(rear, 12.0);
    }
    const double duration = 30.0 / hitch.speed / std::sin(hitch.angle * degree) + 1.0;
    for (double t = 0.0; t < duration; t += s.step) {
      responder.step(s.step);
      if (s.stepper == Stepper::quick) {
        dWorldQuickStep(world, s.step);
      } else {
        dWorldStep(world, s.step);
      }
      for (const double y : {1.25, -1.25}) {
        dVector3 corner;
        dBodyGetRelPointPos(front, 3.0, y, 0.0, corner);
        past = std::max(past, corner[0] - 14.0);
      }
    }
  }
  dWorldDestroy(world);
  return past;
}

TEST(Pushed, ATrailerDoesNotPushItsTractorIn) {
  std::mt19937 random(8032);
  Largest deepest;
  constexpr std::array<double, 4> steps = {0.002, 0.005, 0.0167, 0.033};
  for (int i = 0; i < extent(40, 2000); ++i) {
    const Situation s{.step = steps[static_cast<std::size_t>(i) % 4],
                      .stepper = i % 8 < 4 ? Stepper::quick : Stepper::exact};
    Hitch hitch{.frontMass = uniform(random, 1000.0, 10000.0),
                .rearMass = 0.0,
                .speed = uniform(random, 5.0, 30.0),
                .angle = uniform(random, 10.0, 90.0)};
    // At more than eight times the mass QuickStep's iterations no longer reach the joint.
    hitch.rearMass = uniform(random, 0.05, 8.0) * hitch.frontMass;
    const double past = crash(hitch, Against::bumper, s);
    EXPECT_LE(past, 0.02) << s << "; " << hitch.frontMass << " + " << hitch.rearMass << " kg, "
                          << hitch.speed << " m/s, " << hitch.angle << " deg";
    deepest.include(past);
  }
  std::printf("[ figures  ] hitched: deepest %.2f mm\n", 1e3 * deepest.value);
}

}  // namespace
}  // namespace bumper::tests
