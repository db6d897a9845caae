#include "wall_table.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace bumper {

namespace {

using Place = std::array<double, 3>;

struct PlaceHash {
  std::size_t operator()(const Place& place) const {
    std::uint64_t value = 0;
    for (const double coordinate : place) {
      value = (value ^ std::bit_cast<std::uint64_t>(coordinate)) * 0x9E3779B97F4A7C15ULL;
      value ^= value >> 29U;
    }
    return static_cast<std::size_t>(value);
  }
};

}  // namespace

float roundedDown(double value) {
  const auto rounded = static_cast<float>(value);
  return static_cast<double>(rounded) <= value
             ? rounded
             : std::nextafter(rounded, -std::numeric_limits<float>::infinity());
}

float roundedUp(double value) { return -roundedDown(-value); }

// Single precision is fine enough as long as nothing is much further from the origin than the walls
// extend; with the world's own origin no coordinate is rounded.
void WallTable::chooseOrigin(const std::vector<Wall>& walls) {
  Eigen::Vector3d low = walls.front().corners[0];
  Eigen::Vector3d high = low;
  for (const Wall& wall : walls) {
    for (const Eigen::Vector3d& corner : wall.corners) {
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
  }
  const Eigen::Vector3d middle = 0.5 * (low + high);
  const bool isNear = middle.norm() <= std::max((high - low).norm(), 100.0);
  origin_ = isNear ? Eigen::Vector3d::Zero().eval() : middle.array().round().matrix().eval();
}

WallTable::WallTable(const std::vector<Wall>& walls, const Scene& scene) {
  if (walls.empty()) return;
  chooseOrigin(walls);
  records_.reserve(walls.size());
  indices_.reserve(3 * walls.size());
  std::unordered_map<Place, dTriIndex, PlaceHash> known;
  known.reserve(walls.size());
  for (const Wall& wall : walls) {
    for (const Eigen::Vector3d& corner : wall.corners) {
      // Adding zero turns -0 into +0, which hash differently.
      const Eigen::Vector3d local = (corner - origin_).array() + 0.0;
      const Place place{local.x(), local.y(), local.z()};
      const auto number = static_cast<dTriIndex>(vertices_.size() / 3);
      const auto [entry, isNew] = known.emplace(place, number);
      if (isNew) vertices_.insert(vertices_.end(), place.begin(), place.end());
      indices_.push_back(entry->second);
    }
    const std::uint32_t mesh = scene.triangles[static_cast<std::size_t>(wall.triangle)].mesh;
    const bool goesOn = !runs_.empty() && runs_.back().mesh == mesh &&
                        triangle(records_.size() - 1) + 1 == wall.triangle;
    if (!goesOn) {
      runs_.push_back({static_cast<std::uint32_t>(records_.size()), mesh, wall.triangle});
    }
    records_.push_back({roundedDown(wall.foot - origin_.z()), roundedUp(wall.top - origin_.z())});
  }
  vertices_.shrink_to_fit();
  runs_.shrink_to_fit();
  findFaces();
}

Eigen::Vector3d WallTable::corner(std::size_t wall, std::size_t k) const {
  const double* vertex = &vertices_[3 * static_cast<std::size_t>(indices_[3 * wall + k])];
  return origin_ + Eigen::Vector3d(vertex[0], vertex[1], vertex[2]);
}

Wall WallTable::operator[](std::size_t wall) const {
  Wall result;
  for (std::size_t k = 0; k < 3; ++k) result.corners[k] = corner(wall, k);
  const auto& [a, b, c] = result.corners;
  result.normal = (b - a).cross(c - a).normalized();
  result.triangle = triangle(wall);
  result.foot = foot(wall);
  result.top = top(wall);
  return result;
}

double WallTable::foot(std::size_t wall) const {
  return origin_.z() + static_cast<double>(records_[wall].foot);
}

double WallTable::top(std::size_t wall) const {
  return origin_.z() + static_cast<double>(records_[wall].top);
}

// Each face takes up as many of the walls that follow as it can.
void WallTable::findFaces() {
  for (std::size_t first = 0; first < size();) {
    faces_.push_back(static_cast<std::uint32_t>(first));
    const std::uint32_t mesh = meshOf(first);
    WallFace face((*this)[first]);
    for (++first; first < size() && meshOf(first) == mesh && face.add((*this)[first]);) ++first;
  }
  faces_.shrink_to_fit();
}

WallTable::Stretch WallTable::faceOf(std::size_t wall) const {
  const auto next = std::upper_bound(faces_.begin(), faces_.end(), wall);
  return {*(next - 1), next == faces_.end() ? size() : *next};
}

WallFace WallTable::face(const Stretch& walls) const {
  WallFace face((*this)[walls.first]);
  for (std::size_t wall = walls.first + 1; wall < walls.last; ++wall) face.add((*this)[wall]);
  return face;
}

std::size_t WallTable::wallAt(const Stretch& walls, const Eigen::Vector3d& point) const {
  std::size_t best = walls.first;
  double deepest = -std::numeric_limits<double>::infinity();
  for (std::size_t number = walls.first; number < walls.last && deepest < 0.0; ++number) {
    const Wall wall = (*this)[number];
    // How far inside all three sides it is.
    double inside = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d side = wall.corners[(k + 1) % 3] - wall.corners[k];
      const Eigen::Vector3d inwards = wall.normal.cross(side).normalized();
      inside = std::min(inside, inwards.dot(point - wall.corners[k]));
    }
    if (inside <= deepest) continue;
    deepest = inside;
    best = number;
  }
  return best;
}

const WallTable::Run& WallTable::runOf(std::size_t wall) const {
  const auto next =
      std::upper_bound(runs_.begin(), runs_.end(), wall,
                       [](std::size_t wanted, const Run& run) { return wanted < run.firstWall; });
  return *(next - 1);
}

std::uint32_t WallTable::meshOf(std::size_t wall) const { return runOf(wall).mesh; }

int WallTable::triangle(std::size_t wall) const {
  const Run& run = runOf(wall);
  return run.firstTriangle + static_cast<int>(wall - run.firstWall);
}

std::size_t WallTable::memory() const {
  return vertices_.capacity() * sizeof(double) + indices_.capacity() * sizeof(dTriIndex) +
         records_.capacity() * sizeof(Record) + runs_.capacity() * sizeof(Run) +
         faces_.capacity() * sizeof(std::uint32_t);
}

}  // namespace bumper
