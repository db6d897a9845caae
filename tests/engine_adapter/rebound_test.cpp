// A car that coasts into a wall comes back as the law says, whatever stands at the wall's foot: the
// wheels are ODE's there, the chassis is Bumper's, and nothing is answered twice.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "bumper/engine_adapter/responder.h"
#include "hinge2_car.h"
#include "ode_world.h"
#include "wall_profiles.h"

namespace bumper::tests {
namespace {

struct Coast {
  double speed = 20.0;    // m/s
  double off = 1.0;       // m, of the car's front from the face
  double heading = 0.0;   // rad, of the whole scene
  double step = 0.005;    // s
  double fineness = 0.5;  // m, of the mesh
};

struct Outcome {
  double back = 0.0;   // m/s, the fastest away from the wall
  double up = 0.0;     // m/s, the fastest upwards
  double past = -1.0;  // m, of the front behind the face
};

Outcome coast(const WallProfile& profile, const Coast& way, bool answered) {
  const Eigen::Isometry3d place(
      Eigen::AngleAxisd(way.heading, Eigen::Vector3d::UnitZ()).toRotationMatrix());
  const ProfileScene scene(profile, way.fineness, place);
  OdeWorld ode(9.81);
  const OdeMesh mesh(ode.space, scene.scene);
  dCreatePlane(ode.space, 0.0, 0.0, 1.0, 0.0);  // the road goes on
  const Eigen::Vector3d start =
      place * Eigen::Vector3d(profile.faceX - Hinge2Car::front - way.off, 0.0, 0.0);
  Hinge2Car car(ode.world, ode.space, start.head<2>(), 0.0, way.heading, way.speed);
  Responder responder(ode.world);
  if (answered) {
    responder.addBarrier(mesh.geom);
    responder.addVehicle(car.chassis, car.parameters(), {.linkedBodies = car.wheels});
  }
  Outcome outcome;
  const Eigen::Vector3d ahead = place * Eigen::Vector3d::UnitX();
  const double duration = way.off / way.speed + 0.3;
  for (double t = 0.0; t < duration; t += way.step) {
    ode.step(way.step, answered ? &responder : nullptr, [&] {
      if (answered) responder.step(way.step);
    });
    const Eigen::Vector3d velocity = car.velocity();
    outcome.back = std::max(outcome.back, -velocity.dot(ahead));
    outcome.up = std::max(outcome.up, velocity.z());
    dVector3 front;
    dBodyGetRelPointPos(car.chassis, Hinge2Car::front, 0.0, 0.0, front);
    outcome.past =
        std::max(outcome.past, front[0] * ahead.x() + front[1] * ahead.y() - profile.faceX);
  }
  return outcome;
}

TEST(Rebound, IsTheLawsWhateverStandsAtTheFoot) {
  std::mt19937 random(1989);
  const auto uniform = [&random](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  double worstOfJoints = 0.0;
  for (const WallProfile& profile : wallProfiles()) {
    double worst = 0.0;
    double joints = 0.0;
    double past = -1.0;
    double up = 0.0;
    for (int i = 0; i < 12; ++i) {
      const Coast way{.speed = uniform(5.0, 30.0),
                      // Before the kerb of a sidewalk, and not on it.
                      .off = uniform(0.6, 1.0) + (profile.groundZ > 0.0 ? 1.5 : 0.0),
                      .heading = uniform(-3.0, 3.0),
                      .step = i % 2 == 0 ? 0.005 : 0.0167,
                      .fineness = i % 3 == 0 ? 100.0 : 0.5};
      const Outcome outcome = coast(profile, way, true);
      EXPECT_LE(outcome.back, 0.3 * way.speed)
          << profile.name << ", " << way.speed << " m/s, off " << way.off << ", heading "
          << way.heading << ", step " << way.step;
      worst = std::max(worst, outcome.back / way.speed);
      up = std::max(up, outcome.up / way.speed);
      past = std::max(past, outcome.past);
      if (i < 4) joints = std::max(joints, coast(profile, way, false).back / way.speed);
    }
    worstOfJoints = std::max(worstOfJoints, joints);
    std::printf("[ figures  ] %-28s back %.2f v (joints %.2f), up %.2f v, past %.4f m\n",
                profile.name.c_str(), worst, joints, up, past);
  }
  // Contact joints, asked for no rebound at all.
  EXPECT_GE(worstOfJoints, 0.15);
}

}  // namespace
}  // namespace bumper::tests
