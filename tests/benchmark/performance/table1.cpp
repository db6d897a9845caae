#include "table1.h"

#include <algorithm>
#include <memory>
#include <span>
#include <utility>

#include "bumper/engine_adapter/responder.h"
#include "car_world.h"
#include "clock.h"
#include "moved_body.h"
#include "yaw_plane_car.h"
#ifdef BUMPER_OSG
#include "osg_query.h"
#endif

namespace bumper::benchmark {

namespace {

/// The paper's vehicle, in a world of its own.
class Update {
 public:
  Update()
      : car_(ode_.world, nullptr, examples::YawPlaneCarDesign{.body = queryCar()},
             Eigen::Vector3d(0.0, 0.0, queryCar().massCentreHeight), 0.0, 0.0) {}
  virtual ~Update() = default;
  Update(const Update&) = delete;
  Update& operator=(const Update&) = delete;
  Update(Update&&) = delete;
  Update& operator=(Update&&) = delete;

  /// All updates of a drive, µs each.
  double run(std::span<const Pose> poses) {
    const Timer timer;
    for (const Pose& pose : poses) {
      writePose(car_.body(), pose, queryCar().massCentreHeight);
      car_.addTyreForces();
      collide(pose);
      dWorldQuickStep(ode_.world, stepSize);
    }
    return 1e-3 * timer.elapsed() / static_cast<double>(poses.size());
  }

 protected:
  virtual void collide(const Pose& /*pose*/) {}
  [[nodiscard]] dWorldID world() const { return ode_.world; }
  [[nodiscard]] dBodyID body() const { return car_.body(); }

 private:
  CarWorld ode_;
  examples::YawPlaneCar car_;
};

class BumperUpdate final : public Update {
 public:
  BumperUpdate(const Scene& scene, const ResponseSettings& settings)
      : responder_(world(), {.response = settings}) {
    responder_.addBarrier(scene);
    responder_.addVehicle(body(), queryCar());
  }

 private:
  void collide(const Pose& /*pose*/) override { responder_.step(stepSize); }

  Responder responder_;
};

#ifdef BUMPER_OSG
/// The paper's way: the outline's sides against the scene graph, and the response to what is hit.
class OsgUpdate final : public Update {
 public:
  OsgUpdate(const Scene& scene, ResponseSettings settings, OsgScene kind)
      : query_(scene, kind), settings_(std::move(settings)) {}

 private:
  void collide(const Pose& pose) override {
    query_.moveTo(pose);
    query_.query();
    if (!query_.found()) return;
    const auto& hit = query_.first();
    const osg::Vec3d point = hit.getWorldIntersectPoint();
    const osg::Vec3d normal = hit.getWorldIntersectNormal();
    Impact impact;
    impact.point = {point.x(), point.y()};
    impact.arm = impact.point - pose.place.position;
    impact.normal = Vector2(normal.x(), normal.y()).normalized();
    if (impact.normal.dot(impact.arm) > 0.0) impact.normal = -impact.normal;
    const PlanarMotion motion{
        .position = pose.place.position, .velocity = pose.velocity, .yawRate = pose.yawRate};
    if (velocityAt(motion, impact.arm).dot(impact.normal) >= 0.0) return;
    const VehicleParameters car = queryCar();
    const PlanarImpulse impulse = bumper::respond(impact, freeBody(car, motion), settings_).impulse;
    dBodyAddForce(body(), impulse.linear.x() / stepSize, impulse.linear.y() / stepSize, 0.0);
    dBodyAddTorque(body(), 0.0, 0.0, impulse.angular / stepSize);
  }

  OsgQuery query_;
  ResponseSettings settings_;
};
#endif

/// The drive's way through its first swerve, a third of it beside or on the wall.
std::vector<Pose> firstSwerve(const Scene& scene) {
  constexpr std::size_t before = 300;
  constexpr std::size_t poses = 900;
  const Drive drive = makeDrive(scene, 6000);
  std::size_t begin = 0;
  for (const Stretch& stretch : drive.stretches) {
    if (stretch.kind == Nearness::touching) break;
    begin += stretch.poses.size();
  }
  begin -= std::min(begin, before);
  const auto first = drive.poses.begin() + static_cast<std::ptrdiff_t>(begin);
  return {first, first + std::min<std::ptrdiff_t>(poses, drive.poses.end() - first)};
}

struct Cell {
  Table1Row row;
  std::unique_ptr<Update> update;
};

}  // namespace

std::vector<Table1Row> measureTable1(int repetitions) {
  struct NamedLaw {
    const char* name;
    Law law;
  };
  const Scene walls = makeScene("S2").scene;
  const std::vector<NamedScene> scenes = {
      makeScene("S1"),
      {.name = "course", .scene = shuffled(walls)},
      {.name = "course regrouped", .scene = regrouped(shuffled(walls))}};
  std::vector<Table1Row> rows;
  for (const NamedScene& scene : scenes) {
    const bool isRail = scene.name == "S1";
    const std::vector<Pose> poses = firstSwerve(scene.scene);
    std::vector<Cell> cells;
    const auto add = [&](const char* law, const char* scheme, std::unique_ptr<Update> update) {
      cells.push_back({.row = {.scene = isRail ? "test rail" : scene.name,
                               .law = law,
                               .scheme = scheme,
                               .update = infinity,
                               .withoutCollision = infinity},
                       .update = std::move(update)});
    };
    for (const auto& [name, law] :
         {NamedLaw{"energy", Law::energy}, NamedLaw{"restitution", Law::restitution}}) {
      ResponseSettings settings;
      settings.law = law;
      add(name, "bumper", std::make_unique<BumperUpdate>(scene.scene, settings));
#ifdef BUMPER_OSG
      const OsgScene kind = scene.name == "course regrouped" ? OsgScene::grouped : OsgScene::flat;
      add(name, "osg_flat", std::make_unique<OsgUpdate>(scene.scene, settings, kind));
#endif
    }
    Update without;
    for (int repetition = 0; repetition < repetitions; ++repetition) {
      const double rest = without.run(poses);
      for (Cell& cell : cells) {
        cell.row.update = std::min(cell.row.update, cell.update->run(poses));
        cell.row.withoutCollision = std::min(cell.row.withoutCollision, rest);
      }
    }
    for (Cell& cell : cells) rows.push_back(std::move(cell.row));
  }
  return rows;
}

}  // namespace bumper::benchmark
