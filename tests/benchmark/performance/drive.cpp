#include "drive.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "bumper/scenes/paper_scenes.h"
#include "scenes.h"

namespace bumper::benchmark {

namespace {

constexpr double nearDistance = 1.0;    // m
constexpr double touchDepth = 0.001;    // m
constexpr double wallToCentre = 7.0;    // m, on the course; the same at the test rail
constexpr double pointSpacing = 0.1;    // m, of the line that is followed
constexpr double tangentReach = 2.0;    // m before and behind, of its direction
constexpr double straightAngle = 0.02;  // rad over the middle of a swerve
constexpr std::size_t longestStretch = 256;

/// A closed line with points at equal distances.
class Line {
 public:
  explicit Line(std::vector<Vector2> points) : points_(std::move(points)) {
    spacing_ = (points_[1] - points_[0]).norm();
  }

  [[nodiscard]] double length() const { return spacing_ * static_cast<double>(points_.size()); }

  [[nodiscard]] Vector2 at(double way) const {
    const double place = way / spacing_;
    const double whole = std::floor(place);
    const auto count = static_cast<long>(points_.size());
    const long index = ((static_cast<long>(whole) % count) + count) % count;
    const Vector2& a = points_[static_cast<std::size_t>(index)];
    const Vector2& b = points_[static_cast<std::size_t>((index + 1) % count)];
    return a + (place - whole) * (b - a);
  }

  [[nodiscard]] Vector2 ahead(double way) const {
    return (at(way + tangentReach) - at(way - tangentReach)).normalized();
  }

 private:
  std::vector<Vector2> points_;
  double spacing_ = 0.0;
};

// How far beyond the wall a swerve aims, m: so long does it touch.
constexpr double overshoot = 0.03;
// Every second swerve at the test rail, whose laps are short, turns back this far before the wall.
constexpr double keptAway = 0.4;

/// Out to a wall and back.
struct Swerve {
  double middle = 0.0;  ///< m along the line
  double half = 0.0;    ///< m before and behind
  double side = 1.0;    ///< 1: to the left
  double reach = 0.0;   ///< m to that side
};

/// A round beside the side wall of the test rail, 7 m from it.
Line testRailLine() {
  constexpr double straight = 36.0;
  constexpr double radius = 12.0;
  const Vector2 across = Vector2(-0.10453, 0.99452).normalized();
  const Vector2 along(across.y(), -across.x());
  // The wall begins about 34 m before this point of its face.
  const Vector2 begin = Vector2(42.334, -0.900) - 27.0 * along + wallToCentre * across;
  constexpr double length = 2.0 * (straight + std::numbers::pi * radius);
  const auto count = static_cast<std::size_t>(length / pointSpacing);
  std::vector<Vector2> points;
  for (std::size_t i = 0; i < count; ++i) {
    double way = length * static_cast<double>(i) / static_cast<double>(count);
    const bool back = way >= 0.5 * length;
    if (back) way -= 0.5 * length;
    const double angle = std::max(0.0, way - straight) / radius;
    Vector2 local(std::min(way, straight) + radius * std::sin(angle),
                  radius * (1.0 - std::cos(angle)));
    if (back) local = Vector2(straight, 2.0 * radius) - local;
    points.emplace_back(begin + local.x() * along + local.y() * across);
  }
  return Line(std::move(points));
}

Line courseLine() {
  constexpr double length = 5400.0;
  return Line(courseCentreLine(static_cast<std::size_t>(length / pointSpacing)));
}

/// Swerves where the line is straight, to either side in turn.
std::vector<Swerve> swervesOf(const Line& line, double way, double every, double half,
                              double reach) {
  std::vector<Swerve> swerves;
  double side = -1.0;
  double middle = half;
  while (middle + half < way) {
    const double beside = 0.35 * half;
    const double bend =
        std::acos(std::min(1.0, line.ahead(middle - beside).dot(line.ahead(middle + beside))));
    if (bend > straightAngle) {
      middle += 1.0;
      continue;
    }
    swerves.push_back({.middle = middle, .half = half, .side = side, .reach = reach});
    side = -side;
    middle += every;
  }
  return swerves;
}

/// Offset to the left and its slope along the line.
struct Offset {
  double value = 0.0;
  double slope = 0.0;
};

Offset offsetAt(const std::vector<Swerve>& swerves, double way) {
  for (const Swerve& swerve : swerves) {
    const double from = (way - swerve.middle) / swerve.half;
    if (std::abs(from) >= 1.0) continue;
    const double angle = std::numbers::pi * from;
    return {.value = 0.5 * swerve.side * swerve.reach * (1.0 + std::cos(angle)),
            .slope = -0.5 * swerve.side * swerve.reach * std::numbers::pi / swerve.half *
                     std::sin(angle)};
  }
  return {};
}

bool touchesAny(const WallGrid& grid, const Outline& outline, const PlanPlace& place) {
  return std::ranges::any_of(grid.near(place.position), [&](const PlanSegment& wall) {
    return overlap(outline, place, wall);
  });
}

/// Moves a place that overlaps a wall back towards the line until it overlaps by touchDepth.
void easeOut(const WallGrid& grid, const Outline& outline, const Vector2& inward,
             PlanPlace& place) {
  constexpr double most = 1.0;
  if (!touchesAny(grid, outline, place)) return;
  const Vector2 from = place.position;
  double in = 0.0;
  double out = most;
  while (out - in > 1e-7) {
    const double middle = 0.5 * (in + out);
    place.position = from + middle * inward;
    (touchesAny(grid, outline, place) ? in : out) = middle;
  }
  place.position = from + std::max(0.0, out - touchDepth) * inward;
}

Nearness nearnessAt(const WallGrid& grid, const Outline& outline, const PlanPlace& place) {
  double gap = 2.0 * nearDistance;
  for (const PlanSegment& wall : grid.near(place.position)) {
    gap = std::min(gap, gapBetween(outline, place, wall));
  }
  if (gap == 0.0) return Nearness::touching;
  return gap <= nearDistance ? Nearness::near : Nearness::far;
}

void turn(PlanPlace& place, const Vector2& direction) {
  place.cosine = direction.x();
  place.sine = direction.y();
}

}  // namespace

Drive makeDrive(const Scene& scene, std::size_t poses) {
  const bool isCourse = scene.meshes.front().name == "inner_wall";
  const double speed = isCourse ? 28.0 : 9.0;
  const Line line = isCourse ? courseLine() : testRailLine();
  const double way = speed * stepSize * static_cast<double>(poses);
  const Outline outline(queryCar());
  const double reach = wallToCentre - outline.halfWidth + overshoot;
  std::vector<Swerve> swerves;
  if (isCourse) {
    swerves = swervesOf(line, way, 350.0, 62.0, reach);
  } else {
    const auto laps = static_cast<std::size_t>(std::ceil(way / line.length()));
    for (std::size_t lap = 0; lap < laps; ++lap) {
      swerves.push_back({.middle = line.length() * static_cast<double>(lap) + 18.0,
                         .half = 20.0,
                         .side = -1.0,
                         .reach = reach - (lap % 2 == 1 ? keptAway : 0.0)});
    }
  }
  const WallGrid grid(scene, outline.radius() + 2.0 * nearDistance);
  Drive drive;
  drive.poses.reserve(poses);
  std::vector<Nearness> kinds;
  double yawBefore = 0.0;
  Vector2 positionBefore = Vector2::Zero();
  // The first pose only says where the drive comes from.
  for (std::size_t i = 0; i <= poses; ++i) {
    const double at = speed * stepSize * (static_cast<double>(i) - 1.0);
    const Vector2 ahead = line.ahead(at);
    const Vector2 left = turnedLeft(ahead);
    const Offset offset = offsetAt(swerves, at);
    Pose pose;
    pose.place.position = line.at(at) + offset.value * left;
    turn(pose.place, (ahead + offset.slope * left).normalized());
    easeOut(grid, outline, offset.value > 0.0 ? Vector2(-left) : left, pose.place);
    const double yaw = std::atan2(pose.place.sine, pose.place.cosine);
    pose.halfCosine = std::cos(0.5 * yaw);
    pose.halfSine = std::sin(0.5 * yaw);
    pose.velocity = (pose.place.position - positionBefore) / stepSize;
    pose.yawRate = std::remainder(yaw - yawBefore, 2.0 * std::numbers::pi) / stepSize;
    yawBefore = yaw;
    positionBefore = pose.place.position;
    if (i == 0) continue;
    drive.poses.push_back(pose);
    kinds.push_back(nearnessAt(grid, outline, pose.place));
    ++drive.counts.at(static_cast<std::size_t>(kinds.back()));
  }
  const std::span<const Pose> all(drive.poses);
  for (std::size_t begin = 0; begin < all.size();) {
    std::size_t end = begin + 1;
    while (end < all.size() && kinds[end] == kinds[begin] && end - begin < longestStretch) ++end;
    drive.stretches.push_back({.kind = kinds[begin], .poses = all.subspan(begin, end - begin)});
    begin = end;
  }
  return drive;
}

std::vector<PlanPlace> placesAlongCourse(const Scene& scene, std::size_t count, bool touching) {
  const Line line = courseLine();
  const Outline outline(queryCar());
  const WallGrid grid(scene, outline.radius());
  std::vector<PlanPlace> places;
  for (std::size_t i = 0; i < count; ++i) {
    const double at = line.length() * static_cast<double>(i) / static_cast<double>(count);
    const Vector2 ahead = line.ahead(at);
    const Vector2 left = turnedLeft(ahead);
    PlanPlace place;
    place.position = line.at(at);
    turn(place, ahead);
    if (touching) {
      place.position -= (wallToCentre - outline.halfWidth + overshoot) * left;
      easeOut(grid, outline, left, place);
    }
    places.push_back(place);
  }
  return places;
}

std::vector<Pose> scattered(const Drive& drive, Nearness kind) {
  std::vector<Pose> poses;
  for (const Stretch& stretch : drive.stretches) {
    if (stretch.kind == kind) poses.insert(poses.end(), stretch.poses.begin(), stretch.poses.end());
  }
  // A stride without a common divisor comes by every pose once.
  std::size_t stride = std::max<std::size_t>(1, poses.size() * 382 / 1000);
  while (std::gcd(stride, poses.size()) != 1) ++stride;
  std::vector<Pose> result;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    result.push_back(poses[i * stride % poses.size()]);
  }
  return result;
}

}  // namespace bumper::benchmark
