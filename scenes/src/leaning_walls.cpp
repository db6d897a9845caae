#include "leaning_walls.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>

#include "pieces.h"
#include "surface_grower.h"
#include "triangle.h"
#include "weld.h"

namespace bumper {

namespace {

/// A profile is followed so far to each side, m; what goes on beyond that is a hillside.
constexpr double farthest = 3.0;
constexpr int mostTriangles = 64;
constexpr std::size_t mostLooks = 64;

/// Parts that lean by less than 3° overhang nothing.
constexpr double leastOverhang = 0.05;

/// Least height of a profile for each metre of its depth: more than the steepest ramp has.
constexpr double steepProfile = 0.8;

/// What does not fold must rise by more than this, m, as high as the band begins, and be no flatter
/// than 45° itself, with room for the rounding of single precision.
constexpr double leastRise = 0.3;
constexpr double mostNormalUp = 0.708;

/// What reaches no higher than this, m, above the lowest point of a profile with upright parts is
/// the foot of these.
constexpr double highestFoot = 0.5;

/// Ground is no steeper than 44° and wider than this, m, on average.
constexpr double groundNormalUp = 0.72;
constexpr double groundWidth = 1.5;

/// A section through a surface.
struct Profile {
  double near = 0.0;  ///< along the slope, m
  double far = 0.0;
  double low = 0.0;  ///< m
  double high = 0.0;
  bool up = false;       ///< it has parts that face upwards …
  bool down = false;     ///< … and downwards, seen from the same side
  bool upright = false;  ///< it has parts that are walls by themselves
  bool ends = true;      ///< within `farthest`

  void include(double place, double height) {
    near = std::min(near, place);
    far = std::max(far, place);
    low = std::min(low, height);
    high = std::max(high, height);
  }
  [[nodiscard]] double rise() const { return high - low; }
  [[nodiscard]] double run() const { return far - near; }
  [[nodiscard]] bool isSteep() const { return ends && rise() >= steepProfile * run(); }
  [[nodiscard]] bool folds() const { return up && down; }
  /// Whether a part with its upper end at `top`, above the section's middle, is the foot of others.
  [[nodiscard]] bool hasFoot(double top) const { return upright && top <= low + highestFoot; }
};

class Profiler {
 public:
  Profiler(const std::vector<Wall>& surfaces, const std::vector<Corners>& corners,
           double maxNormalUp)
      : surfaces_(surfaces), corners_(corners), table_(corners), maxNormalUp_(maxNormalUp) {}

  [[nodiscard]] Profile through(std::uint32_t triangle) const {
    const Wall& wall = surfaces_[triangle];
    const Section section{.middle = (wall.corners[0] + wall.corners[1] + wall.corners[2]) / 3.0,
                          .along = facing(wall)};
    Profile profile;
    const double normalUp = wall.normal.z();
    profile.up = normalUp > leastOverhang;
    profile.down = normalUp < -leastOverhang;
    for (std::size_t edge = 0; edge < 3; ++edge) {
      if (section.crosses(wall, edge)) follow(triangle, edge, section, profile);
    }
    return profile;
  }

 private:
  /// A vertical plane.
  struct Section {
    Eigen::Vector3d middle;
    Eigen::Vector2d along;

    /// How far a corner is beside the plane; never 0.
    [[nodiscard]] double beside(const Eigen::Vector3d& corner) const {
      const Eigen::Vector2d away = corner.head<2>() - middle.head<2>();
      const double value = along.x() * away.y() - along.y() * away.x();
      return value == 0.0 ? 1e-300 : value;
    }
    /// Edge k is the one opposite corner k.
    [[nodiscard]] bool crosses(const Wall& wall, std::size_t edge) const {
      return (beside(wall.corners[(edge + 1) % 3]) < 0.0) !=
             (beside(wall.corners[(edge + 2) % 3]) < 0.0);
    }
    void include(const Wall& wall, std::size_t edge, Profile& profile) const {
      const Eigen::Vector3d& a = wall.corners[(edge + 1) % 3];
      const Eigen::Vector3d& b = wall.corners[(edge + 2) % 3];
      const double besideA = beside(a);
      const Eigen::Vector3d point = a + besideA / (besideA - beside(b)) * (b - a) - middle;
      profile.include(along.dot(point.head<2>()), point.z());
    }
  };

  struct Neighbour {
    std::uint32_t triangle = noIndex;
    std::size_t edge = 0;
    bool sameWay = false;  ///< it runs along the edge in the same direction: wound the other way
  };

  [[nodiscard]] Neighbour across(std::uint32_t triangle, std::size_t edge) const {
    const Corners& own = corners_[triangle];
    const std::uint32_t a = own.at((edge + 1) % 3);
    const std::uint32_t b = own.at((edge + 2) % 3);
    Neighbour found;
    const std::span<const std::uint32_t> walls = table_.wallsAt(a);
    // Of the walls around the corner of a large fan no more than so many.
    for (const std::uint32_t other : walls.first(std::min(walls.size(), mostLooks))) {
      if (other == triangle) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t from = corners_[other].at((k + 1) % 3);
        const std::uint32_t to = corners_[other].at((k + 2) % 3);
        if (!((from == a && to == b) || (from == b && to == a))) continue;
        // The same triangle once more is no neighbour.
        if (corners_[other].at(k) == own.at(edge)) continue;
        found = {.triangle = other, .edge = k, .sameWay = from == a};
      }
      if (found.triangle != noIndex) break;
    }
    return found;
  }

  /// Leaves a triangle by one of its edges and goes on to the surface's end.
  void follow(std::uint32_t start, std::size_t edge, const Section& section,
              Profile& profile) const {
    std::uint32_t triangle = start;
    double turned = 1.0;
    for (int i = 0;; ++i) {
      section.include(surfaces_[triangle], edge, profile);
      if (i == mostTriangles || profile.run() > farthest || profile.rise() > farthest) {
        profile.ends = false;
        return;
      }
      const Neighbour next = across(triangle, edge);
      if (next.triangle == noIndex || next.triangle == start) return;
      if (next.sameWay) turned = -turned;
      triangle = next.triangle;
      const Wall& wall = surfaces_[triangle];
      const double normalUp = turned * wall.normal.z();
      profile.up = profile.up || normalUp > leastOverhang;
      profile.down = profile.down || normalUp < -leastOverhang;
      profile.upright = profile.upright || std::abs(normalUp) <= maxNormalUp_;
      edge = next.edge;
      for (std::size_t k = 0; k < 3; ++k) {
        if (k == next.edge || !section.crosses(wall, k)) continue;
        edge = k;
        break;
      }
      if (edge == next.edge) return;
    }
  }

  const std::vector<Wall>& surfaces_;
  const std::vector<Corners>& corners_;
  WallsAtCorners table_;
  double maxNormalUp_;
};

/// Which triangles are connected with ground that a vehicle can drive on.
class GroundPieces {
 public:
  explicit GroundPieces(const Scene& scene)
      : scene_(scene), welded_(weld(scene.vertices)), pieces_(welded_.size()) {
    for (const Scene::Triangle& triangle : scene.triangles) {
      pieces_.join(cornerOf(triangle, 0), cornerOf(triangle, 1));
      pieces_.join(cornerOf(triangle, 0), cornerOf(triangle, 2));
    }
    std::vector<std::uint32_t> numbers(welded_.size(), noIndex);
    for (const Scene::Triangle& triangle : scene.triangles) {
      const TriangleCorners corners = cornersOf(scene, triangle);
      const Eigen::Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
      if (std::abs(normal.z()) < groundNormalUp * normal.norm()) continue;
      std::uint32_t& number = numbers[pieces_.find(cornerOf(triangle, 0))];
      if (number == noIndex) {
        number = static_cast<std::uint32_t>(extents_.size());
        extents_.emplace_back();
      }
      extents_[number].area += 0.5 * std::abs(normal.z());
      for (const Eigen::Vector3d& corner : corners) {
        extents_[number].box.extend(corner.head<2>());
      }
    }
    numbers_ = std::move(numbers);
  }

  [[nodiscard]] bool isGround(int triangle) {
    const Scene::Triangle& own = scene_.triangles[static_cast<std::size_t>(triangle)];
    const std::uint32_t number = numbers_[pieces_.find(cornerOf(own, 0))];
    if (number == noIndex) return false;
    const Extent& extent = extents_[number];
    return extent.area >= groundWidth * extent.box.diagonal().norm();
  }

 private:
  struct Extent {
    double area = 0.0;
    Eigen::AlignedBox2d box;
  };

  [[nodiscard]] std::uint32_t cornerOf(const Scene::Triangle& triangle, std::size_t k) const {
    return welded_[triangle.corners.at(k)];
  }

  const Scene& scene_;
  std::vector<std::uint32_t> welded_;
  Pieces pieces_;
  std::vector<std::uint32_t> numbers_;  // by a piece's first corner: its extent
  std::vector<Extent> extents_;
};

}  // namespace

std::vector<bool> areWalls(const Scene& scene, const std::vector<Wall>& surfaces,
                           const std::vector<Corners>& corners, double maxNormalUp) {
  std::vector<bool> result(surfaces.size(), true);
  const auto leans = [&](const Wall& wall) { return std::abs(wall.normal.z()) > maxNormalUp; };
  if (std::none_of(surfaces.begin(), surfaces.end(), leans)) return result;
  const Profiler profiler(surfaces, corners, maxNormalUp);
  std::optional<GroundPieces> ground;
  for (std::uint32_t i = 0; i < surfaces.size(); ++i) {
    if (!leans(surfaces[i])) continue;
    const Profile profile = profiler.through(i);
    result[i] = profile.isSteep() && profile.folds();
    if (result[i] || !profile.isSteep() || profile.rise() < leastRise ||
        std::abs(surfaces[i].normal.z()) > mostNormalUp) {
      continue;
    }
    const TriangleCorners& triangle = surfaces[i].corners;
    const double middle = (triangle[0].z() + triangle[1].z() + triangle[2].z()) / 3.0;
    if (profile.hasFoot(boxOf(triangle).max().z() - middle)) continue;
    if (!ground) ground.emplace(scene);
    result[i] = !ground->isGround(surfaces[i].triangle);
  }
  return result;
}

}  // namespace bumper
