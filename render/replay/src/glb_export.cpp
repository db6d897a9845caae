#include "bumper/render/glb_export.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "bumper/response/error.h"
#include "gltf_file.h"
#include "run_excerpt.h"
#include "snapshot_input.h"
#include "speed_colours.h"
#include "text.h"
#include "vehicle_shape.h"

namespace bumper {

namespace {

using drawing::GltfFile;
using Eigen::Quaternionf;
using Eigen::Vector3d;
using Eigen::Vector3f;
using Json = nlohmann::json;

const Vector3f mark(0.93F, 0.10F, 0.36F);
constexpr double fullArrow = 6.0;       ///< m
constexpr double pathHalfWidth = 0.12;  ///< m
constexpr double pathLift = 0.04;       ///< m above the ground
constexpr float flash = 0.15F;          ///< s for which a mark that appears is larger than after

/// Triangles of one material.
struct Surface {
  std::vector<Vector3f> vertices;
  std::vector<std::uint32_t> indices;

  void add(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    for (const Vector3d& corner : {a, b, c}) {
      indices.push_back(static_cast<std::uint32_t>(vertices.size()));
      vertices.emplace_back(corner.cast<float>());
    }
  }
};

Json toJson(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Json toJson(const Quaternionf& q) { return {q.x(), q.y(), q.z(), q.w()}; }

class GlbExport {
 public:
  GlbExport(const Scene& scene, const Recording& recording, const GlbOptions& options)
      : scene_(scene), recording_(recording), options_(options) {
    SnapshotOptions whole;
    whole.view = SnapshotView::top;
    run_ = drawing::excerptOf(recording, whole);
    start_ = run_.start;
    for (const RecordedVehicle& vehicle : recording.vehicles()) {
      for (const RecordedPose& pose : vehicle.poses) extent_.extend(pose.position);
    }
    middle_ = extent_.center();
  }

  void write(const std::filesystem::path& file) {
    // A quarter turn about x: the world's z becomes glTF's y.
    const auto quarter = static_cast<float>(0.5 * std::numbers::sqrt2);
    root_ = file_.addNode({{"name", scene_.name.empty() ? "run" : scene_.name},
                           {"translation", {middle_.x(), middle_.z(), -middle_.y()}},
                           {"rotation", {-quarter, 0.0, 0.0, quarter}}});
    file_.json["scenes"].push_back(Json::object({{"nodes", Json::array({root_})}}));
    addScene();
    for (std::size_t v = 0; v < recording_.vehicles().size(); ++v) addVehicle(v);
    if (options_.showPath) addPaths();
    if (options_.showImpacts) addImpacts();
    file_.write(file);
  }

 private:
  [[nodiscard]] float seconds(double time) const { return static_cast<float>(time - start_); }

  std::size_t material(std::string_view name, const Vector3f& colour) {
    const auto [known, isNew] =
        materials_.try_emplace({std::string(name), colour.x(), colour.y(), colour.z()}, 0);
    if (isNew) known->second = file_.addMaterial(name, colour);
    return known->second;
  }

  Json primitive(const Surface& surface, std::size_t material) {
    return {{"attributes", {{"POSITION", file_.addPositions(surface.vertices)}}},
            {"indices", file_.addIndices(surface.indices)},
            {"material", material}};
  }

  std::size_t addMesh(std::string_view name, Json primitives) {
    file_.json["meshes"].push_back({{"name", name}, {"primitives", std::move(primitives)}});
    return file_.json["meshes"].size() - 1;
  }

  [[nodiscard]] bool isNear(const Scene::Triangle& triangle) const {
    Eigen::AlignedBox2d box;
    for (std::size_t k = 0; k < 3; ++k)
      box.extend(Eigen::Vector2d(scene_.corner(triangle, k).head<2>()));
    const Eigen::AlignedBox2d run(extent_.min().head<2>(), extent_.max().head<2>());
    return box.squaredExteriorDistance(run) <= options_.sceneReach * options_.sceneReach;
  }

  void addScene() {
    struct Part {
      Surface surface;
      std::unordered_map<std::uint32_t, std::uint32_t> numbers;
    };
    std::vector<Part> parts(scene_.meshes.size());
    for (const Scene::Triangle& triangle : scene_.triangles) {
      if (!isNear(triangle)) continue;
      Part& part = parts[triangle.mesh];
      for (std::size_t k = 0; k < 3; ++k) {
        const auto next = static_cast<std::uint32_t>(part.surface.vertices.size());
        const auto [number, isNew] = part.numbers.try_emplace(triangle.corners.at(k), next);
        if (isNew)
          part.surface.vertices.emplace_back((scene_.corner(triangle, k) - middle_).cast<float>());
        part.surface.indices.push_back(number->second);
      }
    }
    const std::size_t group = file_.addNode(Json::object({{"name", "scene"}}));
    for (std::size_t m = 0; m < parts.size(); ++m) {
      if (parts[m].surface.indices.empty()) continue;
      const SceneMesh& mesh = scene_.meshes[m];
      const std::size_t looks = material(mesh.material, mesh.colour);
      const std::size_t index =
          addMesh(mesh.name, Json::array({primitive(parts[m].surface, looks)}));
      file_.addChild(group, file_.addNode({{"name", mesh.name}, {"mesh", index}}));
    }
    if (file_.json["nodes"][group].contains("children")) file_.addChild(root_, group);
  }

  std::size_t addBody(std::size_t v) {
    const RecordedVehicle& vehicle = recording_.vehicles()[v];
    std::map<std::array<float, 3>, Surface> surfaces;
    for (const drawing::ShapeTriangle& triangle :
         drawing::vehicleShape(vehicle, v, options_.vehicleMeshes)) {
      const Vector3f& c = triangle.colour;
      surfaces[{c.x(), c.y(), c.z()}].add(triangle.corners[0], triangle.corners[1],
                                          triangle.corners[2]);
    }
    Json primitives;
    for (const auto& [c, surface] : surfaces)
      primitives.push_back(primitive(surface, material(vehicle.name, {c[0], c[1], c[2]})));
    return addMesh(vehicle.name, std::move(primitives));
  }

  /// The vehicle's poses that become keys: their times ascend in single precision.
  [[nodiscard]] std::vector<RecordedPose> keysOf(const RecordedVehicle& vehicle) const {
    std::vector<RecordedPose> keys;
    const double apart = (1.0 - 1e-9) / options_.keysPerSecond;
    for (const RecordedPose& pose : vehicle.poses) {
      const bool isLast = &pose == &vehicle.poses.back();
      if (!keys.empty() && seconds(pose.time) <= seconds(keys.back().time))
        keys.back() = pose;
      else if (keys.empty() || isLast || pose.time - keys.back().time >= apart)
        keys.push_back(pose);
    }
    return keys;
  }

  void addVehicle(std::size_t v) {
    const RecordedVehicle& vehicle = recording_.vehicles()[v];
    if (vehicle.poses.empty()) return;
    std::vector<float> times;
    std::vector<Vector3f> places;
    std::vector<Quaternionf> turns;
    for (const RecordedPose& pose : keysOf(vehicle)) {
      Quaternionf turn = pose.orientation.normalized().cast<float>();
      // The way between two keys is the shorter one only if they lie on the same side.
      if (!turns.empty() && turn.dot(turns.back()) < 0.0F) turn.coeffs() = -turn.coeffs();
      times.push_back(seconds(pose.time));
      places.emplace_back((pose.position - middle_).cast<float>());
      turns.push_back(turn);
    }
    const std::size_t node =
        file_.addNode({{"name", vehicle.name},
                       {"mesh", addBody(v)},
                       {"translation", toJson(places.front().cast<double>().eval())},
                       {"rotation", toJson(turns.front())}});
    file_.addChild(root_, node);
    const std::size_t input = file_.addTimes(times);
    file_.animateTranslation(node, input, places);
    file_.animateRotation(node, input, turns);
    addCamera(node, vehicle);
  }

  void addCamera(std::size_t node, const RecordedVehicle& vehicle) {
    file_.json["cameras"].push_back(
        {{"type", "perspective"},
         {"perspective", {{"yfov", 0.9}, {"znear", 0.1}, {"zfar", 2000.0}}}});
    // Looks forward and down by 15°: the camera's own axes are x right, y up, z back.
    const double down = 15.0 * std::numbers::pi / 180.0;
    Eigen::Matrix3d axes;
    axes.col(0) = -Vector3d::UnitY();
    axes.col(1) = Vector3d(std::sin(down), 0.0, std::cos(down));
    axes.col(2) = Vector3d(-std::cos(down), 0.0, std::sin(down));
    file_.addChild(node, file_.addNode({{"name", "behind " + vehicle.name},
                                        {"camera", file_.json["cameras"].size() - 1},
                                        {"translation", {-9.0, 0.0, 3.2}},
                                        {"rotation", toJson(Quaternionf(axes.cast<float>()))}}));
  }

  void addPaths() {
    const double fastest = drawing::roundedUp(drawing::topSpeed(run_));
    for (std::size_t v = 0; v < run_.paths.size(); ++v) {
      const RecordedVehicle& vehicle = recording_.vehicles()[v];
      const std::vector<RecordedPose>& path = run_.paths[v];
      if (path.size() < 2) continue;
      Surface ribbon;
      std::vector<Vector3f> colours;
      for (std::size_t k = 0; k < path.size(); ++k) {
        const Vector3d way =
            path[std::min(k + 1, path.size() - 1)].position - path[k > 0 ? k - 1 : 0].position;
        Vector3d across = Vector3d::UnitZ().cross(way);
        if (across.norm() < 1e-9) across = Vector3d::UnitY();
        across = pathHalfWidth * across.normalized();
        const Vector3d ground =
            path[k].position - middle_ -
            path[k].orientation * Vector3d(0.0, 0.0, vehicle.parameters.massCentreHeight) +
            pathLift * Vector3d::UnitZ();
        ribbon.vertices.emplace_back((ground + across).cast<float>());
        ribbon.vertices.emplace_back((ground - across).cast<float>());
        colours.resize(ribbon.vertices.size(),
                       drawing::speedColour(path[k].velocity.norm() / fastest));
      }
      for (std::uint32_t k = 2; k < ribbon.vertices.size(); k += 2) {
        for (const std::uint32_t corner : {k - 2, k - 1, k + 1, k - 2, k + 1, k})
          ribbon.indices.push_back(corner);
      }
      if (!pathMaterial_) pathMaterial_ = file_.addUnlitVertexColours("speed");
      const std::string name = "path of " + vehicle.name;
      Json part = primitive(ribbon, *pathMaterial_);
      part["attributes"]["COLOR_0"] = file_.addColours(colours);
      file_.addChild(
          root_,
          file_.addNode({{"name", name}, {"mesh", addMesh(name, Json::array({std::move(part)}))}}));
    }
  }

  void addImpacts() {
    const drawing::DrawnImpact* worst = drawing::hardest(run_);
    if (worst == nullptr) return;
    const double full = std::max(hardness(worst->event), drawing::fullArrowDeltaV);
    const std::size_t looks = file_.addMaterial("impact", mark);
    for (const drawing::DrawnImpact& impact : run_.impacts) {
      const ImpactEvent& event = impact.event;
      const auto other = asSeenBy(event.otherVehicle, event);
      const bool weak = hardness(event) < drawing::weakShare * hardness(worst->event);
      const std::string label =
          "impact " + std::to_string(impact.number) + ", " + drawing::deltaVText(event);
      const double arrow = fullArrow * event.deltaV / full;
      const double opposite = other && other->deltaV > 0.0 ? fullArrow * other->deltaV / full : 0.0;
      const std::size_t mesh = addMesh(
          label, Json::array({primitive(weak ? ball(0.12, 0.0) : pin(arrow, opposite), looks)}));
      // Its x axis is the wall's normal, level.
      const double yaw = std::atan2(event.normal.y(), event.normal.x());
      const Quaternionf turn(Eigen::AngleAxisf(static_cast<float>(yaw), Vector3f::UnitZ()));
      const std::size_t node =
          file_.addNode({{"name", label},
                         {"mesh", mesh},
                         {"translation", toJson(Vector3d(event.contact - middle_))},
                         {"rotation", toJson(turn)},
                         {"extras", extras(event)}});
      file_.addChild(root_, node);
      appear(node, std::max(seconds(event.time), 0.0F));
    }
  }

  static Json extras(const ImpactEvent& event) {
    Json extras = {{"time_s", event.time},
                   {"vehicle", event.vehicle},
                   {"barrier", event.barrier},
                   {"deltaV_mps", event.deltaV},
                   {"approachSpeed_mps", event.approachSpeed},
                   {"impulseNormal_Ns", event.impulseNormal},
                   {"impulseTangent_Ns", event.impulseTangent}};
    if (const auto other = asSeenBy(event.otherVehicle, event)) {
      extras["otherVehicle"] = other->vehicle;
      if (std::isfinite(other->deltaV)) extras["otherDeltaV_mps"] = other->deltaV;
    }
    return extras;
  }

  /// Nothing is seen of the node before its time.
  void appear(std::size_t node, float time) {
    const float next = std::nextafter(time, std::numeric_limits<float>::infinity());
    const std::size_t input = file_.addTimes(std::array{time, next, next + flash});
    file_.animateScale(
        node, input,
        std::array<Vector3f, 3>{Vector3f::Zero(), Vector3f::Constant(1.8F), Vector3f::Ones()});
  }

  /// Around (0, 0, height).
  static Surface ball(double radius, double height) {
    Surface surface;
    constexpr int meridians = 12;
    constexpr int parallels = 6;
    const auto at = [&](int meridian, int parallel) {
      const double around = 2.0 * std::numbers::pi * meridian / meridians;
      const double down = std::numbers::pi * parallel / parallels;
      return Vector3d(radius * std::sin(down) * std::cos(around),
                      radius * std::sin(down) * std::sin(around), height + radius * std::cos(down));
    };
    for (int m = 0; m < meridians; ++m) {
      for (int p = 0; p < parallels; ++p) {
        if (p + 1 < parallels) surface.add(at(m, p), at(m, p + 1), at(m + 1, p + 1));
        if (p > 0) surface.add(at(m, p), at(m + 1, p + 1), at(m + 1, p));
      }
    }
    return surface;
  }

  /// Stands on the contact point and ends above any car, in a ball from which the arrow points, and
  /// another one the opposite way; each if it has a length.
  static Surface pin(double arrow, double opposite) {
    constexpr double height = 2.4;
    Surface surface = ball(0.22, height);
    addTube(surface, Vector3d::Zero(), Vector3d(0.0, 0.0, height), 0.05, 0.05);
    for (const double way : {arrow, -opposite}) {
      if (way == 0.0) continue;
      const double shaft = way - std::copysign(std::min(0.7, 0.6 * std::abs(way)), way);
      addTube(surface, {0.0, 0.0, height}, {shaft, 0.0, height}, 0.09, 0.09);
      addTube(surface, {shaft, 0.0, height}, {way, 0.0, height}, 0.28, 0.0);
    }
    return surface;
  }

  /// Closed at its beginning.
  static void addTube(Surface& surface, const Vector3d& from, const Vector3d& to, double first,
                      double last) {
    constexpr int sides = 12;
    const Vector3d along = (to - from).normalized();
    const Vector3d u = along.unitOrthogonal();
    const Vector3d v = along.cross(u);
    const auto rim = [&](const Vector3d& centre, int side, double radius) {
      const double angle = 2.0 * std::numbers::pi * side / sides;
      return Vector3d(centre + radius * (std::cos(angle) * u + std::sin(angle) * v));
    };
    for (int k = 0; k < sides; ++k) {
      surface.add(from, rim(from, k + 1, first), rim(from, k, first));
      surface.add(rim(from, k, first), rim(from, k + 1, first), rim(to, k + 1, last));
      if (last > 0.0) surface.add(rim(from, k, first), rim(to, k + 1, last), rim(to, k, last));
    }
  }

  const Scene& scene_;
  const Recording& recording_;
  const GlbOptions& options_;
  drawing::RunExcerpt run_;
  double start_ = 0.0;
  Eigen::AlignedBox3d extent_;
  Vector3d middle_ = Vector3d::Zero();
  GltfFile file_;
  std::size_t root_ = 0;
  std::map<std::tuple<std::string, float, float, float>, std::size_t> materials_;
  std::optional<std::size_t> pathMaterial_;
};

}  // namespace

void writeGlb(const Scene& scene, const Recording& recording, const std::filesystem::path& file,
              const GlbOptions& options) {
  const auto require = [&](bool holds, const char* what) {
    if (!holds) throw Error("cannot write " + file.string() + ": " + what);
  };
  require(options.sceneReach >= 0.0, "GlbOptions::sceneReach must be at least 0 m");
  require(options.keysPerSecond > 0.0, "GlbOptions::keysPerSecond must be above 0");
  require(std::ranges::any_of(recording.vehicles(),
                              [](const RecordedVehicle& v) { return !v.poses.empty(); }),
          "the recording holds no pose");
  validate(scene);
  drawing::checkVehicleMeshes(recording, options.vehicleMeshes,
                              "cannot write " + file.string() + ": GlbOptions");
  GlbExport(scene, recording, options).write(file);
}

}  // namespace bumper
