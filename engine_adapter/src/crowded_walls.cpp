#include "crowded_walls.h"

#include <algorithm>
#include <cmath>

namespace bumper {

namespace {

// Squares of this size, m, and the same doubled so often; a crowd reaches over so many.
constexpr double smallestCell = 0.05;
constexpr int doublings = 3;
constexpr std::int64_t widestCrowd = 4;

// A place is a row and a column with this many bits each, below the surface and its solidity.
constexpr unsigned bits = 20;
constexpr std::int64_t origin = std::int64_t{1} << (bits - 1);

std::uint64_t numberOf(double coordinate, double size) {
  constexpr auto end = static_cast<double>(origin - 2);
  const double cell = std::clamp(std::floor(coordinate / size), -end, end);
  return static_cast<std::uint64_t>(static_cast<std::int64_t>(cell) + origin);
}

std::int64_t columnOf(std::uint64_t place) {
  return static_cast<std::int64_t>(place >> bits & ((std::uint64_t{1} << bits) - 1));
}

std::int64_t rowOf(std::uint64_t place) {
  return static_cast<std::int64_t>(place & ((std::uint64_t{1} << bits) - 1));
}

// Deeper than what slides within a step: the outline was put there.
bool isDeepIn(const Outline& outline, const Vector2& point) {
  constexpr double deep = 0.05;
  return point.x() < outline.front - deep && point.x() > deep - outline.rear &&
         std::abs(point.y()) < outline.halfWidth - deep;
}

}  // namespace

void CrowdedWalls::reduce(std::vector<Segment>& segments, const Outline& outline) {
  keepEntered_ = segments.size() <= mostEntered;
  double size = smallestCell;
  for (int i = 0; i <= doublings && segments.size() > most; ++i, size *= 2.0) {
    reduced_.clear();
    findCells(segments, size);
    joinCells();
    addOutsides(segments, outline);
    if (reduced_.size() < segments.size() && (reduced_.size() <= most || i == doublings)) {
      segments.swap(reduced_);
    }
  }
}

// What is larger than a cell is not of a crowd.
void CrowdedWalls::findCells(const std::vector<Segment>& segments, double size) {
  members_.clear();
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const Segment& wall = segments[i];
    if (wall.isPost() || (wall.end - wall.start).squaredNorm() > size * size) {
      reduced_.push_back(wall);
      continue;
    }
    const Vector2 middle = 0.5 * (wall.start + wall.end);
    const auto kind = 2 * static_cast<std::uint64_t>(wall.surface) + (wall.solid ? 1U : 0U);
    members_.push_back(
        {(kind << (2 * bits)) | (numberOf(middle.x(), size) << bits) | numberOf(middle.y(), size),
         i});
  }
  // By their order in the barriers too, so that nothing depends on how they are sorted.
  std::sort(members_.begin(), members_.end(), [](const Member& a, const Member& b) {
    return a.place != b.place ? a.place < b.place : a.segment < b.segment;
  });
  cells_.clear();
  for (std::size_t i = 0; i < members_.size(); ++i) {
    const std::uint64_t place = members_[i].place;
    if (cells_.empty() || cells_.back().place != place) {
      const std::int64_t column = columnOf(place);
      const std::int64_t row = rowOf(place);
      cells_.push_back({place, i, i, cells_.size(), {column, column, row, row}, false});
    }
    cells_.back().last = i + 1;
  }
}

std::size_t CrowdedWalls::crowdOf(std::size_t cell) const {
  while (cells_[cell].crowd != cell) cell = cells_[cell].crowd;
  return cell;
}

void CrowdedWalls::join(std::size_t cell, std::uint64_t place) {
  const auto found =
      std::lower_bound(cells_.begin(), cells_.end(), place,
                       [](const Cell& each, std::uint64_t wanted) { return each.place < wanted; });
  if (found == cells_.end() || found->place != place) return;
  const std::size_t one = crowdOf(cell);
  const std::size_t other = crowdOf(static_cast<std::size_t>(found - cells_.begin()));
  if (one == other) return;
  const auto [low, high] = std::minmax(one, other);
  const std::array<std::int64_t, 4>& more = cells_[high].extent;
  std::array<std::int64_t, 4>& extent = cells_[low].extent;
  const std::array<std::int64_t, 4> both{std::min(extent[0], more[0]), std::max(extent[1], more[1]),
                                         std::min(extent[2], more[2]),
                                         std::max(extent[3], more[3])};
  if (both[1] - both[0] >= widestCrowd || both[3] - both[2] >= widestCrowd) return;
  extent = both;
  cells_[high].crowd = low;
}

void CrowdedWalls::joinCells() {
  constexpr std::uint64_t column = std::uint64_t{1} << bits;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const std::uint64_t place = cells_[i].place;
    for (const std::uint64_t next :
         {place + 1, place + column - 1, place + column, place + column + 1}) {
      join(i, next);
    }
  }
}

void CrowdedWalls::addOutsides(const std::vector<Segment>& segments, const Outline& outline) {
  outsides_.assign(cells_.size(), {});
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const std::size_t crowd = crowdOf(i);
    Outside& outside = outsides_[crowd];
    for (std::size_t member = cells_[i].first; member < cells_[i].last; ++member) {
      const std::size_t number = members_[member].segment;
      for (const Vector2& point : {segments[number].start, segments[number].end}) {
        cells_[crowd].isEntered |= keepEntered_ && isDeepIn(outline, point);
        outside.include(point, number);
      }
    }
  }
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const std::size_t crowd = crowdOf(i);
    if (!cells_[crowd].isEntered) {
      if (crowd == i) addOutside(segments, outsides_[i]);
      continue;
    }
    for (std::size_t member = cells_[i].first; member < cells_[i].last; ++member) {
      reduced_.push_back(segments[members_[member].segment]);
    }
  }
}

// Where all is one point, the first segment is all that there is.
void CrowdedWalls::addOutside(const std::vector<Segment>& segments, const Outside& outside) {
  const std::size_t before = reduced_.size();
  outside.forEachSide(
      [&](const Outside::Extreme& from, const Outside::Extreme& to, const Vector2& normal) {
        Segment side = segments[from.owner];
        side.start = from.point;
        side.end = to.point;
        side.normal = normal;
        reduced_.push_back(side);
      });
  if (reduced_.size() == before) {
    reduced_.push_back(segments[outside.extremes().front().owner]);
  }
}

}  // namespace bumper
