#include "rows_of_blocks.h"

#include <algorithm>
#include <cmath>

namespace bumper::tests {
namespace {

void addWall(Row& row, const Vector2& start, const Vector2& end) {
  row.walls.push_back({.start = start,
                       .end = end,
                       .normal = turnedLeft((end - start).normalized()),
                       .id = static_cast<int>(row.walls.size())});
}

/// Of the row's walls those that can be within reach, in the row's order.
void gather(const Row& row, const Vector2& position, double radius, std::vector<Segment>& nearby) {
  nearby.clear();
  for (const Segment& wall : row.walls) {
    const auto [low, high] = std::minmax(
        {row.frame.along.dot(wall.start - position), row.frame.along.dot(wall.end - position)});
    if (low <= radius && high >= -radius) nearby.push_back(wall);
  }
}

/// Of the outline's lowest corner over the row's foremost face.
double lowest(const Row& row, const Outline& outline, const Placement& at) {
  double least = 1e9;
  for (const Vector2& corner : outline.corners()) {
    const Vector2 place = at.position + at.turned(corner) - row.frame.origin;
    least = std::min(least, row.frame.out().dot(place) - row.foremost);
  }
  return least;
}

}  // namespace

void add(Row& row, const Block& block) {
  const auto at = [&](double x, double y) { return row.frame.at(x, y); };
  const double low = block.out - block.thickness;
  row.foremost = row.walls.empty() ? block.out : std::max(row.foremost, block.out);
  addWall(row, at(block.from, block.out), at(block.to, block.out));
  if (block.thickness == 0.0) return;
  addWall(row, at(block.to, block.out), at(block.to, low));
  addWall(row, at(block.to, low), at(block.from, low));
  addWall(row, at(block.from, low), at(block.from, block.out));
}

Row randomRow(Random& random, const Masonry& masonry, const RowFrame& frame) {
  Row row{.frame = frame};
  const bool sheets = random.chance(0.3);
  for (double x = -8.0 * masonry.unit; x < masonry.length;) {
    Block block{.from = x, .to = x + masonry.unit * std::pow(10.0, random.uniform(-0.7, 0.7))};
    block.out = random.chance(0.5) ? masonry.off : 0.0;
    block.thickness = sheets ? 0.0 : masonry.unit * random.uniform(0.1, 0.6);
    add(row, block);
    const bool open = !masonry.jointless && random.chance(0.6);
    x = block.to + (open ? masonry.unit * std::pow(10.0, random.uniform(-3.0, -0.53)) : 0.0);
  }
  return row;
}

Row staircase(double cell, double length, const RowFrame& frame) {
  Row row{.frame = frame};
  // A cell is behind the wall if its middle is; the edge runs between a cell behind and one before.
  const int reach = static_cast<int>(length / cell);
  const auto behind = [&](int x, int y) {
    return frame.out().dot(cell * Vector2(x + 0.5, y + 0.5)) < 0.0;
  };
  for (int x = -reach; x <= reach; ++x) {
    // Cells of this column near the line.
    const Vector2 out = frame.out();
    const double middle = -out.x() * (x + 0.5) / (std::abs(out.y()) > 1e-9 ? out.y() : 1e-9);
    const double spread = std::abs(out.x() / (std::abs(out.y()) > 1e-9 ? out.y() : 1e-9)) + 3.0;
    const int low = static_cast<int>(std::floor(std::max(middle - spread, -1.0 * reach)));
    const int high = static_cast<int>(std::ceil(std::min(middle + spread, 1.0 * reach)));
    for (int y = low; y <= high; ++y) {
      const Vector2 corner = frame.origin + cell * Vector2(x, y);
      const Vector2 right = cell * Vector2::UnitX(), up = cell * Vector2::UnitY();
      if (behind(x, y) != behind(x + 1, y)) addWall(row, corner + right, corner + right + up);
      if (behind(x, y) != behind(x, y + 1)) addWall(row, corner + up, corner + up + right);
    }
  }
  std::sort(row.walls.begin(), row.walls.end(), [&](const Segment& a, const Segment& b) {
    return frame.along.dot(a.start + a.end) < frame.along.dot(b.start + b.end);
  });
  row.foremost = 0.0;
  for (const Segment& wall : row.walls) {
    for (const Vector2& end : {wall.start, wall.end})
      row.foremost = std::max(row.foremost, frame.out().dot(end - frame.origin));
  }
  return row;
}

void roundToFloat(Row& row) {
  const auto round = [](Vector2& v) { v = v.cast<float>().cast<double>(); };
  for (Segment& wall : row.walls) {
    round(wall.start);
    round(wall.end);
    wall.normal = turnedLeft((wall.end - wall.start).normalized());
  }
}

SlideResult slideAlong(CollisionStep& collision, const Row& row, const Slide& slide,
                       const ResponseSettings& settings) {
  const Surface surface{.settings = &settings};
  const Outline outline(slide.vehicle);
  const double heading = std::atan2(row.frame.along.y(), row.frame.along.x()) - slide.into;
  PlanarMotion motion{.yaw = heading, .velocity = slide.speed * direction(heading)};
  motion.position = row.frame.at(slide.start, 0.0);
  motion.position += (slide.gap - lowest(row, outline, motion.placement())) * row.frame.out();

  std::vector<Segment> nearby;
  SlideResult result{.slowest = slide.speed};
  const int steps = static_cast<int>(slide.distance / (slide.speed * slide.step));
  for (int i = 0; i < steps; ++i) {
    motion.velocity -= slide.pressing * slide.step * row.frame.out();
    // A driver, critically damped.
    constexpr double quickness = 8.0;  // 1/s
    const double astray = std::remainder(motion.yaw - heading, 2.0 * 3.14159265358979323846);
    motion.yawRate -= slide.step * quickness * (quickness * astray + 2.0 * motion.yawRate);
    const double reach =
        outline.radius() +
        CollisionStep::reach(slide.vehicle, motion, settings.penetrationTime, slide.step);
    gather(row, motion.position, reach, nearby);
    const StepOutcome outcome =
        collision.resolve(slide.vehicle, motion, {nearby, {&surface, 1}}, slide.step);
    for (const StepImpact& each : outcome.impacts) {
      result.hardest =
          std::max(result.hardest, each.response.impulse.linear.norm() / slide.vehicle.mass);
    }
    result.hardestStep =
        std::max(result.hardestStep, outcome.impulse.linear.norm() / slide.vehicle.mass);
    result.impacts += static_cast<int>(outcome.impacts.size());
    result.settled &= outcome.settled;
    motion = outcome.after;
    result.deepest = std::max(result.deepest, -lowest(row, outline, motion.placement()));
    result.slowest = std::min(result.slowest, motion.velocity.dot(row.frame.along));
    result.turned = std::max(result.turned, std::abs(astray));
  }
  result.speed = motion.velocity.dot(row.frame.along);
  return result;
}

}  // namespace bumper::tests
