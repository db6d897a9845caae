// Vehicles that hit each other: what people complain about in other engines.

#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "bumper/response/error.h"
#include "bumper/scenes/paper_scenes.h"
#include "car_park.h"

namespace bumper::tests {
namespace {

constexpr double pi = 3.14159265358979323846;

int impactsIn(std::span<const ImpactEvent> events) {
  return static_cast<int>(std::count_if(events.begin(), events.end(), [](const ImpactEvent& event) {
    return event.phase == EventPhase::impact;
  }));
}

ResponseSettings bouncing(double restitution, double friction) {
  ResponseSettings settings;
  settings.restitution = AngleCurve::constant(restitution);
  settings.friction = AngleCurve::constant(friction);
  return settings;
}

// Two points at rest on one line: the textbook.
TEST(Vehicles, HeadOnIsTheTextbooksCentralImpact) {
  for (const double h : {0.001, 0.005, 0.02}) {
    CarPark park({.vehicleResponse = bouncing(0.3, 0.0)});
    BoxCar& a = park.add({0.0, 0.0}, 0.0, {20.0, 0.0});
    BoxCar& b = park.add({8.0, 0.0}, pi, {-10.0, 0.0});
    int impacts = 0;
    ImpactEvent event;
    park.run(0.5, h, [&](std::span<const ImpactEvent> events) {
      impacts += impactsIn(events);
      if (!events.empty()) event = events.front();
    });
    EXPECT_EQ(impacts, 1);
    EXPECT_EQ(event.vehicle, "vehicle 0");
    EXPECT_EQ(event.otherVehicle, "vehicle 1");
    EXPECT_EQ(event.barrier, "");
    EXPECT_NEAR(event.approachSpeed, 30.0, 1e-9);
    // They closed 8 − 2 · 2.1 m at 30 m/s.
    EXPECT_NEAR(event.time, 3.8 / 30.0, 1e-9);
    // (m v_a + m v_b ∓ e m v) / 2m
    EXPECT_NEAR(a.velocity().x(), 5.0 - 0.3 * 15.0, 1e-9) << h;
    EXPECT_NEAR(b.velocity().x(), 5.0 + 0.3 * 15.0, 1e-9) << h;
    EXPECT_NEAR(a.velocity().y(), 0.0, 1e-9);
    EXPECT_NEAR(dBodyGetPosition(a.body)[0], 20.0 * 3.8 / 30.0 + 0.5 * (0.5 - 3.8 / 30.0), 1e-9);
    EXPECT_NEAR(event.velocityAfter.x(), 0.5, 1e-9);
    EXPECT_NEAR(event.otherVelocityBefore.x(), -10.0, 1e-9);
    EXPECT_NEAR(event.otherVelocityAfter.x(), 9.5, 1e-9);
  }
}

TEST(Vehicles, EveryOrderOfRegistrationGivesTheSameBits) {
  std::mt19937 random(3);
  for (const int count : {3, 5, 9}) {
    std::vector<int> order(static_cast<std::size_t>(count));
    std::iota(order.begin(), order.end(), 0);
    std::vector<double> first;
    for (int round = 0; round < 8; ++round) {
      CarPark park;
      std::vector<const BoxCar*> cars(order.size());
      for (const int i : order) {
        // A row that touches, hit from both ends.
        const double speed = i == 0 ? 15.0 : (i == count - 1 ? -9.0 : 0.0);
        cars[static_cast<std::size_t>(i)] =
            &park.add({4.6 * i + (i == 0 ? -1.0 : 0.0), 0.07 * i * i}, 0.02 * i, {speed, 0.1 * i});
      }
      park.run(0.5, 0.005);
      std::vector<double> now;
      for (const BoxCar* car : cars) {
        const dReal* p = dBodyGetPosition(car->body);
        now.insert(now.end(), {p[0], p[1], car->velocity().x(), car->velocity().y(),
                               car->angularVelocity().z()});
      }
      if (first.empty()) first = now;
      EXPECT_EQ(now, first) << count << " cars, round " << round;
      std::shuffle(order.begin(), order.end(), random);
    }
  }
}

TEST(Vehicles, TheStepDoesNotMatter) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int round = 0; round < 200; ++round) {
    const double yaw = 2.0 * pi * unit(random);
    const double aside = unit(random) - 0.5;
    const double speed = 5.0 + 55.0 * unit(random);
    std::vector<double> atOneMs;
    for (const double h : {0.001, 0.02}) {
      CarPark park;
      park.add({0.0, 0.0}, 0.0, {0.0, 0.0});
      park.add({8.0, aside}, yaw, {-speed, 0.0});
      int impacts = 0;
      double when = 0.0;
      park.run(0.4, h, [&](std::span<const ImpactEvent> events) {
        impacts += static_cast<int>(events.size());
        if (!events.empty()) when = events.front().time;
      });
      // What slides on afterwards is looked at at other times.
      if (impacts != 1) break;
      std::vector<double> now{when};
      for (const auto& car : park.cars) {
        const dReal* p = dBodyGetPosition(car->body);
        now.insert(now.end(), {p[0], p[1], car->velocity().x(), car->velocity().y(),
                               car->angularVelocity().z()});
      }
      if (atOneMs.empty()) atOneMs = now;
      for (std::size_t i = 0; i < now.size(); ++i) EXPECT_NEAR(now[i], atOneMs[i], 1e-9) << round;
    }
  }
}

TEST(Vehicles, ASideHitDoesNotChatter) {
  for (int degrees = 30; degrees <= 80; degrees += 5) {
    CarPark park({.vehicleResponse = bouncing(0.1, 0.6)});
    park.add({0.0, 0.0}, 0.0, {0.0, 0.0});
    const double yaw = degrees * pi / 180.0;
    park.add({-6.0 * std::cos(yaw), -6.0 * std::sin(yaw)}, yaw,
             {15.0 * std::cos(yaw), 15.0 * std::sin(yaw)});
    int impacts = 0;
    park.run(0.9, 0.005,
             [&](std::span<const ImpactEvent> events) { impacts += impactsIn(events); });
    EXPECT_GE(impacts, 1) << degrees;
    // Its corner, and the side that turns into it.
    EXPECT_LE(impacts, 4) << degrees;
  }
}

TEST(Vehicles, AnEnginePushesAnotherCarWithoutSinkingIn) {
  for (const double h : {0.001, 0.005, 0.02}) {
    CarPark park;
    BoxCar& pushing = park.add({0.0, 0.0}, 0.0, {0.0, 0.0});
    BoxCar& pushed = park.add({4.6 + 1e-4, 0.0}, 0.0, {0.0, 0.0});
    constexpr double force = 1500.0;
    double deepest = 0.0;
    int impacts = 0;
    const double time = 60.0;
    for (int i = 0; i < std::lround(time / h); ++i) {
      park.ode.step(h, &park.responder, [&] {
        dBodyAddForce(pushing.body, force, 0.0, 0.0);
        impacts += impactsIn(park.responder.step(h));
      });
      deepest = std::max(deepest, overlapOf(pushing, pushed));
    }
    EXPECT_LE(deepest, 1e-3) << h;
    EXPECT_LE(impacts, 1) << h;
    EXPECT_NEAR(park.momentum().x(), force * time, 1e-9 * force * time) << h;
    EXPECT_NEAR(pushing.velocity().x(), pushed.velocity().x(), 1e-2) << h;
  }
}

TEST(Vehicles, ACradleAndAQueueGainNoEnergy) {
  for (const double restitution : {1.0, 0.3}) {
    CarPark park({.vehicleResponse = bouncing(restitution, 0.2)});
    for (int i = 0; i < 9; ++i) park.add({4.65 * i, 0.01 * (i % 3)}, 0.003 * i, {0.0, 0.0});
    park.add({-8.0, 0.0}, 0.0, {20.0, 0.0});
    const double whole = park.energy();
    double before = whole;
    const Eigen::Vector3d momentum = park.momentum();
    for (int i = 0; i < 1000; ++i) {
      park.run(0.005, 0.005);
      const double now = park.energy();
      ASSERT_LE(now, before + 1e-12 * whole) << i;
      before = now;
    }
    EXPECT_LE((park.momentum() - momentum).norm(), 1e-9 * momentum.norm());
  }
}

TEST(Vehicles, ALorryHardlyFeelsAWheelbarrow) {
  CarPark park;
  BoxCar& lorry = park.add({-8.0, 0.0}, 0.0, {6.0, 0.0});
  BoxCar& barrow = park.add({0.0, 0.0}, 0.0, {0.0, 0.0});
  const auto setMass = [&](BoxCar& car, double mass) {
    park.responder.removeVehicle(park.ids[&car == &lorry ? 0 : 1]);
    dMass its;
    car.parameters.mass = mass;
    car.parameters.yawInertia = 1.7 * mass;
    dMassSetParameters(&its, mass, 0.0, 0.0, 0.0, mass, mass, 1.7 * mass, 0.0, 0.0, 0.0);
    dBodySetMass(car.body, &its);
    park.responder.addVehicle(car.body, car.parameters);
  };
  setMass(lorry, 19e3);
  setMass(barrow, 20.0);
  for (int i = 0; i < 200; ++i) {
    park.ode.step(0.005, &park.responder, [&] { park.responder.step(0.005); });
  }
  // (1 + e) m_b v / (m_a + m_b), e ≤ 0.3
  EXPECT_LT(lorry.velocity().x(), 6.0 - 1e-3);
  EXPECT_GT(lorry.velocity().x(), 6.0 - 1.3 * 20.0 * 6.0 / 19020.0 - 1e-6);
  EXPECT_GT(barrow.velocity().x(), 5.9);
}

// One that stands, or comes from the wall, and is thrown against it by another.
TEST(Vehicles, OneThatIsThrownAgainstAWallHitsItInTheSameStep) {
  for (const bool guarded : {false, true}) {
    for (const double own : {0.0, -3.0}) {
      for (const double gap : {0.02, 0.2, 0.45}) {
        for (const double h : {0.005, 0.02}) {
          CarPark park({.guardContacts = guarded});
          park.responder.addBarrier(straightWall({0.0, 20.0}, {0.0, -20.0}, 2.0));
          BoxCar& car = park.add({-2.1 - gap, 0.0}, 0.0, {own, 0.0});
          park.add({-2.1 - gap - 4.6 - 0.1, 0.0}, 0.0, {40.0, 0.0});
          double deepest = -1.0;
          for (int i = 0; i < std::lround(0.2 / h); ++i) {
            park.run(h, h);
            deepest = std::max(deepest, dBodyGetPosition(car.body)[0] + 2.1);
          }
          EXPECT_LE(deepest, 1e-6) << guarded << ' ' << own << ' ' << gap << ' ' << h;
        }
      }
    }
  }
}

// A joint that does nothing makes them get guard contacts with each other and with the wall: those
// of the second with the first must know that the first rebounds within the step.
TEST(Vehicles, GuardsHaveNoEffectWithoutLoad) {
  std::array<std::vector<double>, 2> states;
  for (const bool guarded : {false, true}) {
    CarPark park({.guardContacts = guarded});
    park.responder.addBarrier(straightWall({0.0, 20.0}, {0.0, -20.0}, 2.0));
    for (int i = 0; i < 3; ++i) {
      BoxCar& car = park.add({-3.0 - 4.9 * i, 0.2 * i}, 0.05 * i, {20.0 - i, 0.0});
      const dJointID idle = dJointCreateLMotor(park.ode.world, nullptr);
      dJointAttach(idle, car.body, nullptr);
      dJointSetLMotorNumAxes(idle, 1);
      dJointSetLMotorAxis(idle, 0, 0, 1.0, 0.0, 0.0);
      dJointSetLMotorParam(idle, dParamFMax, 0.0);
    }
    int impacts = 0;
    park.run(0.6, 0.01, [&](std::span<const ImpactEvent> events) { impacts += impactsIn(events); });
    EXPECT_GE(impacts, 4);
    for (const auto& car : park.cars) {
      const dReal* p = dBodyGetPosition(car->body);
      states[guarded ? 1 : 0].insert(states[guarded ? 1 : 0].end(),
                                     {p[0], p[1], car->velocity().x(), car->velocity().y()});
    }
  }
  for (std::size_t i = 0; i < states[0].size(); ++i) {
    EXPECT_NEAR(states[1][i], states[0][i], 1e-9) << i;
  }
}

// A step back in time must not leave an old promise that two are apart.
TEST(Vehicles, ThatWereRestoredAreHitAsBefore) {
  CarPark park({.vehicleResponse = bouncing(0.0, 0.0)});
  BoxCar& slow = park.add({0.0, 0.0}, 0.0, {0.4, 0.0});
  park.add({4.6 + 1.0, 0.0}, 0.0, {0.0, 0.0});
  const SavedState saved = park.responder.save();
  const auto gap = [&] {
    return dBodyGetPosition(park.cars[1]->body)[0] - dBodyGetPosition(slow.body)[0] - 4.6;
  };
  for (const double pause : {0.0, 30.0}) {
    park.responder.restore(saved);
    // The world stands meanwhile; the responder's time goes on.
    for (int i = 0; i < std::lround(pause / 0.1); ++i) {
      dBodySetLinearVel(slow.body, 0.0, 0.0, 0.0);
      park.run(0.1, 0.1);
    }
    dBodySetLinearVel(slow.body, 0.4, 0.0, 0.0);
    slow.place({0.0, 0.0, 0.55}, Eigen::Matrix3d::Identity());
    park.cars[1]->place({5.6, 0.0, 0.55}, Eigen::Matrix3d::Identity());
    park.cars[1]->move({0.0, 0.0, 0.0}, {0.0, 0.0, 0.0});
    park.responder.restore(saved);
    double least = 1.0;
    for (int i = 0; i < 1000; ++i) {
      park.run(0.005, 0.005);
      least = std::min(least, gap());
    }
    EXPECT_GE(least, -1e-6) << "after " << pause << " s";
    EXPECT_NEAR(slow.velocity().x(), 0.2, 1e-9) << "after " << pause << " s";
  }
}

TEST(Vehicles, OneThatSleepsIsHitInTheSameStep) {
  CarPark park;
  BoxCar& asleep = park.add({0.0, 0.0}, 0.0, {0.0, 0.0});
  dBodyDisable(asleep.body);
  park.add({-4.6 - 0.01, 0.0}, 0.0, {5.0, 0.0});
  park.ode.step(0.005, &park.responder, [&] { EXPECT_EQ(park.responder.step(0.005).size(), 1U); });
  EXPECT_NE(dBodyIsEnabled(asleep.body), 0);
  EXPECT_GT(asleep.velocity().x(), 0.5);
}

TEST(Vehicles, OneThatSleepsBesideAnotherSleepsOn) {
  CarPark park;
  BoxCar& asleep = park.add({0.0, 0.0}, 0.0, {0.0, 0.0});
  dBodyDisable(asleep.body);
  park.add({-4.6 - 0.01, 0.0}, 0.0, {0.0, 0.0});
  park.run(1.0, 0.005);
  EXPECT_EQ(dBodyIsEnabled(asleep.body), 0);
}

TEST(Vehicles, PlacedIntoEachOtherTheyAreEasedApart) {
  for (const double yaw : {0.0, 0.3, 1.2, 0.5 * pi, 2.5}) {
    CarPark park;
    BoxCar& a = park.add({0.0, 0.0}, 0.0, {0.0, 0.0});
    BoxCar& b = park.add({1.2, 1.5}, yaw, {0.0, 0.0});
    const Eigen::Matrix3d axes =
        Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    for (double away = 1.0; overlapOf(a, b) > 0.3; away += 0.01) {
      b.place({1.2 * away, 1.5 * away, 0.55}, axes);
    }
    EXPECT_GT(overlapOf(a, b), 0.25) << yaw;
    double fastest = 0.0;
    park.run(1.0, 0.005, [&](auto&&) {
      fastest = std::max({fastest, a.velocity().norm(), b.velocity().norm()});
    });
    EXPECT_LE(overlapOf(a, b), 1.1e-4) << yaw;
    EXPECT_LE(fastest, 2.0 + 1e-9) << yaw;
    EXPECT_LE(park.energy(), 1e-9) << yaw;
  }
}

TEST(Vehicles, OneOnABridgeDoesNotMeetOneBelow) {
  CarPark park;
  BoxCar& above = park.add({-6.0, 0.0}, 0.0, {10.0, 0.0});
  park.add({0.0, 0.0}, 0.5 * pi, {0.0, 0.0});
  above.place({-6.0, 0.0, 0.55 + 5.0}, Eigen::Matrix3d::Identity());
  EXPECT_FALSE(park.responder.claims(park.cars[0]->geom, park.cars[1]->geom));
  park.run(1.5, 0.005, [](std::span<const ImpactEvent> events) { EXPECT_TRUE(events.empty()); });
  EXPECT_EQ(above.velocity().x(), 10.0);
}

TEST(Vehicles, ThoseThatAJointConnectsDoNotAnswerEachOther) {
  CarPark park;
  BoxCar& tractor = park.add({0.0, 0.0}, 0.0, {10.0, 0.0});
  BoxCar& trailer = park.add({-4.55, 0.0}, 0.0, {10.0, 0.0});
  const dJointID hitch = dJointCreateBall(park.ode.world, nullptr);
  dJointAttach(hitch, tractor.body, trailer.body);
  dJointSetBallAnchor(hitch, -2.5, 0.0, 0.55);
  EXPECT_FALSE(park.responder.claims(tractor.geom, trailer.geom));
  park.run(1.0, 0.005, [](std::span<const ImpactEvent> events) { EXPECT_TRUE(events.empty()); });
  EXPECT_NEAR(tractor.velocity().x(), 10.0, 1e-6);
}

TEST(Vehicles, AreHitAsThePairIsSet) {
  for (const bool swapped : {false, true}) {
    CarPark park({.vehiclesCollide = false});
    BoxCar& a = park.add({0.0, 0.0}, 0.0, {20.0, 0.0});
    park.add({8.0, 0.0}, pi, {-10.0, 0.0});
    const VehicleId first = park.ids[swapped ? 1 : 0];
    const VehicleId second = park.ids[swapped ? 0 : 1];
    EXPECT_FALSE(park.responder.claims(park.cars[0]->geom, park.cars[1]->geom));
    park.responder.setPair(first, second, {.response = bouncing(1.0, 0.0)});
    EXPECT_TRUE(park.responder.claims(park.cars[0]->geom, park.cars[1]->geom));
    park.run(0.5, 0.005);
    EXPECT_NEAR(a.velocity().x(), -10.0, 1e-9);
  }
  CarPark park;
  park.add({0.0, 0.0}, 0.0, {20.0, 0.0});
  park.add({8.0, 0.0}, pi, {-10.0, 0.0});
  park.responder.setPair(park.ids[0], park.ids[1], {.collide = false});
  EXPECT_FALSE(park.responder.claims(park.cars[0]->geom, park.cars[1]->geom));
  int events = 0;
  for (int i = 0; i < 60; ++i) {
    events += static_cast<int>(park.responder.step(0.005).size());
    dWorldQuickStep(park.ode.world, 0.005);
  }
  EXPECT_EQ(events, 0);
  EXPECT_THROW(park.responder.setPair(park.ids[0], park.ids[0], {}), Error);
  EXPECT_THROW(park.responder.setPair(park.ids[0], {.value = 7}, {}), Error);
  EXPECT_THROW(park.responder.setPair(park.ids[0], park.ids[1], {.response = bouncing(2.0, 0.0)}),
               Error);
  EXPECT_THROW(Responder(park.ode.world, {.vehicleResponse = bouncing(2.0, 0.0)}), Error);
}

// What one of them owns the other must not lose: all contacts of two cars on one road are the
// responder's, those of a car on another's roof are ODE's.
TEST(Vehicles, ContactsAreOwnedByOneOfBoth) {
  CarPark park;
  BoxCar& a = park.add({0.0, 0.0}, 0.0, {0.0, 0.0});
  BoxCar& b = park.add({4.59, 0.3}, 0.1, {0.0, 0.0});
  dContact contacts[16];
  int count = dCollide(a.geom, b.geom, 16, &contacts[0].geom, sizeof(dContact));
  ASSERT_GT(count, 0);
  EXPECT_TRUE(park.responder.claims(a.geom, b.geom));
  EXPECT_EQ(park.responder.keepUnclaimed(a.geom, b.geom, contacts, count), 0);
  b.place({0.5, 0.1, 0.55 + 0.69}, Eigen::Matrix3d::Identity());
  count = dCollide(a.geom, b.geom, 16, &contacts[0].geom, sizeof(dContact));
  ASSERT_GT(count, 0);
  EXPECT_FALSE(park.responder.claims(a.geom, b.geom));
  EXPECT_EQ(park.responder.keepUnclaimed(a.geom, b.geom, contacts, count), count);
}

TEST(Vehicles, AreSavedAndRestoredBitForBit) {
  const auto states = [](const CarPark& park) {
    std::vector<double> all;
    for (const auto& car : park.cars) {
      const dReal* p = dBodyGetPosition(car->body);
      const dReal* r = dBodyGetQuaternion(car->body);
      all.insert(all.end(), p, p + 3);
      all.insert(all.end(), r, r + 4);
      for (int k = 0; k < 3; ++k) {
        all.push_back(car->velocity()[k]);
        all.push_back(car->angularVelocity()[k]);
      }
    }
    return all;
  };
  const auto set = [](const CarPark& park, const std::vector<double>& all) {
    const double* next = all.data();
    for (const auto& car : park.cars) {
      dBodySetPosition(car->body, next[0], next[1], next[2]);
      dBodySetQuaternion(car->body, next + 3);
      dBodySetLinearVel(car->body, next[7], next[9], next[11]);
      dBodySetAngularVel(car->body, next[8], next[10], next[12]);
      next += 13;
    }
  };
  ResponseSettings slow;
  slow.contactTime = 0.03;
  CarPark park({.vehicleResponse = slow});
  for (int i = 0; i < 4; ++i) park.add({4.7 * i, 0.2 * i}, 0.1 * i, {i == 0 ? 12.0 : 0.0, 0.0});
  park.run(0.05, 0.005);
  const SavedState saved = park.responder.save();
  const std::vector<double> then = states(park);
  // Setting a quaternion normalizes it: the first run starts from what was set, too.
  std::vector<double> once;
  for (int round = 0; round < 3; ++round) {
    set(park, then);
    park.responder.restore(saved);
    park.run(0.5, 0.005);
    if (once.empty()) once = states(park);
    EXPECT_EQ(states(park), once) << round;
    park.run(0.1 * round, 0.005);
  }
}

TEST(Vehicles, ThatWereRemovedAreHitNoMore) {
  CarPark park;
  park.add({0.0, 0.0}, 0.0, {5.0, 0.0});
  BoxCar& b = park.add({4.61, 0.0}, 0.0, {0.0, 0.0});
  park.run(0.02, 0.005);
  park.responder.removeVehicle(park.ids[1]);
  for (int i = 0; i < 100; ++i) {
    park.responder.step(0.005);
    dWorldQuickStep(park.ode.world, 0.005);
  }
  b.place({12.0, 0.0, 0.55}, Eigen::Matrix3d::Identity());
  EXPECT_EQ(park.responder.issues(), step_issue::none);
}

// A body that the application moves, as a gate is: 6 m wide, 0.2 m thick, across the x axis.
class Gate {
 public:
  Gate(CarPark& park, Mover mover, double mass = 1500.0)
      : park_(park), body(dBodyCreate(park.ode.world)) {
    dBodySetKinematic(body);
    const VehicleParameters outline{.mass = mass,
                                    .yawInertia = 2600.0 / 1500.0 * mass,
                                    .massCentreToFront = 0.1,
                                    .massCentreToRear = 0.1,
                                    .width = 6.0,
                                    .massCentreHeight = 0.55};
    dBodySetPosition(body, -3.0, 0.0, 0.55);
    id = park.responder.addVehicle(body, outline, {.name = "gate", .mover = mover});
  }
  void move(double speed) { dBodySetLinearVel(body, speed, 0.0, 0.0); }

 private:
  CarPark& park_;

 public:
  dBodyID body;
  VehicleId id;
};

TEST(Vehicles, AGatePushesACarNoFasterThanItself) {
  for (const double h : {0.001, 0.005, 0.02}) {
    CarPark park;
    BoxCar& car = park.add({2.5 + 0.1, 0.4}, 0.0, {0.0, 0.0});
    Gate gate(park, Mover::application);
    gate.move(1.0);
    double fastest = 0.0;
    for (int i = 0; i < std::lround(8.0 / h); ++i) {
      park.run(h, h);
      fastest = std::max(fastest, car.velocity().x());
    }
    EXPECT_LE(fastest, 1.3 + 1e-9) << h;
    EXPECT_GE(car.velocity().x(), 0.9) << h;
    const double gap = dBodyGetPosition(car.body)[0] - 2.5 - dBodyGetPosition(gate.body)[0] - 0.1;
    EXPECT_GE(gap, -1e-3) << h;
    EXPECT_NEAR(dBodyGetLinearVel(gate.body)[0], 1.0, 0.0) << h;
  }
}

TEST(Vehicles, ACarHitsAGateAsItHitsAWallThatMoves) {
  CarPark park({.vehicleResponse = bouncing(0.3, 0.0)});
  BoxCar& car = park.add({20.0, 0.0}, pi, {-10.0, 0.0});
  Gate gate(park, Mover::application);
  gate.move(5.0);
  ImpactEvent event;
  park.run(2.0, 0.005, [&](std::span<const ImpactEvent> events) {
    if (!events.empty()) event = events.front();
  });
  // 5 + 0.3 · 15
  EXPECT_NEAR(car.velocity().x(), 9.5, 1e-9);
  EXPECT_NEAR(event.approachSpeed, 15.0, 1e-9);
  EXPECT_EQ(event.otherVehicle, "gate");
  EXPECT_EQ(dBodyGetLinearVel(gate.body)[0], 5.0);
}

// Two hosts with a car each: either sees its own and the other's, and both get what one host with
// both cars gets.
TEST(Vehicles, TwoHostsAgree) {
  CarPark both;
  both.add({0.0, 0.1}, 0.3, {15.0, 0.0}, 0.4);
  both.add({9.0, 0.6}, 2.4, {-5.0, 0.0});
  constexpr double h = 0.005;
  std::array<CarPark, 2> hosts;
  std::array<dBodyID, 2> remote{};
  for (std::size_t host = 0; host < hosts.size(); ++host) {
    CarPark& park = hosts[host];
    for (std::size_t car = 0; car < 2; ++car) {
      const BoxCar& original = *both.cars[car];
      const dReal* p = dBodyGetPosition(original.body);
      const Eigen::Vector3d v = original.velocity();
      if (car == host) {
        park.add({p[0], p[1]}, car == 0 ? 0.3 : 2.4, {v.x(), v.y()}, car == 0 ? 0.4 : 0.0);
      } else {
        remote[host] = dBodyCreate(park.ode.world);
        dBodySetKinematic(remote[host]);
        park.responder.addVehicle(remote[host], original.parameters,
                                  {.name = "remote", .mover = Mover::other_host});
      }
    }
  }
  int impacts = 0;
  both.run(1.0, h, [&](std::span<const ImpactEvent> events) { impacts += impactsIn(events); });
  EXPECT_GE(impacts, 1);
  std::array<int, 2> seen{};
  for (int i = 0; i < 200; ++i) {
    for (std::size_t host = 0; host < hosts.size(); ++host) {
      const std::unique_ptr<BoxCar>& other = hosts[1 - host].cars.front();
      const dReal* p = dBodyGetPosition(other->body);
      const Eigen::Vector3d v = hosts[1 - host].responder.velocity(hosts[1 - host].ids.front());
      dBodySetPosition(remote[host], p[0], p[1], p[2]);
      dBodySetQuaternion(remote[host], dBodyGetQuaternion(other->body));
      dBodySetLinearVel(remote[host], v.x(), v.y(), v.z());
      dBodySetAngularVel(remote[host], 0.0, 0.0,
                         hosts[1 - host].responder.yawRate(hosts[1 - host].ids.front()));
    }
    for (std::size_t host = 0; host < hosts.size(); ++host) {
      hosts[host].run(
          h, h, [&](std::span<const ImpactEvent> events) { seen[host] += impactsIn(events); });
    }
  }
  for (std::size_t host = 0; host < hosts.size(); ++host) {
    EXPECT_EQ(seen[host], impacts);
    const BoxCar& own = *hosts[host].cars.front();
    for (int k = 0; k < 2; ++k) {
      EXPECT_NEAR(dBodyGetPosition(own.body)[k], dBodyGetPosition(both.cars[host]->body)[k], 1e-9);
      EXPECT_NEAR(own.velocity()[k], both.cars[host]->velocity()[k], 1e-9);
    }
  }
}

// A recording takes each vehicle's impacts in the order of their times.
TEST(Vehicles, EventsOfAStepAreInTheOrderOfTime) {
  CarPark park;
  park.responder.addBarrier(straightWall({0.0, 50.0}, {0.0, -50.0}, 2.0),
                            {.space = park.ode.space});
  for (int i = 0; i < 6; ++i) park.add({-3.0 - 4.75 * i, 0.1 * (i % 3)}, 0.0, {25.0, 0.0});
  int mixed = 0;
  park.run(1.0, 0.02, [&](std::span<const ImpactEvent> events) {
    EXPECT_TRUE(std::ranges::is_sorted(events, {}, &ImpactEvent::time));
    const auto hasWall = [](const ImpactEvent& event) { return event.otherVehicle.empty(); };
    mixed += std::ranges::any_of(events, hasWall) && !std::ranges::all_of(events, hasWall) ? 1 : 0;
  });
  EXPECT_GE(mixed, 1);
}

TEST(Vehicles, APileUpComesToRestInOrder) {
  CarPark park;
  park.responder.addBarrier(straightWall({0.0, 500.0}, {0.0, -500.0}, 2.0),
                            {.space = park.ode.space});
  constexpr int count = 30;
  for (int i = 0; i < count; ++i) park.add({-10.0 - 12.0 * i, 0.02 * (i % 5)}, 0.0, {25.0, 0.0});
  double deepest = 0.0;
  const double whole = park.energy();
  double before = whole;
  for (int i = 0; i < 4000; ++i) {
    park.ode.step(0.005, &park.responder, [&] {
      // They brake at last.
      for (const auto& car : park.cars) {
        const Eigen::Vector3d v = car->velocity();
        const double drag = i * 0.005 > 8.0 ? 1500.0 : 0.0;
        dBodyAddForce(car->body, -drag * v.x(), -drag * v.y(), 0.0);
        dBodyAddTorque(car->body, 0.0, 0.0, -2.0 * drag * car->angularVelocity().z());
      }
      park.responder.step(0.005);
    });
    const double now = park.energy();
    ASSERT_LE(now, before + 1e-12 * whole) << i;
    before = now;
    for (std::size_t k = 0; k + 1 < park.cars.size(); ++k) {
      deepest = std::max(deepest, overlapOf(*park.cars[k], *park.cars[k + 1]));
    }
  }
  EXPECT_LE(deepest, 0.1);
  for (const auto& car : park.cars) {
    EXPECT_LE(dBodyGetPosition(car->body)[0], -0.88);
    EXPECT_LE(car->velocity().norm(), 0.2);
  }
  EXPECT_EQ(park.responder.issues() & step_issue::unsettled, 0U);
}

}  // namespace
}  // namespace bumper::tests
