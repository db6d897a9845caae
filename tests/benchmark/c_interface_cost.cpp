// What a step costs through the C interface and through the C++ one, measured in turns:
//
//   c_interface_cost                   times, ns
//   c_interface_cost far|along         2,000 steps by both ways, of which valgrind counts one's:
//
//   valgrind --tool=callgrind --toggle-collect='stepsInC(*' c_interface_cost far
//   valgrind --tool=callgrind --toggle-collect='stepsInCpp(*' c_interface_cost far

#include <ode/ode.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include "bumper/engine_adapter/c_api.h"
#include "bumper/engine_adapter/responder.h"
#include "bumper/scenes/paper_scenes.h"
#include "performance/clock.h"

namespace {

using bumper::ImpactEvent;
using bumper::benchmark::Timer;

constexpr double h = 0.005;

double seen = 0.0;  // so that no event is read in vain

}  // namespace

// With names that callgrind can be told.
[[gnu::noinline]] void stepsInC(bumper_responder responder, int count) {
  for (int i = 0; i < count; ++i) {
    const int events = bumper_step(responder, h);
    for (int k = 0; k < events; ++k) {
      bumper_event event;
      bumper_init_event(&event, sizeof event);
      bumper_get_event(responder, static_cast<std::size_t>(k), &event);
      seen += event.impulse_normal;
    }
  }
}

[[gnu::noinline]] void stepsInCpp(bumper::Responder& responder, int count) {
  for (int i = 0; i < count; ++i) {
    for (const ImpactEvent& event : responder.step(h)) seen += event.impulseNormal;
  }
}

namespace {

// A car of one body, in a world of its own, that slides away from a wall or is pressed along it.
class Car {
 public:
  Car(bool touches, bool inC) : touches_(touches), world_(dWorldCreate()) {
    dMass mass;
    dMassSetBoxTotal(&mass, 1500.0, 4.4, 1.8, 1.1);
    body_ = dBodyCreate(world_);
    dBodySetMass(body_, &mass);
    dBodySetMaxAngularSpeed(body_, dInfinity);
    const bumper::VehicleParameters parameters =
        bumper::parametersFromBodies(body_, {}, 2.2, 2.2, 1.8, 0.55);
    const bumper::Scene wall = bumper::straightWall({1e4, 0.0}, {-1e4, 0.0}, 1.0);
    if (inC) {
      makeInC(wall, parameters);
    } else {
      responder_.emplace(world_);
      responder_->addBarrier(wall);
      responder_->addVehicle(body_, parameters);
    }
    place();
  }
  ~Car() {
    responder_.reset();
    if (inC_.value != 0) bumper_destroy_responder(inC_);
    dWorldDestroy(world_);
  }
  Car(const Car&) = delete;
  Car& operator=(const Car&) = delete;
  Car(Car&&) = delete;
  Car& operator=(Car&&) = delete;

  // One step, with what an application does besides.
  double timedStep() {
    if (touches_) dBodyAddForce(body_, 0.0, 3000.0, 0.0);
    const Timer timer;
    steps(1);
    const double time = timer.elapsed();
    dWorldQuickStep(world_, h);
    return time;
  }
  // Steps without a world step between them would be repeated ones.
  void steps(int count) {
    if (responder_) {
      stepsInCpp(*responder_, count);
    } else {
      stepsInC(inC_, count);
    }
  }
  // Only far away, where a step that is repeated is as any other.
  double timeOfManySteps() {
    constexpr int count = 1000;
    const Timer timer;
    steps(count);
    return timer.elapsed() / count;
  }

 private:
  void place() {
    dBodySetPosition(body_, 0.0, touches_ ? -0.9 : -500.0, 0.55);
    dBodySetLinearVel(body_, 20.0, 0.0, 0.0);
  }
  void makeInC(const bumper::Scene& wall, const bumper::VehicleParameters& parameters) {
    std::vector<std::uint32_t> triangles;
    for (const bumper::Scene::Triangle& each : wall.triangles) {
      triangles.insert(triangles.end(), each.corners.begin(), each.corners.end());
    }
    bumper_scene scene;
    bumper_init_scene(&scene, sizeof scene);
    scene.vertices = wall.vertices.front().data();
    scene.vertex_count = wall.vertices.size();
    scene.triangles = triangles.data();
    scene.triangle_count = wall.triangles.size();
    bumper_vehicle_parameters known;
    bumper_init_vehicle_parameters(&known, sizeof known);
    known.mass = parameters.mass;
    known.yaw_inertia = parameters.yawInertia;
    known.mass_centre_to_front = parameters.massCentreToFront;
    known.mass_centre_to_rear = parameters.massCentreToRear;
    known.width = parameters.width;
    known.mass_centre_height = parameters.massCentreHeight;
    bumper_barrier barrier;
    bumper_vehicle vehicle;
    if (bumper_create_responder(world_, nullptr, &inC_) < 0 ||
        bumper_add_scene(inC_, &scene, nullptr, &barrier) < 0 ||
        bumper_add_vehicle(inC_, body_, &known, nullptr, &vehicle) < 0) {
      std::puts(bumper_last_error());
    }
  }

  bool touches_;
  dWorldID world_;
  dBodyID body_ = nullptr;
  std::optional<bumper::Responder> responder_;
  bumper_responder inC_{};
};

struct Times {
  double c = std::numeric_limits<double>::infinity();
  double cpp = std::numeric_limits<double>::infinity();
};

void print(const char* situation, const Times& times) {
  std::printf("%-28s C %7.2f ns   C++ %7.2f ns   ratio %.3f\n", situation, times.c, times.cpp,
              times.c / times.cpp);
}

void measure() {
  Times far;
  {
    Car c(false, true);
    Car cpp(false, false);
    c.timedStep();
    cpp.timedStep();
    for (int round = 0; round < 3000; ++round) {
      far.c = std::min(far.c, c.timeOfManySteps());
      far.cpp = std::min(far.cpp, cpp.timeOfManySteps());
    }
  }
  print("far from walls", far);

  // The least time of each step of the same slide along the wall, and their mean.
  constexpr int steps = 400;
  constexpr int rounds = 60;
  std::vector<Times> slide(steps);
  for (int round = 0; round < rounds; ++round) {
    Car c(true, true);
    Car cpp(true, false);
    for (Times& each : slide) {
      // Whoever comes second finds the caches warm.
      if (round % 2 == 0) each.c = std::min(each.c, c.timedStep());
      each.cpp = std::min(each.cpp, cpp.timedStep());
      if (round % 2 == 1) each.c = std::min(each.c, c.timedStep());
    }
  }
  Times mean{.c = 0.0, .cpp = 0.0};
  for (const Times& each : slide) {
    mean.c += each.c / steps;
    mean.cpp += each.cpp / steps;
  }
  print("along a wall", mean);
}

void makeSteps(bool touches) {
  Car c(touches, true);
  Car cpp(touches, false);
  for (int i = 0; i < 2000; ++i) {
    c.timedStep();
    cpp.timedStep();
  }
}

}  // namespace

int main(int argc, char** argv) {
  dInitODE2(0);
  if (argc > 1) {
    makeSteps(std::string_view(argv[1]) == "along");
  } else {
    measure();
  }
  dCloseODE();
  return seen < 0.0 ? 1 : 0;
}
