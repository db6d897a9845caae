// A box slides over a plane into a wall, which is a box of the application's. Succeeds if Bumper
// told of one impact and the box stays before the wall.

#include <bumper/engine_adapter/responder.h>

#include <cstdio>

struct Game {
  dWorldID world;
  dJointGroupID joints;
  bumper::Responder* responder;
};

static void nearCallback(void* data, dGeomID a, dGeomID b) {
  const Game& game = *static_cast<Game*>(data);
  if (game.responder->claims(a, b)) return;
  dContact contacts[8] = {};
  int count = dCollide(a, b, 8, &contacts[0].geom, sizeof(dContact));
  count = game.responder->keepUnclaimed(a, b, contacts, count);
  for (int i = 0; i < count; ++i) {
    contacts[i].surface.mu = 0.1;
    const dJointID joint = dJointCreateContact(game.world, game.joints, &contacts[i]);
    dJointAttach(joint, dGeomGetBody(a), dGeomGetBody(b));
  }
}

int main() {
  dInitODE2(0);
  const dWorldID world = dWorldCreate();
  dWorldSetGravity(world, 0, 0, -9.81);
  const dSpaceID space = dHashSpaceCreate(nullptr);
  const dJointGroupID joints = dJointGroupCreate(0);
  dCreatePlane(space, 0, 0, 1, 0);
  const dGeomID wall = dCreateBox(space, 1, 20, 2);
  dGeomSetPosition(wall, 30.5, 0, 1);
  const dBodyID chassis = dBodyCreate(world);
  dMass mass;
  dMassSetBoxTotal(&mass, 1500, 4, 1.8, 1.2);
  dBodySetMass(chassis, &mass);
  dBodySetPosition(chassis, 0, 0, 0.6);
  dBodySetLinearVel(chassis, 20, 0, 0);
  dGeomSetBody(dCreateBox(space, 4, 1.8, 1.2), chassis);
  bumper::Responder responder(world);
  responder.addBarrier(wall);
  responder.addVehicle(chassis, bumper::parametersFromGeoms(chassis, {}, 0.6));
  Game game{world, joints, &responder};
  int impacts = 0;
  for (int i = 0; i < 600; ++i) {
    dSpaceCollide(space, &game, nearCallback);
    for (const bumper::ImpactEvent& event : responder.step(0.005)) {
      if (event.phase == bumper::EventPhase::impact) ++impacts;
    }
    dWorldQuickStep(world, 0.005);
    dJointGroupEmpty(joints);
  }
  const dReal front = dBodyGetPosition(chassis)[0] + 2;
  std::printf("%d impacts, the front at %.2f m\n", impacts, front);
  return impacts > 0 && front > 25 && front < 30.01 ? 0 : 1;
}
