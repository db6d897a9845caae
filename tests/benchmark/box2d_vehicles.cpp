#include <box2d/box2d.h>

#include "vehicle_peers.h"

namespace bumper::benchmark {

namespace {

b2Vec2 toBox2d(const Vector2& v) { return {static_cast<float>(v.x()), static_cast<float>(v.y())}; }

b2Body* addVehicle(b2World& world, const PairState& state, float restitution, float friction) {
  const auto& [vehicle, motion] = state;
  b2BodyDef definition;
  definition.type = b2_dynamicBody;
  definition.position = toBox2d(motion.position);
  definition.angle = static_cast<float>(motion.yaw);
  definition.linearVelocity = toBox2d(motion.velocity);
  definition.angularVelocity = static_cast<float>(motion.yawRate);
  definition.bullet = true;
  definition.allowSleep = false;
  b2Body* body = world.CreateBody(&definition);
  b2PolygonShape box;
  const Vector2 half(0.5 * (vehicle.massCentreToFront + vehicle.massCentreToRear),
                     0.5 * vehicle.width);
  const Vector2 middle(0.5 * (vehicle.massCentreToFront - vehicle.massCentreToRear), 0.0);
  box.SetAsBox(toBox2d(half).x, toBox2d(half).y, toBox2d(middle), 0.0F);
  b2FixtureDef fixture;
  fixture.shape = &box;
  fixture.density = 1.0F;
  fixture.restitution = restitution;
  fixture.friction = friction;
  fixture.restitutionThreshold = 0.1F;
  body->CreateFixture(&fixture);
  b2MassData mass;
  mass.mass = static_cast<float>(vehicle.mass);
  mass.center.SetZero();
  mass.I = static_cast<float>(vehicle.yawInertia);
  body->SetMassData(&mass);
  return body;
}

}  // namespace

VehicleRun runBox2d(const VehicleTask& task) {
  const VehicleCase& one = *task.vehicleCase;
  b2World world({0.0F, 0.0F});
  std::vector<b2Body*> bodies;
  for (const PairState& state : one.vehicles) {
    bodies.push_back(addVehicle(world, state, static_cast<float>(one.settings.restitution(0.0)),
                                static_cast<float>(one.settings.friction(0.0))));
  }
  constexpr int velocityIterations = 8;
  constexpr int positionIterations = 3;
  return runSteps(
      task,
      [&] { world.Step(static_cast<float>(task.step), velocityIterations, positionIterations); },
      [&] {
        std::vector<PlanarMotion> motions;
        for (const b2Body* body : bodies) {
          const b2Vec2 place = body->GetWorldCenter();
          const b2Vec2 velocity = body->GetLinearVelocity();
          motions.push_back({.position = {place.x, place.y},
                             .yaw = body->GetAngle(),
                             .velocity = {velocity.x, velocity.y},
                             .yawRate = body->GetAngularVelocity()});
        }
        return motions;
      });
}

}  // namespace bumper::benchmark
