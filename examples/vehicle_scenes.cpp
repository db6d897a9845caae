#include "vehicle_scenes.h"

#include <ode/ode.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <span>
#include <utility>

#include "bumper/engine_adapter/responder.h"
#include "bumper/response/pair.h"
#include "bumper/scenes/paper_scenes.h"
#include "results.h"
#include "scene_parts.h"
#include "yaw_plane_car.h"

namespace bumper::examples {

namespace {

constexpr double stepSize = 0.005;  // s
constexpr double never = std::numeric_limits<double>::infinity();
const Eigen::Vector3f asphalt(0.45F, 0.46F, 0.44F);
const Eigen::Vector3f concrete(0.72F, 0.70F, 0.66F);
const Eigen::Vector3f steel(0.60F, 0.63F, 0.66F);

void addWall(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const std::string& name,
             Scene& scene) {
  addPart(straightWall(from, to, 1.2, 12, 1),
          {.name = name, .material = "concrete", .colour = concrete}, scene);
}

void addGround(const Eigen::Vector2d& low, const Eigen::Vector2d& high, Scene& scene) {
  addPart(level(low, high), {.name = "ground", .material = "asphalt", .colour = asphalt}, scene);
}

// One has the green light; the other does not see the red one. Walls at the four corners.
VehicleScene intersection() {
  VehicleScene scene{.name = "intersection", .title = "A T-bone at an intersection"};
  scene.scene.name = "intersection";
  addGround({-50, -50}, {50, 50}, scene.scene);
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      // Each faces the road.
      const Eigen::Vector2d corner(7.0 * x, 7.0 * y);
      const Eigen::Vector2d along(40.0 * x, 7.0 * y);
      const Eigen::Vector2d away(7.0 * x, 40.0 * y);
      const bool left = x * y > 0.0;
      addWall(left ? along : corner, left ? corner : along, "wall along the street", scene.scene);
      addWall(left ? corner : away, left ? away : corner, "wall along the avenue", scene.scene);
    }
  }
  scene.drivers = {{.name = "street", .place = {-31.2, -1.8}, .speed = 15.0, .brakesAt = 1.9},
                   {.name = "avenue",
                    .place = {1.8, -22.5},
                    .yaw = 0.5 * std::numbers::pi,
                    .speed = 10.0,
                    .brakesAt = never}};
  return scene;
}

// Four wait at a light; the fifth comes.
VehicleScene chain() {
  VehicleScene scene{.name = "chain", .title = "A rear-end chain of five", .duration = 5.0};
  scene.scene.name = "chain";
  addGround({-60, -12}, {40, 12}, scene.scene);
  for (const double y : {-5.0, 5.0})
    addWall({y < 0.0 ? -60.0 : 40.0, y}, {y < 0.0 ? 40.0 : -60.0, y}, "rail", scene.scene);
  const double aside[] = {0.10, -0.15, 0.05, 0.20};
  for (int i = 0; i < 4; ++i) {
    scene.drivers.push_back({.name = "waits " + std::to_string(i + 1),
                             .place = {-6.2 * i, aside[i]},
                             .brakesAt = never});
  }
  scene.drivers.push_back(
      {.name = "last", .place = {-52.0, -0.25}, .speed = 20.0, .brakesAt = 1.2});
  return scene;
}

// Thirty in two lanes, and a wall across the road. Each sees too late that the one ahead brakes.
VehicleScene motorway() {
  VehicleScene scene{
      .name = "motorway", .title = "A pile-up of thirty into a wall", .duration = 12.0};
  scene.scene.name = "motorway";
  addGround({-330, -20}, {20, 20}, scene.scene);
  addWall({0.0, 7.0}, {0.0, -7.0}, "wall across", scene.scene);
  addWall({-320.0, -5.5}, {0.0, -5.5}, "right rail", scene.scene);
  addWall({0.0, 5.5}, {-320.0, 5.5}, "left rail", scene.scene);
  for (int i = 0; i < 30; ++i) {
    const int row = i / 2;
    const bool isLeft = i % 2 == 1;
    scene.drivers.push_back({.name = "car " + std::to_string(i + 1),
                             .place = {-28.0 - 19.0 * row - (isLeft ? 8.0 : 0.0),
                                       (isLeft ? 1.9 : -1.9) + 0.06 * (i * 7 % 5 - 2)},
                             .speed = isLeft ? 31.0 : 28.0,
                             .brakesAt = 0.5 + 0.45 * row});
  }
  return scene;
}

// A yard's gate closes: upon the first car, which is half through, and before the second.
VehicleScene gateway() {
  VehicleScene scene{.name = "gate", .title = "A gate that the application moves", .duration = 6.0};
  scene.scene.name = "gate";
  addGround({-40, -20}, {30, 20}, scene.scene);
  addWall({0.0, 16.0}, {0.0, 3.0}, "left wall", scene.scene);
  addWall({0.0, -3.0}, {0.0, -16.0}, "right wall", scene.scene);
  scene.drivers = {{.name = "first", .place = {-12.6, -0.3}, .speed = 6.0, .brakesAt = never},
                   {.name = "second", .place = {-36.0, 0.4}, .speed = 9.0, .brakesAt = 3.4}};
  scene.gate = SlidingGate{.place = {0.4, 8.0}, .closedAt = 0.0};
  return scene;
}

// Brakes by hand as well as by foot: all the tyres can hold.
constexpr double brakeForce = 8000.0;  // N
constexpr double holds = 4000.0;       // N s/m, near standstill

// A car with its driver, or the gate, in the world and in the recording.
class Scenery {
 public:
  Scenery(dWorldID world, const VehicleScene& scene) : scene_(scene), responder_(world) {
    responder_.addBarrier(scene.scene);
    for (const Driver& driver : scene.drivers) {
      cars_.push_back(std::make_unique<YawPlaneCar>(
          world, nullptr, YawPlaneCarDesign{},
          Eigen::Vector3d(driver.place.x(), driver.place.y(), 0.55), driver.yaw, driver.speed));
      brakesAt_.push_back(driver.brakesAt);
      add(driver.name, cars_.back()->body(), cars_.back()->design().body, Mover::world, {});
    }
    if (scene.gate) addGate(world, *scene.gate);
  }
  ~Scenery() {
    if (gate_ != nullptr) dBodyDestroy(gate_);
  }
  Scenery(const Scenery&) = delete;
  Scenery& operator=(const Scenery&) = delete;
  Scenery(Scenery&&) = delete;
  Scenery& operator=(Scenery&&) = delete;

  void step(dWorldID world) {
    for (std::size_t i = 0; i < cars_.size(); ++i) drive(i);
    if (gate_ != nullptr) {
      const bool isOpen = dBodyGetPosition(gate_)[1] > scene_.gate->closedAt;
      dBodySetLinearVel(gate_, 0.0, isOpen ? -scene_.gate->speed : 0.0, 0.0);
    }
    const std::span<const ImpactEvent> events = responder_.step(stepSize);
    record(events, run_.recording);
    for (const ImpactEvent& event : events) look(event);
    dWorldQuickStep(world, stepSize);
    measureOverlaps();
  }

  void recordPoses() {
    for (std::size_t i = 0; i < ids_.size(); ++i)
      run_.recording.addPose(i, poseOf(responder_, ids_[i]));
  }

  VehicleRun take() { return std::move(run_); }

 private:
  void add(const std::string& name, dBodyID body, const VehicleParameters& parameters, Mover mover,
           RunParameters settings) {
    ids_.push_back(responder_.addVehicle(body, parameters, {.name = name, .mover = mover}));
    run_.recording.addVehicle(name, parameters, std::move(settings));
  }

  void addGate(dWorldID world, const SlidingGate& gate) {
    gate_ = dBodyCreate(world);
    dBodySetKinematic(gate_);
    dBodySetPosition(gate_, gate.place.x(), gate.place.y(), 0.55);
    const double half = 0.5 * SlidingGate::thickness;
    // The mass counts for nothing: nothing moves it.
    const VehicleParameters outline{.mass = 400.0,
                                    .yawInertia = 400.0 / 12.0 * gate.length * gate.length,
                                    .massCentreToFront = half,
                                    .massCentreToRear = half,
                                    .width = gate.length,
                                    .massCentreHeight = 0.55};
    add("gate", gate_, outline, Mover::application, {{"mesh", std::string("gate.glb")}});
  }

  void drive(std::size_t i) {
    YawPlaneCar& car = *cars_[i];
    const bool brakes = responder_.time() >= brakesAt_[i];
    const double force = std::clamp(holds * car.forwardSpeed(), -brakeForce, brakeForce);
    car.drive(brakes ? -force : 0.0);
    car.addTyreForces();
    if (!brakes) return;
    // All four wheels are blocked: they slide sideways, too.
    const double most = 0.3 * 9.81 * car.design().body.mass;
    const Eigen::Vector3d drag =
        -std::min(holds, most / std::max(car.velocity().norm(), 1e-9)) * car.velocity();
    dBodyAddForce(car.body(), drag.x(), drag.y(), 0.0);
    dBodyAddTorque(car.body(), 0.0, 0.0, -4000.0 * car.yawRate());
  }

  // Whoever was hit brakes; and what a pair's impulse must keep.
  void look(const ImpactEvent& event) {
    if (event.phase != EventPhase::impact) return;
    std::vector<double> masses;
    for (std::size_t i = 0; i < cars_.size(); ++i) {
      if (!asSeenBy(scene_.drivers[i].name, event)) continue;
      brakesAt_[i] = std::min(brakesAt_[i], event.time + 0.3);
      masses.push_back(cars_[i]->design().body.mass);
    }
    if (event.otherVehicle.empty()) return;
    ++run_.hits;
    if (masses.size() < 2) return;
    // All cars are alike.
    const Eigen::Vector3d change =
        masses[0] * (event.velocityAfter - event.velocityBefore) +
        masses[1] * (event.otherVelocityAfter - event.otherVelocityBefore);
    const double impulse = std::hypot(event.impulseNormal, event.impulseTangent);
    run_.momentumChange = std::max(run_.momentumChange, change.norm() / impulse);
  }

  void measureOverlaps() {
    std::vector<std::pair<Outline, Placement>> outlines;
    for (std::size_t i = 0; i < ids_.size(); ++i) {
      outlines.emplace_back(Outline(run_.recording.vehicles()[i].parameters),
                            Placement(responder_.position(ids_[i]).head<2>(),
                                      heading(responder_.orientation(ids_[i]))));
    }
    for (std::size_t i = 0; i < outlines.size(); ++i) {
      for (std::size_t k = i + 1; k < outlines.size(); ++k) {
        const double apart =
            separation(outlines[i].first, outlines[i].second, outlines[k].first, outlines[k].second)
                .distance;
        run_.deepestOverlap = std::max(run_.deepestOverlap, -apart);
      }
    }
  }

  const VehicleScene& scene_;
  std::vector<std::unique_ptr<YawPlaneCar>> cars_;
  dBodyID gate_ = nullptr;
  std::vector<double> brakesAt_;
  Responder responder_;
  std::vector<VehicleId> ids_;
  VehicleRun run_;
};

}  // namespace

std::vector<VehicleScene> vehicleScenes() {
  return {intersection(), chain(), motorway(), gateway()};
}

Scene meshOf(const SlidingGate& gate) {
  Scene scene;
  scene.name = "gate";
  const Eigen::Vector3d half(0.5 * SlidingGate::thickness, 0.5 * gate.length, 0.0);
  addPart(block(-half, half + Eigen::Vector3d(0.0, 0.0, SlidingGate::height)),
          {.name = "gate", .material = "steel", .colour = steel}, scene);
  return scene;
}

VehicleRun runVehicleScene(const VehicleScene& scene) {
  VehicleRun run;
  const dWorldID world = dWorldCreate();  // without gravity: the cars stay in their yaw plane
  {
    Scenery scenery(world, scene);
    scenery.recordPoses();
    const long last = std::lround(scene.duration / stepSize);
    for (long i = 1; i <= last; ++i) {
      scenery.step(world);
      if (i % 2 == 0) scenery.recordPoses();
    }
    run = scenery.take();
  }
  dWorldDestroy(world);
  return run;
}

}  // namespace bumper::examples
