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
        mesh_ = std::make_unique<OdeMesh>(
            ode.space, standing(Plan{line}, 4.0, fine ? 600 : 1, fine ? 3 : 1));
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

TEST(Pushed, AQueueDoesNotPushItsFirstCarThrough) {
  std::mt19937 random(20261129);
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
    EXPECT_LE(past, 0.15) << s << "; " << queue.cars << " cars, " << queue.speed << " m/s";
    EXPECT_LE(past, byJoints) << s << "; " << queue.cars << " cars, " << queue.speed << " m/s";
    EXPECT_LE(road.mostEnergy, std::max(road.cars.size() * 1.0, 1.0001) * joints.mostEnergy);
    std::printf("queue %d %.1f off %.2f h %.4f wall %d: %.4f joints %.4f energy %.4f joints %.4f impacts %d\n",
                queue.cars, queue.speed, queue.off, s.step, static_cast<int>(s.wall), past, byJoints,
                road.mostEnergy, joints.mostEnergy, road.impacts);
  }
}

}  // namespace
}  // namespace bumper::tests
