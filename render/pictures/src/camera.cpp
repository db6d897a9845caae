#include "camera.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "bumper/response/error.h"

namespace bumper::drawing {

namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double degree = std::numbers::pi / 180.0;

// As documented at SnapshotView::top.
constexpr double usableWidth = 0.92;
constexpr double usableHeight = 0.76;
constexpr double growthInVehicles = 1.5;
constexpr double leastGrowth = 6.0;
constexpr double headroom = 8.0;

// As documented at SnapshotView::three_quarter.
constexpr double elevation = 27.0 * degree;
constexpr double halfFieldOfView = 16.0 * degree;  // vertical
constexpr double usableThreeQuarter = 0.76;

double lengthOf(const VehicleParameters& vehicle) {
  return vehicle.massCentreToFront + vehicle.massCentreToRear;
}

Camera topCamera(const SightLines& scene, const Recording& recording, const RunExcerpt& run,
                 const SnapshotOptions& options) {
  AlignedBox2d frame;
  double highest = -std::numeric_limits<double>::infinity();
  for (const auto& path : run.paths) {
    for (const RecordedPose& pose : path) {
      frame.extend(Vector2d(pose.position.head<2>()));
      highest = std::max(highest, pose.position.z());
    }
  }
  for (const DrawnImpact& impact : run.impacts)
    frame.extend(Vector2d(impact.event.contact.head<2>()));
  double growth = leastGrowth;
  for (const RecordedVehicle& vehicle : recording.vehicles())
    growth = std::max(growth, growthInVehicles * lengthOf(vehicle.parameters));

  const Eigen::AlignedBox3d& all = scene.box();
  if (frame.isEmpty()) {
    frame = AlignedBox2d(all.min().head<2>(), all.max().head<2>());
    highest = all.max().z();
  }
  frame.extend(Vector2d(frame.min() - Vector2d::Constant(growth)));
  frame.extend(Vector2d(frame.max() + Vector2d::Constant(growth)));

  Camera camera;
  camera.width = options.width;
  camera.height = options.height;
  Vector2d size = frame.sizes();
  const bool turned = (size.y() > size.x()) == (options.width > options.height);
  if (turned) {
    std::swap(size.x(), size.y());
    camera.axes << 0, 1, 0, -1, 0, 0, 0, 0, 1;
  }
  const double scale =
      std::min(usableWidth * options.width / size.x(), usableHeight * options.height / size.y());
  const double ceiling = highest + headroom;
  const double depth = ceiling - std::min(all.min().z(), highest) + 1.0;
  camera.eye << frame.center(), ceiling;
  camera.focus << frame.center(), highest;
  camera.extent = 0.5 * std::hypot(options.width, options.height) / scale;
  camera.projection.diagonal() << 2.0 * scale / options.width, 2.0 * scale / options.height,
      -2.0 / depth, 1.0;
  camera.projection(2, 3) = -1.0;
  // From the upper left, as readers of maps expect.
  camera.sun = Vector3d(-0.55 * camera.right() + 0.45 * camera.up() + 0.80 * camera.back());
  camera.sun.normalize();
  return camera;
}

/// Corners of the box around a vehicle.
void addCorners(const VehicleParameters& vehicle, const RecordedPose& pose,
                std::vector<Vector3d>& points) {
  for (const double x : {vehicle.massCentreToFront, -vehicle.massCentreToRear}) {
    for (const double y : {-0.5 * vehicle.width, 0.5 * vehicle.width}) {
      for (const double z : {-1.0, 1.6}) {
        points.emplace_back(pose.position +
                            pose.orientation * Vector3d(x, y, z * vehicle.massCentreHeight));
      }
    }
  }
}

/// Where the corners of a vehicle's outline stand on the ground.
void addWheels(const VehicleParameters& vehicle, const RecordedPose& pose,
               std::vector<Vector3d>& points) {
  for (const double x : {vehicle.massCentreToFront, -vehicle.massCentreToRear}) {
    for (const double y : {-0.5 * vehicle.width, 0.5 * vehicle.width}) {
      points.emplace_back(pose.position +
                          pose.orientation * Vector3d(x, y, -0.9 * vehicle.massCentreHeight));
    }
  }
}

/// What a three-quarter view is about, and the way things went there.
struct Subject {
  std::vector<Vector3d> points;
  Vector3d travel = Vector3d::UnitX();  ///< horizontal, unit
  Vector3d open = Vector3d::Zero();     ///< horizontal, out of the wall; zero without impact
  std::vector<Vector3d> watched;        ///< few of the points, near the ground
};

Vector3d horizontal(const Vector3d& direction, const Vector3d& otherwise) {
  const Vector3d flat(direction.x(), direction.y(), 0.0);
  return flat.norm() > 1e-6 ? Vector3d(flat.normalized()) : otherwise;
}

Subject subjectOf(const SightLines& scene, const Recording& recording, const RunExcerpt& run) {
  Subject subject;
  const DrawnImpact* impact = hardest(run);
  for (std::size_t v = 0; v < run.paths.size(); ++v) {
    const auto& path = run.paths[v];
    if (path.empty()) continue;
    const RecordedVehicle& vehicle = recording.vehicles()[v];
    const Vector3d centre = impact != nullptr ? impact->event.contact : path.back().position;
    const double reach = impact != nullptr ? reachOfImpact : reachOfEnd;
    std::vector<const RecordedPose*> seen;
    for (const RecordedPose& pose : path) {
      if ((pose.position - centre).norm() > reach) continue;
      addCorners(vehicle.parameters, pose, subject.points);
      seen.push_back(&pose);
    }
    for (std::size_t k = 0; k < seen.size(); k += std::max<std::size_t>(1, seen.size() / 8))
      addWheels(vehicle.parameters, *seen[k], subject.watched);
    if (impact != nullptr && impact->event.vehicle != vehicle.name) continue;
    // The way there: from where the vehicle was a few lengths before.
    const auto at = impact != nullptr ? poseAt(vehicle, impact->event.time) : path.back();
    const RecordedPose here = at.value_or(path.back());
    Vector3d from = path.front().position;
    for (const RecordedPose& pose : path) {
      if (pose.time >= here.time) break;
      if ((pose.position - here.position).norm() >= lengthOf(vehicle.parameters))
        from = pose.position;
    }
    subject.travel = horizontal(
        here.position - from, horizontal(here.orientation * Vector3d::UnitX(), Vector3d::UnitX()));
  }
  if (impact != nullptr) {
    subject.points.push_back(impact->event.contact);
    subject.open = horizontal(impact->event.normal, Vector3d::Zero());
  }
  if (subject.points.empty()) {
    for (int corner = 0; corner < 8; ++corner)
      subject.points.emplace_back(
          scene.box().corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)));
  }
  return subject;
}

/// Moves a camera of given direction as near as all points allow.
void fit(Camera& camera, const std::vector<Vector3d>& points, double tangentX, double tangentY) {
  // In the camera's axes a point (x, y, z) is inside from an eye (X, Y, Z) if |x − X| and |y − Y|
  // are at most tangent · (Z − z): each side bounds a sum of two unknowns.
  const auto bounds = [&](int axis, double tangent) {
    std::array<double, 2> most = {-std::numeric_limits<double>::infinity(),
                                  -std::numeric_limits<double>::infinity()};
    for (const Vector3d& point : points) {
      const Vector3d p = camera.axes * point;
      most[0] = std::max(most[0], p[axis] + tangent * p.z());
      most[1] = std::max(most[1], -p[axis] + tangent * p.z());
    }
    return most;
  };
  const auto x = bounds(0, tangentX);
  const auto y = bounds(1, tangentY);
  const double z = std::max((x[0] + x[1]) / (2.0 * tangentX), (y[0] + y[1]) / (2.0 * tangentY));
  camera.eye = camera.axes.transpose() * Vector3d(0.5 * (x[0] - x[1]), 0.5 * (y[0] - y[1]), z);
}

void setPerspective(Camera& camera, double tangentY, double nearest, double farthest) {
  camera.perspective = true;
  const double tangentX = tangentY * camera.width / camera.height;
  camera.projection << 1.0 / tangentX, 0, 0, 0,           //
      0, 1.0 / tangentY, 0, 0,                            //
      0, 0, (farthest + nearest) / (nearest - farthest),  //
      2.0 * farthest * nearest / (nearest - farthest),    //
      0, 0, -1, 0;
}

/// Seen from behind and from the side that a horizontal unit vector points to.
Camera cameraFrom(const Vector3d& side, const Subject& subject, const SnapshotOptions& options) {
  Camera camera;
  camera.width = options.width;
  camera.height = options.height;

  const Vector3d backFlat = (-0.72 * subject.travel + 0.69 * side).normalized();
  const Vector3d back = std::cos(elevation) * backFlat + std::sin(elevation) * Vector3d::UnitZ();
  const Vector3d right = Vector3d::UnitZ().cross(back).normalized();
  camera.axes.row(0) = right;
  camera.axes.row(1) = back.cross(right);
  camera.axes.row(2) = back;
  // Walls beside the way and walls ahead are lit from the side that is seen.
  camera.sun = (0.60 * side - 0.35 * subject.travel + 0.85 * Vector3d::UnitZ()).normalized();

  const double tangentY = std::tan(halfFieldOfView);
  const double tangentX = tangentY * options.width / options.height;
  fit(camera, subject.points, usableThreeQuarter * tangentX, usableThreeQuarter * tangentY);

  Eigen::AlignedBox3d box;
  for (const Vector3d& point : subject.points) box.extend(point);
  camera.focus = box.center();
  camera.extent = 0.5 * box.sizes().norm();
  const double distance = (camera.eye - camera.focus).norm();
  camera.hazeStart = 1.6 * distance;
  camera.hazeEnd = 9.0 * distance + 200.0;
  setPerspective(camera, tangentY, 0.08 * distance, 12.0 * distance + 400.0);
  return camera;
}

Camera threeQuarterCamera(const SightLines& scene, const Recording& recording,
                          const RunExcerpt& run, const SnapshotOptions& options) {
  const Subject subject = subjectOf(scene, recording, run);
  const Vector3d left = Vector3d::UnitZ().cross(subject.travel);
  const Vector3d side = left.dot(subject.open) < -0.05 ? Vector3d(-left) : left;
  const Camera open = cameraFrom(side, subject, options);
  const Camera other = cameraFrom(-side, subject, options);
  return scene.hidden(subject.watched, other.eye) < scene.hidden(subject.watched, open.eye) ? other
                                                                                            : open;
}

/// From an eye to a target, with the light from one side of the world.
Camera cameraAt(const Vector3d& eye, const Vector3d& target, double fieldOfView,
                const SnapshotOptions& options) {
  Camera camera;
  camera.width = options.width;
  camera.height = options.height;
  camera.eye = eye;
  const double distance = (eye - target).norm();
  const Vector3d back = (eye - target) / distance;
  const bool upright = std::abs(back.z()) > 0.9999;
  const Vector3d up = upright ? Vector3d::UnitY() : Vector3d::UnitZ();
  camera.axes.row(0) = up.cross(back).normalized();
  camera.axes.row(1) = back.cross(Vector3d(camera.axes.row(0)));
  camera.axes.row(2) = back;
  camera.focus = target;
  camera.extent = 0.8 * distance;
  camera.hazeStart = 60.0 + 1.6 * distance;
  camera.hazeEnd = 600.0 + 9.0 * distance;
  camera.sun = Vector3d(0.40, -0.45, 0.80).normalized();
  setPerspective(camera, std::tan(0.5 * fieldOfView * degree), std::max(0.05, 0.06 * distance),
                 1500.0 + 12.0 * distance);
  return camera;
}

void require(bool fine, const char* name, double value, const char* allowed) {
  if (fine) return;
  std::ostringstream message;
  message << name << " is " << value << ": it must " << allowed;
  throw Error(message.str());
}

const RecordedVehicle& followed(const Recording& recording, std::size_t index) {
  const auto vehicles = recording.vehicles();
  if (index >= vehicles.size())
    throw Error("a view follows vehicle " + std::to_string(index) + ": the recording has " +
                std::to_string(vehicles.size()));
  if (vehicles[index].poses.empty())
    throw Error("a view follows vehicle '" + vehicles[index].name + "', which has no poses");
  return vehicles[index];
}

/// The pose at a time, or the nearest that was recorded.
RecordedPose poseNear(const RecordedVehicle& vehicle, double time) {
  return *poseAt(vehicle, std::clamp(time, vehicle.poses.front().time, vehicle.poses.back().time));
}

/// Where in plan the end of a rope of given length lies that the vehicle pulled and pushed there.
Vector2d endOfRope(const RecordedVehicle& vehicle, const RecordedPose& here, double length) {
  constexpr double memory = 6.0;  // rope lengths: what was before turns the rope by 0.3 %
  const auto& poses = vehicle.poses;
  auto first = std::ranges::upper_bound(poses, here.time, {}, &RecordedPose::time);
  const auto end = first;
  double way = 0.0;
  while (first != poses.begin() && way < memory * length) {
    --first;
    if (std::next(first) != end) way += (std::next(first)->position - first->position).norm();
  }
  const RecordedPose& start = first == end ? here : *first;
  const double angle = heading(start.orientation);
  Vector2d rope = -length * Vector2d(std::cos(angle), std::sin(angle));
  Vector2d last = start.position.head<2>();
  const auto pull = [&](const Vector3d& position) {
    const Vector2d next = position.head<2>();
    rope = length * Vector2d(last + rope - next).stableNormalized();
    last = next;
  };
  for (auto pose = first; pose != end; ++pose) pull(pose->position);
  pull(here.position);
  return last + rope;
}

Camera chaseCamera(const SightLines& scene, const Recording& recording, const RunExcerpt& run,
                   const SnapshotOptions& options) {
  const ChaseCamera& chase = options.chase;
  require(chase.distance >= 2.0 && chase.distance <= 1000.0, "ChaseCamera::distance",
          chase.distance, "lie in 2 m to 1000 m");
  require(chase.height >= 0.0 && chase.height <= 1000.0, "ChaseCamera::height", chase.height,
          "lie in 0 m to 1000 m");
  const RecordedVehicle& vehicle = followed(recording, chase.vehicle);
  const RecordedPose here = poseNear(vehicle, run.now);
  Vector3d eye;
  eye << endOfRope(vehicle, here, chase.distance), here.position.z() + chase.height;
  const Vector3d ahead = horizontal(here.position - eye, Vector3d::UnitX());
  const Vector3d target = here.position + 0.3 * chase.distance * ahead;
  // From above the roof; a little before the wall, and not into the car.
  const Vector3d roof =
      here.position + Vector3d(0.0, 0.0, 2.0 * vehicle.parameters.massCentreHeight);
  const double least = std::min(1.0, 1.2 * vehicle.parameters.massCentreToRear / chase.distance);
  const double share = scene.visibleShare(roof, eye);
  if (share < 1.0) eye = roof + std::max(least, 0.92 * share) * (eye - roof);
  return cameraAt(eye, target, 52.0, options);
}

Camera fixedCamera(const SnapshotOptions& options) {
  const FixedCamera& fixed = options.fixed;
  const double distance = (fixed.eye - fixed.target).norm();
  require(distance >= 0.01 && distance <= 1e6, "the distance of FixedCamera's eye from its target",
          distance, "lie in 0.01 m to 1000 km");
  require(fixed.fieldOfView >= 1.0 && fixed.fieldOfView <= 120.0, "FixedCamera::fieldOfView",
          fixed.fieldOfView, "lie in 1° to 120°");
  return cameraAt(fixed.eye, fixed.target, fixed.fieldOfView, options);
}

Camera orbitCamera(const Recording& recording, const RunExcerpt& run,
                   const SnapshotOptions& options) {
  const OrbitCamera& orbit = options.orbit;
  require(std::isfinite(orbit.angle), "OrbitCamera::angle", orbit.angle, "be finite");
  require(orbit.elevation >= 1.0 && orbit.elevation <= 89.0, "OrbitCamera::elevation",
          orbit.elevation, "lie in 1° to 89°");
  require(orbit.distance >= 1.0 && orbit.distance <= 10000.0, "OrbitCamera::distance",
          orbit.distance, "lie in 1 m to 10000 m");
  const DrawnImpact* impact = hardest(run);
  Vector3d centre;
  if (orbit.centre) {
    centre = *orbit.centre;
    require(centre.allFinite(), "OrbitCamera::centre", centre.sum(), "be finite");
  } else if (orbit.around == OrbitCamera::Around::hardest_impact && impact != nullptr) {
    centre = impact->event.contact;
  } else {
    centre = poseNear(followed(recording, orbit.vehicle), run.now).position;
  }
  Camera camera = cameraAt(eyeOf(orbit, centre), centre, 32.0, options);
  // What is seen is lit.
  const Vector3d side = horizontal(camera.eye - centre, Vector3d::UnitX());
  camera.sun =
      (0.45 * side + 0.40 * side.cross(Vector3d::UnitZ()) + 0.80 * Vector3d::UnitZ()).normalized();
  return camera;
}

}  // namespace

Eigen::Vector4d Camera::clip(const Vector3d& point) const {
  return projection * (axes * (point - eye)).homogeneous();
}

std::optional<Vector2d> Camera::pixel(const Vector3d& point) const {
  const Eigen::Vector4d p = clip(point);
  if (!(p.w() > 1e-9)) return {};
  return Vector2d(0.5 * width * (1.0 + p.x() / p.w()), 0.5 * height * (1.0 - p.y() / p.w()));
}

double Camera::pixelsPerMetre(const Vector3d& point) const {
  return 0.5 * height * projection(1, 1) / clip(point).w();
}

Vector3d Camera::towards(const Vector3d& point) const {
  return perspective ? Vector3d((eye - point).normalized()) : back();
}

Vector3d eyeOf(const OrbitCamera& orbit, const Vector3d& centre) {
  const double angle = orbit.angle * degree;
  const double elevated = orbit.elevation * degree;
  return centre + orbit.distance * Vector3d(std::cos(elevated) * std::cos(angle),
                                            std::cos(elevated) * std::sin(angle),
                                            std::sin(elevated));
}

Camera cameraFor(const SightLines& scene, const Recording& recording, const RunExcerpt& run,
                 const SnapshotOptions& options) {
  switch (options.view) {
    case SnapshotView::top:
      return topCamera(scene, recording, run, options);
    case SnapshotView::three_quarter:
      return threeQuarterCamera(scene, recording, run, options);
    case SnapshotView::chase:
      return chaseCamera(scene, recording, run, options);
    case SnapshotView::fixed:
      return fixedCamera(options);
    case SnapshotView::orbit:
      return orbitCamera(recording, run, options);
  }
  throw Error("SnapshotOptions::view is none of the views");
}

}  // namespace bumper::drawing
