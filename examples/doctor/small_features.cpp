#include "small_features.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "wall_sections.h"

namespace bumper::doctor {

namespace {

constexpr double reachedHeight = 4.0;  // m above a wall's foot
constexpr double sineOfBend = 0.1736;  // 10°: what goes on at a sharper bend is another wall
constexpr double levelCell = 2.0;      // m

/// The lines of one height, found by place.
class Level {
 public:
  void add(const WallLine& line) {
    const std::size_t index = lines_.size();
    lines_.push_back(line);
    const auto pieces = static_cast<std::size_t>(line.length() / levelCell) + 1;
    std::uint64_t last = 0;
    for (std::size_t i = 0; i <= pieces; ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(pieces);
      const std::uint64_t key = keyOf(line.from + share * (line.to - line.from), 0, 0);
      if (i > 0 && key == last) continue;
      cells_[key].push_back(index);
      last = key;
    }
  }

  template <typename Visit>
  void visitAround(const Vector2& place, const Visit& visit) const {
    for (int dx = -1; dx <= 1; ++dx) {
      for (int dy = -1; dy <= 1; ++dy) {
        const auto cell = cells_.find(keyOf(place, dx, dy));
        if (cell == cells_.end()) continue;
        for (const std::size_t index : cell->second) visit(index, lines_[index]);
      }
    }
  }

  [[nodiscard]] const std::vector<WallLine>& lines() const { return lines_; }

 private:
  static std::uint64_t keyOf(const Vector2& place, int dx, int dy) {
    const auto column = static_cast<std::int64_t>(std::floor(place.x() / levelCell)) + dx;
    const auto row = static_cast<std::int64_t>(std::floor(place.y() / levelCell)) + dy;
    return (static_cast<std::uint64_t>(column) << 32U) ^
           (static_cast<std::uint64_t>(row) & 0xFFFFFFFFU);
  }

  std::vector<WallLine> lines_;
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> cells_;
};

struct Sizes {
  double largest;  ///< m
  double noise;    ///< m: less is none
  double gap;      ///< m: how far away the wall may go on
  double goesOn;   ///< m: how far it has to
};

/// What is at a line's end, if it is a small feature: its size, and whether it is a gap.
struct End {
  double size = 0.0;
  bool isGap = false;
};

End endOf(const Level& level, std::size_t own, const Vector2& end, const Vector2& out,
          const Sizes& sizes) {
  bool goesOn = false;
  End found{.size = sizes.largest};
  level.visitAround(end, [&](std::size_t index, const WallLine& line) {
    if (index == own || goesOn) return;
    Vector2 from = line.from - end;
    Vector2 to = line.to - end;
    if (from.dot(out) > to.dot(out)) std::swap(from, to);
    if (to.dot(out) <= sizes.noise) return;
    const Vector2 along = (to - from).normalized();
    if (std::abs(cross(out, along)) > sineOfBend) return;
    const double begin = from.dot(out);
    const Vector2 nearest = begin > 0.0 ? from : Vector2(from - along * from.dot(along));
    const double aside = std::abs(cross(out, nearest));
    if (aside <= sizes.noise && begin <= sizes.noise) {
      goesOn = true;
      return;
    }
    if (to.dot(out) < sizes.goesOn || begin > sizes.gap) return;
    const bool isGap = aside <= sizes.noise;
    const double size = isGap ? begin : aside;
    if (size < found.size) found = {size, isGap};
  });
  return goesOn ? End{} : found;
}

std::map<long, Level> levelsOf(const std::vector<Wall>& walls, double spacing) {
  std::map<long, Level> levels;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    const Wall& wall = walls[i];
    const auto [low, high] =
        std::minmax({wall.corners[0].z(), wall.corners[1].z(), wall.corners[2].z()});
    const double top = std::min(high, wall.foot + reachedHeight);
    // Between round heights, where meshes have their edges.
    const auto first = static_cast<long>(std::ceil(low / spacing - 0.4127));
    for (long k = first; (static_cast<double>(k) + 0.4127) * spacing < top; ++k) {
      DrivingPlane plane;
      plane.origin.z() = (static_cast<double>(k) + 0.4127) * spacing;
      WallLine line{.wall = i};
      if (cutWall(wall, plane, 0.0, line)) levels[k].add(line);
    }
  }
  return levels;
}

}  // namespace

std::vector<SmallFeature> smallFeatures(const std::vector<Wall>& walls, double smallest,
                                        double spacing) {
  const Sizes sizes{.largest = smallest,
                    .noise = 0.005 * smallest,
                    .gap = 15.0 * smallest,
                    .goesOn = 2.5 * smallest};
  std::vector<SmallFeature> all;
  for (const auto& [k, level] : levelsOf(walls, spacing)) {
    for (std::size_t i = 0; i < level.lines().size(); ++i) {
      const WallLine& line = level.lines()[i];
      if (line.length() < sizes.goesOn) continue;
      const Vector2 along = (line.to - line.from).normalized();
      for (const auto& [end, out] : {std::pair(line.to, along), {line.from, Vector2(-along)}}) {
        const End found = endOf(level, i, end, out, sizes);
        if (found.size <= 0.0 || found.size >= smallest) continue;
        const double height = (static_cast<double>(k) + 0.4127) * spacing;
        all.push_back({.place = {end.x(), end.y(), height},
                       .size = found.size,
                       .isGap = found.isGap,
                       .wall = line.wall});
      }
    }
  }
  // The largest first; places that are equally bad in an order of their own.
  std::ranges::sort(all, [](const SmallFeature& a, const SmallFeature& b) {
    return std::tuple(-a.size, a.place.x(), a.place.y(), a.place.z()) <
           std::tuple(-b.size, b.place.x(), b.place.y(), b.place.z());
  });
  const double apart = std::min(0.25, 10.0 * smallest);
  std::map<std::pair<long, long>, std::vector<Eigen::Vector2d>> kept;
  std::vector<SmallFeature> features;
  for (const SmallFeature& feature : all) {
    const Eigen::Vector2d place = feature.place.head<2>();
    const long x = std::lround(place.x() / apart);
    const long y = std::lround(place.y() / apart);
    bool isNew = true;
    for (long dx = -1; dx <= 1; ++dx) {
      for (long dy = -1; dy <= 1; ++dy) {
        const auto cell = kept.find({x + dx, y + dy});
        if (cell == kept.end()) continue;
        for (const Eigen::Vector2d& other : cell->second)
          isNew = isNew && (other - place).norm() > apart;
      }
    }
    if (!isNew) continue;
    kept[{x, y}].push_back(place);
    features.push_back(feature);
  }
  return features;
}

}  // namespace bumper::doctor
