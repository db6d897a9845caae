// Two worlds on two threads, each with a responder of its own: the program of
// engine_adapter/docs/threads.md. Succeeds if both cars do what one does alone.

#include <bumper/engine_adapter/responder.h>
#include <bumper/engine_adapter/trimesh_lock.h>
#include <bumper/scenes/paper_scenes.h>
#include <ode/ode.h>

#include <cstdio>
#include <exception>
#include <future>
#include <mutex>

namespace {

void nearCallback(void* data, dGeomID a, dGeomID b) {
  const auto& responder = *static_cast<bumper::Responder*>(data);
  // These two take no lock, and may be called while it is held.
  if (responder.claims(a, b)) return;
  dContact contact{};
  int count = dCollide(a, b, 1, &contact.geom, sizeof(dContact));
  count = responder.keepUnclaimed(a, b, &contact, count);
  // Contact joints as ever; a car that flies has none.
}

// Where a car is after two seconds along the test rail.
double drive() {
  const dWorldID world = dWorldCreate();
  // All worlds share one queue of jobs, which is not thread safe: each gets one of its own.
  const dThreadingImplementationID jobs = dThreadingAllocateSelfThreadedImplementation();
  dWorldSetStepThreadingImplementation(world, dThreadingImplementationGetFunctions(jobs), jobs);
  const dSpaceID space = dHashSpaceCreate(nullptr);
  const dBodyID chassis = dBodyCreate(world);
  dMass mass;
  dMassSetBoxTotal(&mass, 1500, 4.6, 1.8, 0.7);
  dBodySetMass(chassis, &mass);
  dBodySetPosition(chassis, 0, 0, 0.55);
  dBodySetLinearVel(chassis, 26.8, 0, 0);
  dGeomSetBody(dCreateBox(space, 4.6, 1.8, 0.7), chassis);
  {
    bumper::Responder responder(world);
    responder.addBarrier(bumper::testRail(), {.space = space});
    responder.addVehicle(chassis, bumper::parametersFromGeoms(chassis, {}, 0.55));
    for (int i = 0; i < 400; ++i) {
      {
        const std::scoped_lock lock(bumper::trimeshLock());
        dSpaceCollide(space, &responder, nearCallback);
      }
      responder.step(0.005);  // takes the lock itself, when it asks for walls
      dWorldQuickStep(world, 0.005);
    }
  }
  const double left = dBodyGetPosition(chassis)[1];
  dSpaceDestroy(space);
  dWorldDestroy(world);
  dThreadingFreeImplementation(jobs);
  return left;
}

double driveOnAThread() {
  dAllocateODEDataForThread(static_cast<unsigned>(dAllocateMaskAll));
  const double left = drive();
  dCleanupODEAllDataForThread();
  return left;
}

int run() {
  const double alone = drive();
  std::future<double> first = std::async(std::launch::async, driveOnAThread);
  std::future<double> second = std::async(std::launch::async, driveOnAThread);
  const bool isSame = first.get() == alone && second.get() == alone;
  std::printf("%.3f m to the left, %s\n", alone, isSame ? "on each thread" : "but not on threads");
  return isSame && alone > 0.1 ? 0 : 1;
}

}  // namespace

int main() {
  dInitODE2(0);
  int status = 1;
  try {
    status = run();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
  }
  dCloseODE();
  return status;
}
