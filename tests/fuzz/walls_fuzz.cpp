// A scene of any bytes becomes walls, a plan and a barrier, and a car drives there: set-up calls
// throw Error or nothing, and what was finite stays so.

#include <ode/ode.h>

#include <cstdlib>

#include "bumper/engine_adapter/responder.h"
#include "bumper/response/error.h"
#include "bumper/scenes/scene_budget.h"
#include "input.h"

namespace {

bool isFinite(const dReal* values) {
  return std::isfinite(values[0]) && std::isfinite(values[1]) && std::isfinite(values[2]);
}

void drive(bumper::fuzz::Input& input, dWorldID world) {
  bumper::Responder responder(world);
  const std::uint8_t kind = input.byte();
  const bumper::Scene scene = bumper::fuzz::sceneFrom(input);
  bumper::validate(scene, bumper::SceneBudget{});
  bumper::BarrierOptions options;
  options.walls.maxNormalUp = (kind & 15U) / 15.0;
  if ((kind & 16U) != 0) options.walls.groundReach.reset();
  responder.addBarrier(scene, options);

  const dBodyID body = dBodyCreate(world);
  dMass mass;
  dMassSetBoxTotal(&mass, 1200.0, 4.0, 1.8, 1.2);
  dBodySetMass(body, &mass);
  dBodySetPosition(body, input.number(), input.number(), input.number() / 64.0 + 0.5);
  dBodySetLinearVel(body, input.number(), input.number(), 0.0);
  dBodySetAngularVel(body, 0.0, 0.0, input.number() / 16.0);
  dMatrix3 rotation;
  dRFromAxisAndAngle(rotation, 0.0, 0.0, 1.0, input.number());
  dBodySetRotation(body, rotation);
  responder.addVehicle(body, bumper::parametersFromBodies(body, {}, 2.0, 2.0, 1.8, 0.55));
  const double speed = Eigen::Map<const Eigen::Vector3d>(dBodyGetLinearVel(body)).norm();
  for (int i = 0; i < 8; ++i) {
    const double h = 0.002 * (1 + input.byte() % 8);
    for (const bumper::ImpactEvent& event : responder.step(h)) {
      if (!event.normal.allFinite() || !std::isfinite(event.impulseNormal)) std::abort();
    }
    dWorldQuickStep(world, h);
    if (!isFinite(dBodyGetPosition(body)) || !isFinite(dBodyGetLinearVel(body))) std::abort();
    // An impact turns what rotates into motion: a car of that size turns at 10 rad/s at most here.
    const double now = Eigen::Map<const Eigen::Vector3d>(dBodyGetLinearVel(body)).norm();
    if (now > 2.0 * speed + 40.0) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const int ready = dInitODE2(0);
  if (ready == 0) std::abort();
  bumper::fuzz::Input input(data, size);
  const dWorldID world = dWorldCreate();
  try {
    drive(input, world);
  } catch (const bumper::Error&) {  // said so
  }
  dWorldDestroy(world);
  return 0;
}
