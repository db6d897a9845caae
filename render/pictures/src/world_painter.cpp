#include "world_painter.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <vector>

#include "scene_model.h"
#include "speed_colours.h"
#include "vehicle_shape.h"

namespace bumper::drawing {

namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using Eigen::Vector4d;

const Vector3f horizonColour(0.90F, 0.92F, 0.93F);
const Vector3f zenithColour(0.50F, 0.66F, 0.82F);
/// Walls in the top view: a vertical one shows nothing but its edges there.
const Colour wallColour(1.00F, 0.74F, 0.52F, 1.0F);
const Vector3f nowhereColour(0.82F, 0.84F, 0.82F);  ///< where there is no scene

constexpr double ribbonWidth = 0.7;        ///< m …
constexpr double ribbonLeastPixels = 4.0;  ///< … but at least
constexpr double ribbonAboveGround = 0.02;
/// m by which a ribbon counts as nearer to the camera, so that uneven ground does not hide it; less
/// than from the path of a vehicle to the wall that it slides along.
constexpr double ribbonNearer = 0.5;
/// Below this length on the picture, pixels, a vehicle is drawn as an arrowhead …
constexpr double leastVehiclePixels = 12.0;
constexpr double arrowheadPixels = 15.0;  ///< … of this length

constexpr float ghostOpacity = 0.72F;
constexpr float ghostPaleness = 0.45F;

Colour withOpacity(const Vector3f& colour, float opacity) {
  return {colour.x(), colour.y(), colour.z(), opacity};
}

/// Whether nothing between the vertices can be seen: all lie beyond one side of the picture.
bool isOutside(std::initializer_list<FlatVertex> vertices) {
  for (const std::size_t axis : {0U, 1U}) {
    for (const float sign : {-1.0F, 1.0F}) {
      const auto isBeyond = [&](const FlatVertex& vertex) {
        return sign * vertex.clip.at(axis) > vertex.clip[3];
      };
      if (std::ranges::all_of(vertices, isBeyond)) return true;
    }
  }
  return false;
}

}  // namespace

WorldPainter::WorldPainter(const Camera& camera, Picture& picture)
    : camera_(camera), picture_(picture) {
  picture_.width = camera.width;
  picture_.height = camera.height;
  picture_.perspective = camera.perspective;
  picture_.gridSpacing = std::max(1.0, roundedDown(0.45 * camera.extent));
  picture_.localOrigin = camera.focus.array().round();
  Eigen::Matrix4d toCamera = Eigen::Matrix4d::Identity();
  toCamera.topLeftCorner<3, 3>() = camera.axes;
  toCamera.topRightCorner<3, 1>() = camera.axes * (picture_.localOrigin - camera.eye);
  picture_.localToClip = camera.projection * toCamera;
  picture_.pixelsPerMetre = 0.5 * camera.height * camera.projection(1, 1);
  picture_.sun = camera.sun;
  if (camera.perspective) {
    picture_.viewer << camera.eye - picture_.localOrigin, 1.0;
    picture_.edgeWidth = std::max(0.9, camera.height / 600.0);
    picture_.edgeNearer = 4e-4;
    picture_.hazeColour = horizonColour;
    picture_.hazeStart = camera.hazeStart;
    picture_.hazeEnd = camera.hazeEnd;
  } else {
    picture_.viewer << camera.back(), 0.0;
    picture_.wallTint = wallColour;
    picture_.edgeWidth = std::max(0.9, camera.height / 400.0);
    picture_.edgeFaintest = 0.6;
    picture_.edgeNearer = 1e-3;
  }
  setSun();
  addBackground();
}

void WorldPainter::setSun() {
  // A square map around what the camera is about.
  const double radius = camera_.perspective ? 1.6 * camera_.extent + 8.0 : 1.05 * camera_.extent;
  const double depth = 2.0 * radius + 200.0;
  Eigen::Matrix3d axes;
  axes.row(0) = Vector3d::UnitZ().cross(camera_.sun).normalized();
  axes.row(1) = camera_.sun.cross(Vector3d(axes.row(0)));
  axes.row(2) = -camera_.sun;
  const Vector3d scale(1.0 / radius, 1.0 / radius, 1.0 / depth);
  picture_.localToSun.topLeftCorner<3, 3>() = scale.asDiagonal() * axes;
  picture_.localToSun.topRightCorner<3, 1>() =
      picture_.localToSun.topLeftCorner<3, 3>() * (picture_.localOrigin - camera_.focus);
}

void WorldPainter::addBackground() {
  struct Stop {
    double y;  ///< clip space
    Vector3f colour;
  };
  std::vector<Stop> stops = {{-1.0, nowhereColour}, {1.0, nowhereColour}};
  const Vector3d flat(-camera_.back().x(), -camera_.back().y(), 0.0);
  // Seen from straight above there is no horizon.
  if (camera_.perspective && flat.norm() > 0.1) {
    // The horizon is where horizontal directions end.
    const Vector4d far =
        camera_.projection *
        (camera_.axes * flat.normalized()).homogeneous().cwiseProduct(Vector4d(1, 1, 1, 0));
    const double horizon = far.y() / far.w();
    stops = {{std::min(-1.0, horizon - 2.0), nowhereColour},
             {horizon, horizonColour},
             {horizon + 1.6, zenithColour},
             {std::max(1.0, horizon + 1.6), zenithColour}};
  }
  for (std::size_t k = 1; k < stops.size(); ++k) {
    const auto corner = [&](float x, const Stop& stop) {
      return FlatVertex{{x, static_cast<float>(stop.y), 1.0F, 1.0F},
                        {stop.colour.x(), stop.colour.y(), stop.colour.z(), 1.0F}};
    };
    const Stop& low = stops[k - 1];
    const Stop& high = stops[k];
    picture_.background.insert(picture_.background.end(),
                               {corner(-1, low), corner(1, low), corner(1, high), corner(-1, low),
                                corner(1, high), corner(-1, high)});
  }
}

FlatVertex WorldPainter::vertexAt(const Vector3d& point, const Colour& colour) const {
  const Eigen::Vector4f clip = camera_.clip(point).cast<float>();
  return {{clip.x(), clip.y(), clip.z(), clip.w()},
          {colour.x(), colour.y(), colour.z(), colour.w()}};
}

/// A vehicle that would be a few pixels long, as an arrowhead that can be seen.
void WorldPainter::addFarMarker(const DrawnPose& drawn, const Colour& colour) {
  const double size = arrowheadPixels / camera_.pixelsPerMetre(drawn.pose.position);
  const auto at = [&](double along, double across) {
    return vertexAt(
        drawn.pose.position + drawn.pose.orientation * Vector3d(along, across, 0) * size, colour);
  };
  const FlatVertex nose = at(0.6, 0.0);
  const FlatVertex notch = at(-0.2, 0.0);
  picture_.markers.insert(picture_.markers.end(),
                          {nose, at(-0.4, 0.38), notch, nose, notch, at(-0.4, -0.38)});
}

/// In the vehicle's frame.
Range WorldPainter::addBody(const RecordedVehicle& vehicle, std::size_t index,
                            const SnapshotOptions& options) {
  Range range{picture_.bodies.size(), 0};
  for (const ShapeTriangle& triangle : vehicleShape(vehicle, index, options.vehicleMeshes))
    addSurface(triangle.corners, triangle.colour, false, picture_.bodies);
  range.count = picture_.bodies.size() - range.first;
  return range;
}

void WorldPainter::addVehicles(const Recording& recording, const RunExcerpt& run,
                               const SnapshotOptions& options) {
  std::vector<std::optional<Range>> bodies(recording.vehicles().size());
  for (const DrawnPose& drawn : run.poses) {
    const RecordedVehicle& vehicle = recording.vehicles()[drawn.vehicle];
    const VehicleParameters& size = vehicle.parameters;
    const double length = std::max(size.massCentreToFront + size.massCentreToRear, size.width);
    const float paleness = drawn.last ? 0.0F : ghostPaleness;
    const float opacity = drawn.last ? 1.0F : ghostOpacity;
    if (!camera_.pixel(drawn.pose.position)) continue;
    if (length * camera_.pixelsPerMetre(drawn.pose.position) < leastVehiclePixels) {
      const Vector3f paint = paintOf(drawn.vehicle);
      addFarMarker(drawn, withOpacity(paint + paleness * (Vector3f::Ones() - paint), opacity));
      continue;
    }
    auto& model = bodies[drawn.vehicle];
    if (!model) model = addBody(vehicle, drawn.vehicle, options);
    Eigen::Affine3d toLocal = Eigen::Affine3d::Identity();
    toLocal.translate(drawn.pose.position - picture_.localOrigin).rotate(drawn.pose.orientation);
    picture_.drawnBodies.push_back({*model, toLocal.cast<float>(), paleness, opacity});
  }
}

void WorldPainter::addPath(const RecordedVehicle& vehicle, const std::vector<RecordedPose>& path,
                           double fastest) {
  if (path.size() < 2) return;
  struct Station {
    FlatVertex left;
    FlatVertex right;
  };
  std::vector<Station> stations;
  Vector3d ahead = Vector3d::UnitX();
  for (std::size_t k = 0; k < path.size(); ++k) {
    const Vector3d& before = path[k == 0 ? 0 : k - 1].position;
    const Vector3d& after = path[std::min(k + 1, path.size() - 1)].position;
    const Vector3d way(after.x() - before.x(), after.y() - before.y(), 0.0);
    if (way.norm() > 1e-6) ahead = way.normalized();
    const Vector3d onGround =
        path[k].position -
        Vector3d(0.0, 0.0, vehicle.parameters.massCentreHeight - ribbonAboveGround);
    double width = ribbonWidth;
    if (camera_.pixel(onGround))
      width = std::max(width, ribbonLeastPixels / camera_.pixelsPerMetre(onGround));
    const Vector3d across = 0.5 * width * Vector3d::UnitZ().cross(ahead);
    const Colour colour = withOpacity(speedColour(path[k].velocity.norm() / fastest), 1.0F);
    const auto side = [&](const Vector3d& point) {
      FlatVertex vertex = vertexAt(point, colour);
      const Vector4d nearer = camera_.clip(point + ribbonNearer * camera_.towards(point));
      if (nearer.w() > 0.0)
        vertex.clip[2] = static_cast<float>(nearer.z() / nearer.w()) * vertex.clip[3];
      return vertex;
    };
    stations.push_back({side(onGround + across), side(onGround - across)});
  }
  for (std::size_t k = 1; k < stations.size(); ++k) {
    const Station& a = stations[k - 1];
    const Station& b = stations[k];
    if (isOutside({a.left, a.right, b.left, b.right})) continue;
    picture_.ribbons.insert(picture_.ribbons.end(),
                            {a.right, b.right, b.left, a.right, b.left, a.left});
  }
}

}  // namespace bumper::drawing
