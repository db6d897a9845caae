/* The same as cmake/game.cpp in C99, by pkg-config. */
#include <bumper/engine_adapter/c_api.h>
#include <stdio.h>
#include <stdlib.h>

static dWorldID world;
static dJointGroupID joints;
static bumper_responder responder;

static int checked(int answer) {
  if (answer < 0) exit(fprintf(stderr, "%s\n", bumper_last_error()));
  return answer;
}

static void near_callback(void* data, dGeomID a, dGeomID b) {
  if (data != NULL || checked(bumper_claims(responder, a, b))) return;
  dContact contacts[8];
  int count = dCollide(a, b, 8, &contacts[0].geom, sizeof(dContact));
  count = checked(bumper_keep_unclaimed(responder, a, b, contacts, count));
  for (int i = 0; i < count; ++i) {
    contacts[i].surface.mode = 0;
    contacts[i].surface.mu = 0.1;
    dJointID joint = dJointCreateContact(world, joints, &contacts[i]);
    dJointAttach(joint, dGeomGetBody(a), dGeomGetBody(b));
  }
}

int main(void) {
  dInitODE2(0);
  world = dWorldCreate();
  dWorldSetGravity(world, 0, 0, -9.81);
  dSpaceID space = dHashSpaceCreate(NULL);
  joints = dJointGroupCreate(0);
  dCreatePlane(space, 0, 0, 1, 0);
  dGeomID wall = dCreateBox(space, 1, 20, 2);
  dGeomSetPosition(wall, 30.5, 0, 1);
  dBodyID chassis = dBodyCreate(world);
  dMass mass;
  dMassSetBoxTotal(&mass, 1500, 4, 1.8, 1.2);
  dBodySetMass(chassis, &mass);
  dBodySetPosition(chassis, 0, 0, 0.6);
  dBodySetLinearVel(chassis, 20, 0, 0);
  dGeomSetBody(dCreateBox(space, 4, 1.8, 1.2), chassis);
  checked(bumper_create_responder(world, NULL, &responder));
  checked(bumper_add_geom(responder, wall, NULL, &(bumper_barrier){0}));
  bumper_vehicle_parameters parameters;
  checked(bumper_init_vehicle_parameters(&parameters, sizeof parameters));
  checked(bumper_parameters_from_geoms(chassis, NULL, 0.6, &parameters));
  checked(bumper_add_vehicle(responder, chassis, &parameters, NULL, &(bumper_vehicle){0}));
  int events = 0;
  for (int i = 0; i < 600; ++i) {
    dSpaceCollide(space, NULL, near_callback);
    events += checked(bumper_step(responder, 0.005));
    dWorldQuickStep(world, 0.005);
    dJointGroupEmpty(joints);
  }
  dReal front = dBodyGetPosition(chassis)[0] + 2;
  printf("%d events, the front at %.2f m\n", events, front);
  return !(events > 0 && front > 25 && front < 30.01);
}
