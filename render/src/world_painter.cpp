#include "world_painter.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "speed_colours.h"
#include "vehicle_shape.h"

namespace bumper::drawing {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector3f;
using Eigen::Vector4d;

const Vector3f horizonColour(0.90F, 0.92F, 0.93F);
const Vector3f zenithColour(0.50F, 0.66F, 0.82F);
/// Walls in the top view: a vertical one shows nothing but its edges there.
const Vector3f wallColour(1.00F, 0.74F, 0.52F);
const Vector3f nowhereColour(0.82F, 0.84F, 0.82F);  ///< where there is no scene

/// As walls are told from the ground: |vertical component of the unit normal|.
constexpr double uprightLimit = 0.3;
/// An edge is drawn where surfaces meet at more than about 25°.
constexpr double smoothCosine = 0.9;

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

Colour opaque(const Vector3f& colour) { return {colour.x(), colour.y(), colour.z(), 1.0F}; }

Vector3d normalOf(const std::array<Vector3d, 3>& c) {
  const Vector3d product = (c[1] - c[0]).cross(c[2] - c[0]);
  const double size = product.norm();
  return size > 0.0 ? Vector3d(product / size) : Vector3d::Zero();
}

std::array<Vector3d, 3> cornersOf(const Scene& scene, const Scene::Triangle& triangle) {
  return {scene.corner(triangle, 0), scene.corner(triangle, 1), scene.corner(triangle, 2)};
}

struct Edge {
  Vector3d firstNormal = Vector3d::Zero();
  int faces = 0;
  bool sharp = false;
  bool upright = false;
  std::uint32_t mesh = 0;
  Vector3d from;
  Vector3d to;
};

/// The edges of upright surfaces where they end or turn.
std::vector<Edge> edgesOf(const Scene& scene) {
  // Vertices of one place are one, whether or not the file shares them.
  const auto before = [&](std::uint32_t a, std::uint32_t b) {
    const Vector3d& p = scene.vertices[a];
    const Vector3d& q = scene.vertices[b];
    return std::lexicographical_compare(p.begin(), p.end(), q.begin(), q.end());
  };
  std::map<std::uint32_t, std::uint32_t, decltype(before)> places(before);
  const auto placeOf = [&](std::uint32_t corner) {
    return places.try_emplace(corner, corner).first->second;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, Edge> edges;
  for (const Scene::Triangle& triangle : scene.triangles) {
    const Vector3d normal = normalOf(cornersOf(scene, triangle));
    const bool upright = std::abs(normal.z()) < uprightLimit;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = placeOf(triangle.corners[k]);
      const std::uint32_t b = placeOf(triangle.corners[(k + 1) % 3]);
      Edge& edge = edges[std::minmax(a, b)];
      if (edge.faces++ == 0) {
        edge.firstNormal = normal;
        edge.from = scene.vertices[a];
        edge.to = scene.vertices[b];
      } else if (std::abs(edge.firstNormal.dot(normal)) < smoothCosine) {
        edge.sharp = true;
      }
      if (upright) {
        edge.upright = true;
        edge.mesh = triangle.mesh;
      }
    }
  }
  std::vector<Edge> result;
  for (const auto& [ends, edge] : edges) {
    if (edge.upright && (edge.sharp || edge.faces == 1)) result.push_back(edge);
  }
  return result;
}

}  // namespace

Vector3f paintOf(std::size_t vehicle) {
  static const std::array<Vector3f, 5> paints = {
      Vector3f(0.86F, 0.14F, 0.13F), Vector3f(0.15F, 0.36F, 0.80F), Vector3f(0.95F, 0.55F, 0.10F),
      Vector3f(0.45F, 0.20F, 0.62F), Vector3f(0.10F, 0.52F, 0.45F)};
  return paints[vehicle % paints.size()];
}

WorldPainter::WorldPainter(const Camera& camera, Picture& picture)
    : camera_(camera), picture_(picture) {
  picture_.width = camera.width;
  picture_.height = camera.height;
  picture_.gridSpacing = std::max(1.0, roundedDown(0.45 * camera.extent));
  // A multiple of the grid, so that its lines stand at round world coordinates.
  picture_.origin = (camera.focus / picture_.gridSpacing).array().round() * picture_.gridSpacing;
  if (camera.perspective) {
    picture_.hazeColour = horizonColour;
    picture_.hazeStart = camera.hazeStart;
    picture_.hazeEnd = camera.hazeEnd;
  }
  setSun();
  addBackground();
}

void WorldPainter::setSun() {
  // A square map around what the camera is about.
  const double radius = camera_.perspective ? 3.0 * camera_.extent + 10.0 : 1.05 * camera_.extent;
  const double depth = 2.0 * radius + 200.0;
  Eigen::Matrix3d axes;
  axes.row(0) = Vector3d::UnitZ().cross(camera_.sun).normalized();
  axes.row(1) = camera_.sun.cross(Vector3d(axes.row(0)));
  axes.row(2) = -camera_.sun;
  const Vector3d scale(1.0 / radius, 1.0 / radius, 1.0 / depth);
  Eigen::Matrix4d view = Eigen::Matrix4d::Identity();
  view.topLeftCorner<3, 3>() = scale.asDiagonal() * axes;
  view.topRightCorner<3, 1>() = view.topLeftCorner<3, 3>() * (picture_.origin - camera_.focus);
  picture_.sunView = view.cast<float>();
}

void WorldPainter::addBackground() {
  struct Stop {
    double y;  ///< clip space
    Vector3f colour;
  };
  std::vector<Stop> stops = {{-1.0, nowhereColour}, {1.0, nowhereColour}};
  if (camera_.perspective) {
    // The horizon is where horizontal directions end.
    const Vector3d ahead =
        Vector3d(-camera_.back().x(), -camera_.back().y(), 0.0).stableNormalized();
    const Vector4d far = camera_.projection *
                         (camera_.axes * ahead).homogeneous().cwiseProduct(Vector4d(1, 1, 1, 0));
    const double horizon = far.y() / far.w();
    stops = {{std::min(-1.0, horizon - 2.0), nowhereColour},
             {horizon, horizonColour},
             {horizon + 1.6, zenithColour}};
  }
  for (std::size_t k = 1; k < stops.size(); ++k) {
    const auto corner = [&](double x, const Stop& stop) {
      Vertex vertex;
      vertex.clip = {static_cast<float>(x), static_cast<float>(stop.y), 0.0F, 1.0F};
      vertex.colour = {stop.colour.x(), stop.colour.y(), stop.colour.z(), 1.0F};
      return vertex;
    };
    const Stop& low = stops[k - 1];
    const Stop& high = stops[k];
    picture_.background.insert(picture_.background.end(),
                               {corner(-1, low), corner(1, low), corner(1, high), corner(-1, low),
                                corner(1, high), corner(-1, high)});
  }
}

Vertex WorldPainter::vertexAt(const Vector3d& point, const Colour& colour,
                              const Lighting& lighting) const {
  const Eigen::Vector4f clip = camera_.clip(point).cast<float>();
  const Vector3f world = (point - picture_.origin).cast<float>();
  return {{clip.x(), clip.y(), clip.z(), clip.w()},
          {colour.x(), colour.y(), colour.z(), colour.w()},
          {world.x(), world.y(), world.z()},
          lighting};
}

Lighting WorldPainter::lightingOf(const Corners& corners) const {
  Vector3d normal = normalOf(corners);
  // Files do not always say which side is out: the side that is seen is.
  const Vector3d centre = (corners[0] + corners[1] + corners[2]) / 3.0;
  if (normal.dot(camera_.towards(centre)) < 0.0) normal = -normal;
  Lighting lighting;
  lighting.ambient = static_cast<float>(0.60 + 0.10 * normal.z());
  lighting.sun = static_cast<float>(0.46 * std::max(0.0, normal.dot(camera_.sun)));
  return lighting;
}

void WorldPainter::addLit(const Corners& corners, const Colour& colour, float grid,
                          Triangles& into) const {
  Lighting lighting = lightingOf(corners);
  lighting.grid = grid;
  for (const Vector3d& corner : corners) into.push_back(vertexAt(corner, colour, lighting));
}

void WorldPainter::addShadow(const Corners& corners) {
  for (const Vector3d& corner : corners)
    picture_.casters.emplace_back((corner - picture_.origin).cast<float>());
}

void WorldPainter::addScene(const Scene& scene) {
  for (const Scene::Triangle& triangle : scene.triangles) {
    const Corners corners = cornersOf(scene, triangle);
    const bool upright = std::abs(normalOf(corners).z()) < uprightLimit;
    const bool tinted = upright && !camera_.perspective;
    const Colour colour = opaque(tinted ? wallColour : scene.meshes[triangle.mesh].colour);
    addLit(corners, colour, upright ? 0.0F : 1.0F, picture_.surfaces);
    if (upright) addShadow(corners);
  }
  for (const Edge& edge : edgesOf(scene)) {
    const Vector3f dark = 0.30F * scene.meshes[edge.mesh].colour;
    addEdge(edge.from, edge.to, opaque(camera_.perspective ? dark : wallColour));
  }
}

/// A line of constant width on the picture, a little nearer than the surface that it lies on.
void WorldPainter::addEdge(const Vector3d& from, const Vector3d& to, const Colour& colour) {
  Vector4d a = camera_.clip(from);
  Vector4d b = camera_.clip(to);
  // Cut off what lies before the near plane.
  const double insideA = a.z() + a.w();
  const double insideB = b.z() + b.w();
  if (insideA <= 0.0 && insideB <= 0.0) return;
  if (insideA < 0.0) a += (b - a) * (insideA / (insideA - insideB));
  if (insideB < 0.0) b += (a - b) * (insideB / (insideB - insideA));

  const Vector2d toPixels(0.5 * camera_.width, 0.5 * camera_.height);
  const Vector2d way = (b.head<2>() / b.w() - a.head<2>() / a.w()).cwiseProduct(toPixels);
  if (way.norm() < 1e-6) return;
  const Vector2d across = Vector2d(-way.y(), way.x()).normalized();
  const double fullWidth = std::max(0.9, camera_.height / (camera_.perspective ? 600.0 : 400.0));
  // Far lines become fainter instead of crowding.
  const auto end = [&](const Vector4d& p, double side) {
    const double pixelsPerMetre = 0.5 * camera_.height * camera_.projection(1, 1) / p.w();
    const double faint =
        std::clamp(pixelsPerMetre / 7.0 - 0.2, camera_.perspective ? 0.0 : 0.6, 1.0);
    Vector4d moved = p;
    moved.head<2>() += (0.5 * fullWidth * side * across).cwiseQuotient(toPixels) * p.w();
    moved.z() -= (camera_.perspective ? 4e-4 : 1e-3) * p.w();
    Vertex vertex;
    for (std::size_t k = 0; k < 4; ++k) {
      vertex.clip[k] = static_cast<float>(moved[static_cast<Eigen::Index>(k)]);
      vertex.colour[k] = colour[static_cast<Eigen::Index>(k)];
    }
    vertex.colour[3] = static_cast<float>(faint);
    return vertex;
  };
  const Vertex aLeft = end(a, 1.0);
  const Vertex aRight = end(a, -1.0);
  const Vertex bLeft = end(b, 1.0);
  const Vertex bRight = end(b, -1.0);
  picture_.outlines.insert(picture_.outlines.end(), {aRight, bRight, bLeft, aRight, bLeft, aLeft});
}

/// A vehicle that would be a few pixels long, as an arrowhead that can be seen.
void WorldPainter::addFarMarker(const DrawnPose& drawn, const Colour& colour) {
  const double size = arrowheadPixels / camera_.pixelsPerMetre(drawn.pose.position);
  const auto at = [&](double along, double across) {
    return vertexAt(
        drawn.pose.position + drawn.pose.orientation * Vector3d(along, across, 0) * size, colour,
        {});
  };
  const Vertex nose = at(0.6, 0.0);
  const Vertex notch = at(-0.2, 0.0);
  auto& into = drawn.last ? picture_.vehicles : picture_.ghosts;
  into.insert(into.end(), {nose, at(-0.4, 0.38), notch, nose, notch, at(-0.4, -0.38)});
}

void WorldPainter::addVehicles(const Recording& recording, const RunExcerpt& run) {
  for (const DrawnPose& drawn : run.poses) {
    const VehicleParameters& vehicle = recording.vehicles()[drawn.vehicle].parameters;
    const Vector3f paint = paintOf(drawn.vehicle);
    const auto tint = [&](const Vector3f& colour) {
      if (drawn.last) return opaque(colour);
      Colour pale = opaque(colour + ghostPaleness * (Vector3f::Ones() - colour));
      pale.w() = ghostOpacity;
      return pale;
    };
    const double length = vehicle.massCentreToFront + vehicle.massCentreToRear;
    if (!camera_.pixel(drawn.pose.position)) continue;
    if (length * camera_.pixelsPerMetre(drawn.pose.position) < leastVehiclePixels) {
      addFarMarker(drawn, tint(paint));
      continue;
    }
    for (const ShapeTriangle& triangle : vehicleShape(vehicle, paint)) {
      Corners corners;
      for (std::size_t k = 0; k < 3; ++k)
        corners[k] = drawn.pose.position + drawn.pose.orientation * triangle.corners[k];
      addLit(corners, tint(triangle.colour), 0.0F,
             drawn.last ? picture_.vehicles : picture_.ghosts);
      if (drawn.last) addShadow(corners);
    }
  }
}

void WorldPainter::addPath(const RecordedVehicle& vehicle, const std::vector<RecordedPose>& path,
                           double fastest) {
  if (path.size() < 2) return;
  struct Station {
    Vertex left;
    Vertex right;
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
    Colour colour = opaque(speedColour(path[k].velocity.norm() / fastest));
    const auto side = [&](const Vector3d& point) {
      Vertex vertex = vertexAt(point, colour, {});
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
    picture_.ribbons.insert(picture_.ribbons.end(),
                            {a.right, b.right, b.left, a.right, b.left, a.left});
  }
}

}  // namespace bumper::drawing
