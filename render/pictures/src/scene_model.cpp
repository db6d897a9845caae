#include "scene_model.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "bumper/response/error.h"

namespace bumper::drawing {

namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using Corners = std::array<Vector3d, 3>;

/// As walls are told from the ground: |vertical component of the unit normal|.
constexpr double uprightLimit = 0.3;
/// An edge is drawn where surfaces meet at more than about 25°.
constexpr double smoothCosine = 0.9;
/// What lies outside of a picture is left out in pieces of about this size.
constexpr double trianglesPerPart = 400.0;
constexpr float edgeDarkness = 0.30F;

Vector3d normalOf(const Corners& c) { return (c[1] - c[0]).cross(c[2] - c[0]).stableNormalized(); }

bool isUpright(const Vector3d& normal) { return std::abs(normal.z()) < uprightLimit; }

std::array<float, 3> asFloats(const Vector3d& point) {
  return {static_cast<float>(point.x()), static_cast<float>(point.y()),
          static_cast<float>(point.z())};
}

std::array<std::uint8_t, 4> asBytes(const Vector3f& colour, bool ground) {
  const auto byte = [](float share) {
    return static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(share, 0.0F, 1.0F)));
  };
  return {byte(colour.x()), byte(colour.y()), byte(colour.z()),
          static_cast<std::uint8_t>(ground ? 255 : 0)};
}

/// The number of the first vertex at the same place, for each vertex: files need not share them.
std::vector<std::uint32_t> placesOf(const Scene& scene) {
  std::vector<std::uint32_t> order(scene.vertices.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto before = [&](std::uint32_t a, std::uint32_t b) {
    const Vector3d& p = scene.vertices[a];
    const Vector3d& q = scene.vertices[b];
    if (p == q) return a < b;
    return std::lexicographical_compare(p.begin(), p.end(), q.begin(), q.end());
  };
  std::ranges::sort(order, before);
  std::vector<std::uint32_t> places(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool same = k > 0 && scene.vertices[order[k]] == scene.vertices[order[k - 1]];
    places[order[k]] = same ? places[order[k - 1]] : order[k];
  }
  return places;
}

/// One side of a triangle.
struct Side {
  std::pair<std::uint32_t, std::uint32_t> ends;  ///< places, the lower first
  std::uint32_t triangle = 0;
};

struct Edge {
  Vector3d from;
  Vector3d to;
  std::uint32_t mesh = 0;
};

/// The edges of upright surfaces where they end or turn.
std::vector<Edge> edgesOf(const Scene& scene, const std::vector<Vector3d>& normals) {
  const std::vector<std::uint32_t> places = placesOf(scene);
  std::vector<Side> sides;
  sides.reserve(3 * scene.triangles.size());
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    const auto& corners = scene.triangles[t].corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = places[corners[k]];
      const std::uint32_t b = places[corners[(k + 1) % 3]];
      sides.push_back({{std::min(a, b), std::max(a, b)}, t});
    }
  }
  std::ranges::sort(sides, [](const Side& a, const Side& b) {
    return std::pair(a.ends, a.triangle) < std::pair(b.ends, b.triangle);
  });
  std::vector<Edge> edges;
  for (auto side = sides.begin(); side != sides.end();) {
    const auto last = std::find_if(side, sides.end(),
                                   [&](const Side& other) { return other.ends != side->ends; });
    const Side* upright = nullptr;
    bool sharp = last - side == 1;
    for (auto each = side; each != last; ++each) {
      const Vector3d& normal = normals[each->triangle];
      if (isUpright(normal)) upright = &*each;
      sharp = sharp || std::abs(normals[side->triangle].dot(normal)) < smoothCosine;
    }
    if (upright != nullptr && sharp) {
      edges.push_back({scene.vertices[side->ends.first], scene.vertices[side->ends.second],
                       scene.triangles[upright->triangle].mesh});
    }
    side = last;
  }
  return edges;
}

/// Squares of the ground plan.
class Squares {
 public:
  Squares(const Eigen::AlignedBox3d& box, std::size_t triangles)
      : corner_(box.min()),
        aside_(static_cast<std::size_t>(
            std::ceil(std::sqrt(static_cast<double>(triangles) / trianglesPerPart)))),
        side_(std::max(box.sizes().head<2>().maxCoeff(), 1e-3) / static_cast<double>(aside_)) {}

  [[nodiscard]] std::size_t count() const { return aside_ * aside_; }

  [[nodiscard]] std::size_t at(const Vector3d& point) const {
    const auto step = [&](double way) {
      return std::min(static_cast<std::size_t>(std::max(0.0, way / side_)), aside_ - 1);
    };
    return step(point.x() - corner_.x()) + aside_ * step(point.y() - corner_.y());
  }

 private:
  Vector3d corner_;
  std::size_t aside_;
  double side_;
};

void addEdge(const Edge& edge, const Vector3d& origin, const Vector3f& colour,
             std::vector<EdgeVertex>& into) {
  static constexpr std::array<std::array<float, 2>, 6> corners = {
      {{0.0F, -1.0F}, {1.0F, -1.0F}, {1.0F, 1.0F}, {0.0F, -1.0F}, {1.0F, 1.0F}, {0.0F, 1.0F}}};
  for (const auto& corner : corners) {
    into.push_back({asFloats(edge.from - origin), asFloats(edge.to - origin), corner,
                    asBytes(edgeDarkness * colour, false)});
  }
}

}  // namespace

void addSurface(const Corners& corners, const Vector3f& colour, bool ground,
                std::vector<SurfaceVertex>& into) {
  const auto normal = asFloats(normalOf(corners));
  for (const Vector3d& corner : corners)
    into.push_back({asFloats(corner), normal, asBytes(colour, ground)});
}

SceneModel sceneModel(const Scene& scene) {
  // OpenGL counts vertices in 31 bits; a triangle has up to 18 with its edges.
  constexpr std::size_t most = std::numeric_limits<std::int32_t>::max() / 18;
  if (scene.triangles.size() > most)
    throw Error("a picture of " + std::to_string(scene.triangles.size()) +
                " triangles: the most are " + std::to_string(most));
  SceneModel model;
  Eigen::AlignedBox3d box;
  std::vector<Corners> triangles;
  std::vector<Vector3d> normals;
  for (const Scene::Triangle& triangle : scene.triangles) {
    triangles.push_back(
        {scene.corner(triangle, 0), scene.corner(triangle, 1), scene.corner(triangle, 2)});
    normals.push_back(normalOf(triangles.back()));
    for (const Vector3d& corner : triangles.back()) box.extend(corner);
  }
  model.origin = box.center().array().round();
  const std::vector<Edge> edges = edgesOf(scene, normals);

  const Squares squares(box, triangles.size());
  std::vector<std::vector<std::size_t>> trianglesIn(squares.count());
  std::vector<std::vector<std::size_t>> edgesIn(squares.count());
  for (std::size_t k = 0; k < triangles.size(); ++k)
    trianglesIn[squares.at((triangles[k][0] + triangles[k][1] + triangles[k][2]) / 3.0)].push_back(
        k);
  for (std::size_t k = 0; k < edges.size(); ++k)
    edgesIn[squares.at(0.5 * (edges[k].from + edges[k].to))].push_back(k);

  for (std::size_t square = 0; square < squares.count(); ++square) {
    SceneModel::Part part;
    part.surfaces.first = model.surfaces.size();
    part.edges.first = model.edges.size();
    for (const std::size_t k : trianglesIn[square]) {
      Corners corners = triangles[k];
      for (Vector3d& corner : corners) {
        corner -= model.origin;
        part.box.extend(corner);
      }
      const bool upright = isUpright(normals[k]);
      addSurface(corners, scene.meshes[scene.triangles[k].mesh].colour, !upright, model.surfaces);
      if (upright) {
        for (const Vector3d& corner : corners) model.casters.push_back(asFloats(corner));
        ++part.casters;
      }
    }
    for (const std::size_t k : edgesIn[square]) {
      part.box.extend(edges[k].from - model.origin);
      part.box.extend(edges[k].to - model.origin);
      addEdge(edges[k], model.origin, scene.meshes[edges[k].mesh].colour, model.edges);
    }
    part.surfaces.count = model.surfaces.size() - part.surfaces.first;
    part.edges.count = model.edges.size() - part.edges.first;
    if (part.surfaces.count + part.edges.count > 0) model.parts.push_back(part);
  }
  return model;
}

}  // namespace bumper::drawing
