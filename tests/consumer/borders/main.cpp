// One of each kind of thing that the shared libraries of Bumper export, used from outside.

#include <bumper/engine_adapter/responder.h>
#include <bumper/engine_adapter/trimesh_lock.h>
#include <bumper/response/angle_curve.h>
#include <bumper/response/collision_step.h>
#include <bumper/response/error.h>
#include <bumper/response/presets.h>
#include <bumper/scenes/paper_scenes.h>
#include <bumper/scenes/wall_plan.h>
#include <bumper/scenes/walls.h>

#include <cstdio>
#include <exception>
#include <string_view>
#include <utility>

namespace {

int failures = 0;

void expect(bool isSo, const char* what) {
  if (isSo) return;
  ++failures;
  std::printf("not so: %s\n", what);
}

/// An error of a library's is caught as what it is, and not as something that looks like it.
template <typename Call>
void expectError(const Call& call, std::string_view word, const char* what) {
  try {
    call();
    expect(false, what);
  } catch (const bumper::Error& error) {
    expect(std::string_view(error.what()).find(word) != std::string_view::npos, error.what());
  } catch (const std::exception&) {
    expect(false, "an error of Bumper's is caught as bumper::Error");
  }
}

}  // namespace

int main() {
  // Free functions: of one component, of another with the same name, inline ones, and a span.
  bumper::ResponseSettings settings = bumper::modernCarSettings();
  bumper::validate(settings);
  expect(bumper::findPreset(bumper::presetNames().front()).has_value(), "presets have names");
  expect(bumper::toString(bumper::Regime::sliding) == "sliding", "enumerators have names");
  expect(bumper::cross({1.0, 0.0}, {0.0, 1.0}) == 1.0, "inline functions");
  settings.restSpeed = -1.0;
  expectError([&] { bumper::validate(settings); }, "rest", "response throws");
  bumper::Scene broken = bumper::straightWall({-50.0, 0.0}, {50.0, 0.0}, 1.0);
  bumper::validate(broken);
  broken.triangles.front().corners[0] = 1000000;
  expectError([&] { bumper::validate(broken); }, "1000000", "scenes throws");

  // Classes: constructors, static and const members, operators, moves, members behind a pointer.
  const bumper::AngleCurve curve = bumper::AngleCurve::constant(0.25);
  expect(curve(0.5) == 0.25, "call operators");
  bumper::CollisionStep step;
  bumper::CollisionStep moved = std::move(step);
  const bumper::VehicleParameters car{.mass = 1500.0,
                                      .yawInertia = 2500.0,
                                      .massCentreToFront = 2.2,
                                      .massCentreToRear = 2.2,
                                      .width = 1.8,
                                      .massCentreHeight = 0.5};
  bumper::validate(car);
  expect(moved.resolve(car, {}, bumper::CollisionStep::Walls{}, 0.005).impacts.empty(),
         "no impact without a wall");
  const bumper::Scene wall = bumper::straightWall({-50.0, 0.0}, {50.0, 0.0}, 1.0);
  const bumper::WallPlan plan(bumper::selectWalls(wall).walls);
  expect(plan.memory() > 0, "scenes give walls");

  // The adapter, whose errors pass two borders.
  dInitODE2(0);
  const dWorldID world = dWorldCreate();
  {
    bumper::Responder first(world);
    bumper::Responder responder = std::move(first);
    expectError([&] { responder.addBarrier(broken); }, "1000000", "the adapter throws");
    expectError([&] { bumper::Responder nowhere(nullptr); }, "world", "constructors throw");
    expect(responder.step(0.005).empty(), "no event without a vehicle");
  }
  dWorldDestroy(world);
  dCloseODE();
  expect(bumper::trimeshLock().try_lock(), "one lock for all");
  bumper::trimeshLock().unlock();

  return failures;
}
