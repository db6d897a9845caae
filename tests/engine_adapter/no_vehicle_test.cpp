// A responder without vehicles changes nothing in a world: not a bit of its motion, no contact, and
// none of ODE's random numbers.

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "free_drive.h"
#include "hinge2_car.h"
#include "ode_world.h"

namespace bumper::tests {
namespace {

constexpr double h = 0.005;

/// All that can be seen of a world while cars on wheels and loose boxes hit walls and each other.
std::vector<double> seen(bool withResponder) {
  OdeWorld ode(9.81);
  ode.bounce = 0.2;
  const dGeomID ground = dCreatePlane(ode.space, 0.0, 0.0, 1.0, 0.0);
  const OdeMesh walls(ode.space, sheets({{8.0, -9.0}, {8.0, 9.0}, {-8.0, 9.0}}));
  const dGeomID block = dCreateBox(ode.space, 2.0, 2.0, 2.0);
  dGeomSetPosition(block, 3.0, 5.0, 1.0);
  std::unique_ptr<Responder> responder;
  if (withResponder) {
    responder = std::make_unique<Responder>(ode.world);
    responder->addBarrier(walls.geom);
    responder->addBarriers(ode.space);
  }
  Hinge2Car car(ode.world, ode.space, {0.0, 0.0}, 0.0, 0.3, 15.0);
  std::vector<std::unique_ptr<BoxCar>> boxes;
  for (int i = 0; i < 3; ++i) {
    boxes.push_back(std::make_unique<BoxCar>(ode.world, ode.space));
    boxes.back()->place({-1.0, 4.0, 1.0 + 1.5 * i}, Eigen::Matrix3d::Identity());
    boxes.back()->move({6.0, 1.0, 0.0}, {0.0, 0.0, 1.0});
  }
  std::vector<double> numbers;
  const auto add = [&](const dReal* values, int count) {
    numbers.insert(numbers.end(), values, values + count);
  };
  for (int i = 0; i < 300; ++i) {
    ode.step(i % 5 == 0 ? 0.5 * h : h, responder.get(), [&] {
      if (responder) {
        EXPECT_TRUE(responder->step(i % 5 == 0 ? 0.5 * h : h).empty());
        EXPECT_EQ(responder->issues(), step_issue::none);
      }
    });
    numbers.push_back(static_cast<double>(dRandGetSeed()));
    for (const dContactGeom& contact : ode.contacts) {
      add(contact.pos, 3);
      add(contact.normal, 3);
      numbers.push_back(contact.depth);
    }
    std::vector<dBodyID> bodies{car.chassis};
    bodies.insert(bodies.end(), car.wheels.begin(), car.wheels.end());
    for (const auto& box : boxes) bodies.push_back(box->body);
    for (dBodyID body : bodies) {
      add(dBodyGetPosition(body), 3);
      add(dBodyGetQuaternion(body), 4);
      add(dBodyGetLinearVel(body), 3);
      add(dBodyGetAngularVel(body), 3);
    }
  }
  EXPECT_NE(ground, nullptr);
  return numbers;
}

TEST(NoVehicle, ChangesNothing) {
  const std::vector<double> without = seen(false);
  EXPECT_EQ(seen(true), without);
  EXPECT_GT(without.size(), 300U * 100U);
}

}  // namespace
}  // namespace bumper::tests
