// A buggy in the manner of ODE's own demo: three wheels, the front one driven and steered, all
// geoms of the car in a space of their own that dCollide takes whole, steps of 50 ms. With BUMPER
// defined Bumper answers for the wall. Prints the state of all bodies after each step, to the last
// bit.
//   buggy DISTANCE-OF-THE-WALL STEPS

#include <ode/ode.h>

#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#ifdef BUMPER
#include <bumper/engine_adapter/responder.h>
static bumper::Responder* responder;
#endif

static const dReal length = 0.7, width = 0.5, height = 0.2, radius = 0.18, startHeight = 0.5;
static dWorldID world;
static dGeomID ground, ramp, wall;
static dJointGroupID contactJoints;

static void nearCallback(void*, dGeomID a, dGeomID b) {
  const bool isFixedA = a == ground || a == ramp || a == wall;
  const bool isFixedB = b == ground || b == ramp || b == wall;
  if (isFixedA == isFixedB) return;
#ifdef BUMPER
  if (responder->claims(a, b)) return;  // the whole pair is Bumper's
#endif
  dContact contacts[10];
  int count = dCollide(a, b, 10, &contacts[0].geom, sizeof(dContact));
#ifdef BUMPER
  count = responder->keepUnclaimed(a, b, contacts, count);  // the ground stays
#endif
  for (int i = 0; i < count; ++i) {
    contacts[i].surface.mode =
        dContactSlip1 | dContactSlip2 | dContactSoftERP | dContactSoftCFM | dContactApprox1;
    contacts[i].surface.mu = dInfinity;
    contacts[i].surface.slip1 = 0.1;
    contacts[i].surface.slip2 = 0.1;
    contacts[i].surface.soft_erp = 0.5;
    contacts[i].surface.soft_cfm = 0.3;
    const dJointID joint = dJointCreateContact(world, contactJoints, &contacts[i]);
    dJointAttach(joint, dGeomGetBody(contacts[i].geom.g1), dGeomGetBody(contacts[i].geom.g2));
  }
}

int main(int, char** argv) {
  dInitODE2(0);
  world = dWorldCreate();
  dWorldSetGravity(world, 0, 0, -0.5);
  const dSpaceID space = dHashSpaceCreate(nullptr);
  contactJoints = dJointGroupCreate(0);
  ground = dCreatePlane(space, 0, 0, 1, 0);
  ramp = dCreateBox(space, 2, 1.5, 1);
  dMatrix3 rotation;
  dRFromAxisAndAngle(rotation, 0, 1, 0, -0.15);
  dGeomSetPosition(ramp, 2, 0, -0.34);
  dGeomSetRotation(ramp, rotation);
  wall = dCreateBox(space, 1, 20, 2);
  dGeomSetPosition(wall, std::atof(argv[1]) + 0.5, 0, 1);

  dMass mass;
  const dBodyID chassis = dBodyCreate(world);
  dBodySetPosition(chassis, 0, 0, startHeight);
  dMassSetBox(&mass, 1, length, width, height);
  dMassAdjust(&mass, 1);
  dBodySetMass(chassis, &mass);
  const dSpaceID carSpace = dSimpleSpaceCreate(space);
  dSpaceSetCleanup(carSpace, 0);
  dGeomSetBody(dCreateBox(carSpace, length, width, height), chassis);

  dBodyID wheels[3];
  dJointID axles[3];
  for (int i = 0; i < 3; ++i) {
    const dReal x = i == 0 ? 0.5 * length : -0.5 * length;
    const dReal y = i == 0 ? 0 : (i == 1 ? 0.5 : -0.5) * width;
    wheels[i] = dBodyCreate(world);
    dQuaternion turned;
    dQFromAxisAndAngle(turned, 1, 0, 0, M_PI * 0.5);
    dBodySetQuaternion(wheels[i], turned);
    dBodySetPosition(wheels[i], x, y, startHeight - 0.5 * height);
    dMassSetSphere(&mass, 1, radius);
    dMassAdjust(&mass, 0.2);
    dBodySetMass(wheels[i], &mass);
    dGeomSetBody(dCreateSphere(carSpace, radius), wheels[i]);
    axles[i] = dJointCreateHinge2(world, nullptr);
    dJointAttach(axles[i], chassis, wheels[i]);
    const dReal* at = dBodyGetPosition(wheels[i]);
    dJointSetHinge2Anchor(axles[i], at[0], at[1], at[2]);
    const dVector3 up{0, 0, 1}, across{0, 1, 0};
    dJointSetHinge2Axes(axles[i], up, across);
    dJointSetHinge2Param(axles[i], dParamSuspensionERP, 0.4);
    dJointSetHinge2Param(axles[i], dParamSuspensionCFM, 0.8);
    if (i > 0) {
      dJointSetHinge2Param(axles[i], dParamLoStop, 0);
      dJointSetHinge2Param(axles[i], dParamHiStop, 0);
    }
  }
#ifdef BUMPER
  bumper::Responder impacts(world);  // borrows the world
  responder = &impacts;
  impacts.addBarrier(wall);  // or a track's mesh, road and walls in one
  impacts.addVehicle(chassis, bumper::parametersFromGeoms(chassis, wheels, 0.24),
                     {.linkedBodies = wheels});
#endif

  for (int step = 0; step < std::atoi(argv[2]); ++step) {
    dJointSetHinge2Param(axles[0], dParamVel2, -3);
    dJointSetHinge2Param(axles[0], dParamFMax2, 0.1);
    dReal turn = 0.05 - dJointGetHinge2Angle1(axles[0]);
    turn = 10 * (turn > 0.1 ? 0.1 : turn < -0.1 ? -0.1 : turn);
    dJointSetHinge2Param(axles[0], dParamVel, turn);
    dJointSetHinge2Param(axles[0], dParamFMax, 0.2);
    dJointSetHinge2Param(axles[0], dParamLoStop, -0.75);
    dJointSetHinge2Param(axles[0], dParamHiStop, 0.75);
    dJointSetHinge2Param(axles[0], dParamFudgeFactor, 0.1);
    dSpaceCollide(space, nullptr, nearCallback);
#ifdef BUMPER
    impacts.step(0.05);  // returns events: what was hit, where, how hard
#endif
    dWorldQuickStep(world, 0.05);
    dJointGroupEmpty(contactJoints);
    for (const dBodyID body : {chassis, wheels[0], wheels[1], wheels[2]}) {
      const dReal* at = dBodyGetPosition(body);
      const dReal* turned = dBodyGetQuaternion(body);
      const dReal* moves = dBodyGetLinearVel(body);
      const dReal* spins = dBodyGetAngularVel(body);
      std::printf("%.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g\n",
                  at[0], at[1], at[2], turned[0], turned[1], turned[2], turned[3], moves[0],
                  moves[1], moves[2], spins[0], spins[1], spins[2]);
    }
  }
}
