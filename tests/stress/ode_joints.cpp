#include "ode_joints.h"

#include <algorithm>
#include <cmath>

#include "ode_world.h"

namespace bumper::tests {

JointRun runWithJoints(std::span<const Line> plan, const PlanarMotion& start,
                       const JointSetting& setting, const std::function<void(BoxCar&)>& forces) {
  OdeWorld ode;
  ode.friction = setting.friction;
  ode.bounce = setting.bounce;
  const OdeMesh walls(ode.space, standing(plan, setting.wallHeight, setting.panels, setting.rows));
  BoxCar car(ode.world, ode.space);
  place(car, start);
  const double energyAtStart = energyOf(car.body);
  JointRun run;
  PlanarMotion before = start;
  const int steps = static_cast<int>(std::lround(setting.duration / setting.step));
  for (int i = 0; i < steps; ++i) {
    ode.step(setting.step, nullptr, [&] {
      if (forces) forces(car);
    });
    const PlanarMotion now = motionOf(car.body);
    run.mostEnergy = std::max(run.mostEnergy, energyOf(car.body) / energyAtStart);
    run.topSpeed = std::max(run.topSpeed, now.velocity.norm());
    run.topRise = std::max(run.topRise, std::abs(car.velocity().z()));
    run.largestLoss = std::max(run.largestLoss, before.velocity.norm() - now.velocity.norm());
    run.deepest = std::max(run.deepest, deepestIntrusion(car.parameters, now, plan));
    run.ledThrough = run.ledThrough || leadsThrough(before.position, now.position, plan);
    before = now;
  }
  run.end = before;
  return run;
}

}  // namespace bumper::tests
