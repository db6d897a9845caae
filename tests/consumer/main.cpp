// A minimal application on the installed package: one car, one wall, the loop of the README.

#include <bumper/engine_adapter/responder.h>
#include <bumper/scenes/paper_scenes.h>

#include <cstdio>

int main() {
  dInitODE2(0);
  const dWorldID world = dWorldCreate();
  const dSpaceID space = dSimpleSpaceCreate(nullptr);
  std::size_t impacts = 0;
  {
    const dBodyID chassis = dBodyCreate(world);
    dMass mass;
    dMassSetBoxTotal(&mass, 1500.0, 4.4, 1.8, 0.7);
    dBodySetMass(chassis, &mass);
    dBodySetPosition(chassis, 0.0, 3.0, 0.55);
    dBodySetLinearVel(chassis, 20.0, -5.0, 0.0);

    bumper::Responder responder(world);
    responder.addBarrier(bumper::straightWall({-50.0, 0.0}, {50.0, 0.0}, 1.0), {.space = space});
    responder.addVehicle(chassis, bumper::parametersFromBodies(chassis, {}, 2.2, 2.2, 1.8, 0.55),
                         {.name = "car"});
    constexpr double h = 0.005;
    for (int i = 0; i < 200; ++i) {
      for (const bumper::ImpactEvent& event : responder.step(h)) {
        if (event.impulseNormal > 0.0) ++impacts;
      }
      dWorldQuickStep(world, h);
    }
    if (dBodyGetLinearVel(chassis)[1] < 0.0) impacts = 0;
  }
  dSpaceDestroy(space);
  dWorldDestroy(world);
  dCloseODE();
  std::printf("%zu impacts\n", impacts);
  return impacts > 0 ? 0 : 1;
}
