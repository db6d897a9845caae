// Drives a car through any mesh file and lets it hit what stands in its way.
//
//   bumper-drive aalborg.acc --up y --start 200,300 --heading 15 --speed 30 --out out/drive
//
// The whole file becomes one ODE trimesh, road and walls in one, as a game would load it: the
// wheels stand on it, Bumper answers for its walls, ODE's contact joints for the rest.

#include <ode/ode.h>

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "bumper/base/printing.h"
#include "bumper/engine_adapter/responder.h"
#include "bumper/response/error.h"
#include "bumper/scenes/scene_files.h"
#include "impact_table.h"
#include "ray_suspension.h"
#include "results.h"
#include "scene_loading.h"
#include "start_place.h"
#include "tool.h"
#include "vehicle_mesh_files.h"
#include "yaw_plane_car.h"

namespace {

using namespace bumper;
using namespace bumper::examples;
using namespace bumper::tools;

constexpr double degree = std::numbers::pi / 180.0;
constexpr double gravity = 9.81;  // m/s²
constexpr double infinity = std::numeric_limits<double>::infinity();

struct Arguments {
  std::filesystem::path scene;
  std::string up;
  double scale = 1.0;
  std::string scenery;        // meshes to drive through
  std::vector<double> start;  // m, two or three numbers; empty: near the middle of the scene
  double heading = 0.0;       // deg from x towards y
  double speed = 25.0;        // m/s
  std::vector<std::string> steering{"0:0"};
  bool coast = false;
  double duration = 15.0;  // s
  double step = 0.005;     // s
  std::string law = "restitution";
  VehicleMeshOptions meshes;
  std::filesystem::path out = "out/drive";
};

// Angles of the front wheels over time, rad, straight between the given ones.
AngleCurve steeringOf(const std::vector<std::string>& entries) {
  std::vector<std::pair<double, double>> points;
  for (const std::string& entry : entries) {
    double time = 0.0;
    double angle = 0.0;
    char colon = 0;
    std::istringstream text(entry);
    const bool isRead = text >> time >> colon >> angle && colon == ':' && text.peek() == EOF;
    if (!isRead || !(std::abs(angle) <= 90.0)) {
      throw Error("--steering: '" + entry + "' is not <seconds>:<degrees>, at most 90 either way");
    }
    points.emplace_back(time, angle * degree);
  }
  return AngleCurve::table(points);
}

// The application's side of ODE: one world, one space, and the scene as one static trimesh.
struct World {
  World(const Scene& scene, const std::vector<bool>& scenery)
      : world(dWorldCreate()), space(dHashSpaceCreate(nullptr)), joints(dJointGroupCreate(0)) {
    dWorldSetGravity(world, 0.0, 0.0, -gravity);
    for (const Eigen::Vector3d& v : scene.vertices) {
      vertices.insert(vertices.end(), {v.x(), v.y(), v.z()});
    }
    for (const Scene::Triangle& t : scene.triangles) {
      if (scenery[t.mesh]) continue;
      indices.insert(indices.end(), t.corners.begin(), t.corners.end());
    }
    data = dGeomTriMeshDataCreate();
    dGeomTriMeshDataBuildDouble(data, vertices.data(), 3 * sizeof(double),
                                static_cast<int>(vertices.size() / 3), indices.data(),
                                static_cast<int>(indices.size()), 3 * sizeof(dTriIndex));
    mesh = dCreateTriMesh(space, data, nullptr, nullptr, nullptr);
  }
  ~World() {
    dJointGroupDestroy(joints);
    dGeomDestroy(mesh);
    dGeomTriMeshDataDestroy(data);
    dSpaceDestroy(space);
    dWorldDestroy(world);
  }
  World(const World&) = delete;
  World& operator=(const World&) = delete;
  World(World&&) = delete;
  World& operator=(World&&) = delete;

  static void nearCallback(void* self, dGeomID a, dGeomID b) {
    static_cast<World*>(self)->collide(a, b);
  }

  void collide(dGeomID a, dGeomID b) const {
    if (responder->claims(a, b)) return;
    constexpr int capacity = 32;
    dContact contacts[capacity] = {};
    int count = dCollide(a, b, capacity, &contacts[0].geom, sizeof(dContact));
    count = responder->keepUnclaimed(a, b, contacts, count);
    for (int i = 0; i < count; ++i) {
      contacts[i].surface.mode = dContactApprox1;
      contacts[i].surface.mu = 0.6;
      dJointAttach(dJointCreateContact(world, joints, &contacts[i]), dGeomGetBody(a),
                   dGeomGetBody(b));
    }
  }

  dWorldID world;
  dSpaceID space;
  dJointGroupID joints;
  std::vector<double> vertices;
  std::vector<dTriIndex> indices;
  dTriMeshDataID data = nullptr;
  dGeomID mesh = nullptr;
  Responder* responder = nullptr;
};

Eigen::Vector3d startOf(const Arguments& arguments, const Scene& scene,
                        const std::vector<bool>& scenery, double massCentreHeight) {
  const StartPlaces places(scene, scenery);
  const std::vector<double>& given = arguments.start;
  const std::optional<Eigen::Vector2d> place =
      given.empty() ? places.middle() : Eigen::Vector2d(given[0], given[1]);
  if (!place) throw Error("there is no ground in the scene");
  const std::optional<double> ground =
      given.size() == 3 ? places.groundNear(*place, given[2]) : places.lowestGround(*place);
  if (!ground) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& v : scene.vertices) box.extend(v);
    std::ostringstream message;
    message << "there is no ground at --start " << place->x() << ',' << place->y()
            << "; the scene reaches from " << box.min().x() << ',' << box.min().y() << " to "
            << box.max().x() << ',' << box.max().y() << " m";
    throw Error(message.str());
  }
  std::printf("start: %.1f,%.1f,%.1f", place->x(), place->y(), *ground);
  const double top = places.groundNear(*place, infinity).value_or(*ground);
  if (top > *ground) std::printf("; there is more ground above it, up to %.1f m", top);
  std::putchar('\n');
  return {place->x(), place->y(), *ground + massCentreHeight};
}

Recording run(const Arguments& arguments, const Scene& scene) {
  const std::vector<bool> scenery = matchingMeshes(scene, arguments.scenery);
  World world(scene, scenery);
  const YawPlaneCarDesign design;
  YawPlaneCar car(world.world, world.space, design,
                  startOf(arguments, scene, scenery, design.body.massCentreHeight),
                  arguments.heading * degree, arguments.speed);
  // After what it refers to, so that it is gone before.
  Responder responder(
      world.world,
      {.response = {.law = arguments.law == "energy" ? Law::energy : Law::restitution}});
  world.responder = &responder;
  const BarrierId barrier =
      responder.addBarrier(world.mesh, {.name = arguments.scene.filename().string()});
  const WallReport& report = responder.report(barrier);
  std::printf(
      "%s: %zu triangles, %zu of them walls from %.1f to %.1f m (%.1f MB); dropped: %zu out of "
      "reach, %zu twice\n",
      printable(arguments.scene.filename().string()).c_str(), scene.triangles.size(), report.walls,
      report.lowestFoot, report.highestTop, 1e-6 * static_cast<double>(report.memory),
      report.droppedOverhead + report.droppedBuried,
      report.droppedDuplicate + report.droppedRetriangulated);

  const VehicleId vehicle = responder.addVehicle(car.body(), design.body, {.name = "car"});
  RaySuspension suspension(car, world.mesh, gravity);
  const AngleCurve steering = steeringOf(arguments.steering);

  Recording recording;
  const std::size_t recorded = recording.addVehicle(
      "car", design.body, meshSettings(arguments.meshes, "car", arguments.out));
  recording.addPose(recorded, poseOf(responder, vehicle));
  const auto started = std::chrono::steady_clock::now();
  while (responder.time() < arguments.duration - 0.5 * arguments.step) {
    dSpaceCollide(world.space, &world, &World::nearCallback);
    car.steer(steering(responder.time()));
    car.drive(arguments.coast ? 0.0 : 3000.0 * (arguments.speed - car.forwardSpeed()));
    suspension.addForces();
    car.addTyreForces();
    record(responder.step(arguments.step), recording);
    dWorldQuickStep(world.world, arguments.step);
    dJointGroupEmpty(world.joints);
    recording.addPose(recorded, poseOf(responder, vehicle));
    if ((responder.issues() & step_issue::tilted) != 0) {
      std::printf("the car leans beyond 30° after %.2f s, rolled over or in the air: that is all\n",
                  responder.time());
      break;
    }
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - started;
  std::printf("%.2f s driven in %.3f s: real-time factor %.0f\n", responder.time(), took.count(),
              responder.time() / took.count());
  return recording;
}

// Prints how far the loading is, if it takes longer than a moment.
class LoadProgress {
 public:
  ~LoadProgress() {
    if (printed_) std::fputc('\n', stderr);
  }
  void operator()(LoadStage stage, double share) {
    const auto now = std::chrono::steady_clock::now();
    if (now - last_ < std::chrono::milliseconds(500)) return;
    last_ = now;
    printed_ = true;
    constexpr std::array<const char*, 4> names{"reading", "converting", "welding", "dropping"};
    const std::chrono::duration<double> passed = now - begun_;
    std::fprintf(stderr, "\rloading: %.1f s, %s %3.0f %%   ", passed.count(),
                 names.at(static_cast<std::size_t>(stage)), 100.0 * share);
  }

 private:
  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point last_ = begun_;
  bool printed_ = false;
};

Scene load(const Arguments& arguments) {
  LoadProgress line;
  return loadScene(
      arguments.scene, "--up",
      {.up = upAxis(arguments.up), .scale = arguments.scale, .progress = std::ref(line)});
}

// So that the recording finds its scene again when both are moved together.
RunDescription describe(const Arguments& arguments, const Scene& scene) {
  RunDescription run{.scene = referenceTo(scene)};
  run.scene.file =
      std::filesystem::proximate(arguments.scene, std::filesystem::absolute(arguments.out))
          .string();
  run.scene.up = arguments.up;
  run.scene.scale = arguments.scale;
  run.parameters = {{"law", arguments.law}, {"step_s", arguments.step}};
  return run;
}

void drive(const Arguments& arguments) {
  dInitODE2(0);
  const Scene scene = load(arguments);
  const Recording recording = run(arguments, scene);
  const VehicleMeshes meshes = loadVehicleMeshes(arguments.meshes, recording, arguments.out);
  printImpacts(recording);
  writeResults(arguments.out, scene, recording, arguments.scene.filename().string(),
               describe(arguments, scene), meshes);
  dCloseODE();
}

int runDrive(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Drives a car through a mesh file and lets it hit what stands in its way.",
               "bumper-drive");
  app.add_option("scene", arguments.scene, "mesh file, any format that assimp reads")->required();
  tools::addUpAndScale(app, arguments.up, arguments.scale);
  app.add_option("--scenery", arguments.scenery,
                 "meshes to drive through, by name or material, as trees in pictures: a regular "
                 "expression, e.g. \"OBJ.*|TREE.*\"");
  app.add_option(
         "--start", arguments.start,
         "of the start, m, z up; Z names the storey, without it the lowest ground with 2 m of "
         "room above it (default: near the scene's middle)")
      ->delimiter(',')
      ->expected(2, 3)
      ->check(numberIn(-1e9, 1e9))
      ->type_name("X,Y[,Z]");
  app.add_option("--heading", arguments.heading, "of the start, deg from x towards y")
      ->check(numberIn(-360.0, 360.0))
      ->capture_default_str();
  app.add_option("--speed", arguments.speed, "at the start, and held from then on, m/s")
      ->check(numberIn(-1000.0, 1000.0))
      ->capture_default_str();
  app.add_option("--steering", arguments.steering,
                 "front wheel angles over time, <s>:<deg>,<s>:<deg>,…, positive to the left")
      ->delimiter(',');
  app.add_flag("--coast", arguments.coast, "do not hold the speed");
  app.add_option("--duration", arguments.duration, "s")
      ->check(numberIn(1e-4, 86400.0))
      ->capture_default_str();
  app.add_option("--step", arguments.step, "s")->check(numberIn(1e-4, 0.05))->capture_default_str();
  app.add_option("--law", arguments.law, "how the walls answer")
      ->check(CLI::IsMember({"restitution", "energy"}))
      ->capture_default_str();
  addVehicleMeshOptions(app, arguments.meshes);
  app.add_option("--out", arguments.out, "folder for tables and pictures")->capture_default_str();
  app.footer("\n" + exitCodes());
  return runTool(app, argc, argv, [&] { drive(arguments); });
}

}  // namespace

int main(int argc, char** argv) { return runMain("bumper-drive", runDrive, argc, argv); }
