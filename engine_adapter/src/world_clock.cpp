#include "world_clock.h"

namespace bumper {

WorldClock::WorldClock(dWorldID world)
    : body_(dBodyCreate(world)), marker_(dCreateSphere(nullptr, 1.0)) {
  dMass mass;
  dMassSetSphereTotal(&mass, 1.0, 1.0);
  dBodySetMass(body_, &mass);
  dBodySetGravityMode(body_, 0);
  dBodySetAutoDisableFlag(body_, 0);
  dBodySetLinearDamping(body_, 0.0);
  dBodySetAngularDamping(body_, 0.0);
  dGeomSetBody(marker_, body_);
  stop();
}

WorldClock::~WorldClock() {
  if (dGeomGetBody(marker_) != nullptr) dBodyDestroy(body_);
  dGeomDestroy(marker_);
}

void WorldClock::start() {
  dBodySetPosition(body_, 0.0, 0.0, 0.0);
  dBodySetLinearVel(body_, 1.0, 0.0, 0.0);
  dBodySetForce(body_, 0.0, 1.0, 0.0);
  dBodyEnable(body_);
  running_ = true;
}

void WorldClock::stop() {
  dBodyDisable(body_);
  running_ = false;
}

WorldSteps WorldClock::read() const {
  return {.total = dBodyGetPosition(body_)[0], .first = dBodyGetLinearVel(body_)[1]};
}

}  // namespace bumper
