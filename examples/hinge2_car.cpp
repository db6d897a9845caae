// A car on hinge2 wheels, as ODE games build one, with Bumper for its walls and a recording of the
// run: the program of engine_adapter/docs/embedding.md.

#include <bumper/engine_adapter/responder.h>
#include <bumper/render/recording_writer.h>
#include <bumper/scenes/paper_scenes.h>
#include <ode/ode.h>

#include <array>
#include <cstdio>
#include <exception>

namespace {

constexpr double step = 0.005;  // s
constexpr double speed = 26.8;  // m/s
constexpr double wheelRadius = 0.32;

// What a game has anyway: a world, a space for its geoms, a group for its contact joints.
struct Game {
  dWorldID world = dWorldCreate();
  dSpaceID space = dHashSpaceCreate(nullptr);
  dJointGroupID contacts = dJointGroupCreate(0);
  dBodyID chassis = nullptr;
  std::array<dBodyID, 4> wheels{};  // front left, front right, rear left, rear right
  bumper::Responder* responder = nullptr;
};

// A chassis of 1420 kg and four wheels of 20 kg on hinge2 joints; it rolls along x.
void addCar(Game& game) {
  dMass mass;
  game.chassis = dBodyCreate(game.world);
  dMassSetBoxTotal(&mass, 1420, 4.2, 1.8, 0.6);
  dBodySetMass(game.chassis, &mass);
  dBodySetPosition(game.chassis, 0, 0, 0.62);
  dBodySetLinearVel(game.chassis, speed, 0, 0);
  dGeomSetBody(dCreateBox(game.space, 4.2, 1.8, 0.6), game.chassis);

  dMassSetSphereTotal(&mass, 20, wheelRadius);
  for (std::size_t i = 0; i < game.wheels.size(); ++i) {
    const double x = i < 2 ? 1.3 : -1.3;
    const double y = i % 2 == 0 ? 0.58 : -0.58;
    const dBodyID wheel = game.wheels.at(i) = dBodyCreate(game.world);
    dBodySetMass(wheel, &mass);
    dBodySetPosition(wheel, x, y, wheelRadius);
    dBodySetLinearVel(wheel, speed, 0, 0);
    dBodySetAngularVel(wheel, 0, speed / wheelRadius, 0);
    dBodySetFiniteRotationMode(wheel, 1);
    dGeomSetBody(dCreateSphere(game.space, wheelRadius), wheel);

    const dJointID axle = dJointCreateHinge2(game.world, nullptr);
    const dVector3 up{0, 0, 1};
    const dVector3 across{0, 1, 0};
    dJointAttach(axle, game.chassis, wheel);
    dJointSetHinge2Anchor(axle, x, y, wheelRadius);
    dJointSetHinge2Axes(axle, up, across);
    dJointSetHinge2Param(axle, dParamLoStop, 0);
    dJointSetHinge2Param(axle, dParamHiStop, 0);
    dJointSetHinge2Param(axle, dParamSuspensionERP, 0.4);
    dJointSetHinge2Param(axle, dParamSuspensionCFM, 1e-5);
  }
}

void nearCallback(void* data, dGeomID a, dGeomID b) {
  const Game& game = *static_cast<Game*>(data);
  const dBodyID bodyA = dGeomGetBody(a);
  const dBodyID bodyB = dGeomGetBody(b);
  if (bodyA != nullptr && bodyB != nullptr &&
      dAreConnectedExcluding(bodyA, bodyB, dJointTypeContact) != 0) {
    return;  // chassis and wheel
  }
  if (game.responder->claims(a, b)) return;  // the whole pair is Bumper's
  std::array<dContact, 16> contacts{};
  int count = dCollide(a, b, contacts.size(), &contacts.front().geom, sizeof(dContact));
  count = game.responder->keepUnclaimed(a, b, contacts.data(), count);  // the ground stays
  for (int i = 0; i < count; ++i) {
    dContact& contact = contacts.at(static_cast<std::size_t>(i));
    contact.surface.mode = dContactApprox1;
    contact.surface.mu = 0.8;
    dJointAttach(dJointCreateContact(game.world, game.contacts, &contact), bodyA, bodyB);
  }
}

void run(Game& game, const char* file) {
  dWorldSetGravity(game.world, 0, 0, -9.81);
  dCreatePlane(game.space, 0, 0, 1, 0);  // the ground
  addCar(game);

  // After what it refers to, so that it is gone before.
  bumper::Responder responder(game.world);
  game.responder = &responder;

  // The walls, as a geom of their own. What the game has as a geom is added as that, and may hold
  // the road, too: responder.addBarrier(trackGeom).
  const bumper::Scene scene = bumper::testRail();
  responder.addBarrier(scene, {.space = game.space});

  // Mass and yaw inertia are read off the bodies, the outline off their geoms.
  const double massCentreHeight = (1420 * 0.62 + 4 * 20 * wheelRadius) / 1500;
  const bumper::VehicleParameters parameters =
      bumper::parametersFromGeoms(game.chassis, game.wheels, massCentreHeight);
  const bumper::VehicleId car =
      responder.addVehicle(game.chassis, parameters, {.name = "car", .linkedBodies = game.wheels});
  for (const std::string& warning : responder.warnings()) std::printf("%s\n", warning.c_str());

  bumper::RunDescription description{.scene = bumper::referenceTo(scene)};
  description.scene.builtIn = "test_rail";  // for bumper-replay; of a mesh file: `file`
  bumper::RecordingWriter recording(file, description);
  const std::size_t recorded = recording.addVehicle("car", parameters);

  while (responder.time() < 4) {
    recording.addPose(recorded,
                      {responder.time(), responder.position(car), responder.orientation(car),
                       responder.velocity(car), responder.yawRate(car)});
    dSpaceCollide(game.space, &game, nearCallback);
    // Your own forces belong here, before step().
    for (const bumper::ImpactEvent& event : responder.step(step)) {
      if (event.phase != bumper::EventPhase::impact) continue;  // a lasting contact
      recording.addImpact(event);
      std::printf("%.3f s: %.1f m/s at the contact, %.0f N s\n", event.time, event.approachSpeed,
                  event.impulseNormal);
    }
    dWorldQuickStep(game.world, step);  // the same step
    dJointGroupEmpty(game.contacts);
  }
  recording.close();
}

}  // namespace

int main(int argc, char** argv) {
  int status = 0;
  dInitODE2(0);
  {
    Game game;
    try {
      run(game, argc > 1 ? argv[1] : "hinge2_car.jsonl");
    } catch (const std::exception& error) {  // set-up calls and the recording throw, step() not
      std::fprintf(stderr, "%s\n", error.what());
      status = 1;
    }
    dJointGroupDestroy(game.contacts);
    dSpaceDestroy(game.space);
    dWorldDestroy(game.world);
  }
  dCloseODE();
  return status;
}
