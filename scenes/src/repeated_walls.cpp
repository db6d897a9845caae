#include "repeated_walls.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "weld.h"

namespace bumper {

namespace {

void keepOnly(const std::vector<bool>& dropped, std::vector<Wall>& walls,
              std::vector<Corners>& corners) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    if (dropped[i]) continue;
    walls[kept] = walls[i];
    corners[kept++] = corners[i];
  }
  walls.resize(kept);
  corners.resize(kept);
}

/// A wall at one of its edges.
struct Edge {
  std::uint32_t low;  ///< the edge's corners
  std::uint32_t high;
  std::uint32_t wall;
  std::uint32_t opposite;  ///< which of the wall's corners the edge does not touch
};

std::vector<Edge> sortedEdges(const std::vector<Corners>& corners) {
  std::vector<Edge> edges;
  edges.reserve(3 * corners.size());
  for (std::uint32_t i = 0; i < corners.size(); ++i) {
    // Two corners of a sliver may count as one: it is half of no quad.
    const auto [a, b, c] = corners[i];
    if (a == b || b == c || c == a) continue;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(corners[i].at((k + 1) % 3), corners[i].at((k + 2) % 3));
      edges.push_back({low, high, i, k});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::tie(a.low, a.high, a.wall) < std::tie(b.low, b.high, b.wall);
  });
  return edges;
}

/// Two walls that share an edge, and the corners that they do not share.
struct Pair {
  Edge first;
  Edge second;
};

/// Whether two walls make a plane convex quad, which its other diagonal would cut into two as well.
bool isPlaneQuad(const std::vector<Wall>& walls, const Pair& pair) {
  const Wall& wall = walls[pair.first.wall];
  const Eigen::Vector3d& r = wall.corners.at(pair.first.opposite);
  const Eigen::Vector3d& p = wall.corners.at((pair.first.opposite + 1) % 3);
  const Eigen::Vector3d& q = wall.corners.at((pair.first.opposite + 2) % 3);
  const Eigen::Vector3d& s = walls[pair.second.wall].corners.at(pair.second.opposite);
  if (std::abs(wall.normal.dot(s - p)) > weldDistance) return false;
  const auto side = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                        const Eigen::Vector3d& point) {
    return (to - from).cross(point - from).dot(wall.normal);
  };
  return side(p, q, r) * side(p, q, s) < 0.0 && side(r, s, p) * side(r, s, q) < 0.0;
}

/// At an edge where more walls meet than this, no quads are looked for: each could be half of one
/// with any other.
constexpr std::ptrdiff_t mostAtAnEdge = 8;

std::vector<Pair> planeQuads(const std::vector<Wall>& walls, const std::vector<Corners>& corners) {
  const std::vector<Edge> edges = sortedEdges(corners);
  std::vector<Pair> quads;
  for (auto first = edges.begin(); first != edges.end();) {
    const auto last = std::find_if(first, edges.end(), [&](const Edge& edge) {
      return edge.low != first->low || edge.high != first->high;
    });
    if (last - first <= mostAtAnEdge) {
      for (auto one = first; one != last; ++one) {
        for (auto other = one + 1; other != last; ++other) {
          if (isPlaneQuad(walls, {*one, *other})) quads.push_back({*one, *other});
        }
      }
    }
    first = last;
  }
  std::sort(quads.begin(), quads.end(), [](const Pair& a, const Pair& b) {
    return std::tie(a.first.wall, a.second.wall) < std::tie(b.first.wall, b.second.wall);
  });
  return quads;
}

}  // namespace

void dropRepeated(std::vector<Wall>& walls, std::vector<Corners>& corners, WallReport& report) {
  TriangleTable table(walls.size());
  std::vector<bool> dropped(walls.size(), false);
  for (std::size_t i = 0; i < walls.size(); ++i) {
    dropped[i] = !table.insert(sorted(corners[i]));
    report.droppedDuplicate += dropped[i] ? 1 : 0;
  }
  // From here on a wall's place is its number in the table.
  keepOnly(dropped, walls, corners);

  // A quad that is kept covers whatever else is made of its corners.
  dropped.assign(walls.size(), false);
  for (const auto& [first, second] : planeQuads(walls, corners)) {
    if (dropped[first.wall] || dropped[second.wall]) continue;
    const std::uint32_t r = corners[first.wall].at(first.opposite);
    const std::uint32_t s = corners[second.wall].at(second.opposite);
    for (const std::uint32_t end : {first.low, first.high}) {
      const std::uint32_t other = table.find(sorted({r, s, end}));
      if (other == noIndex || dropped[other]) continue;
      dropped[other] = true;
      ++report.droppedRetriangulated;
    }
  }
  keepOnly(dropped, walls, corners);
}

}  // namespace bumper
