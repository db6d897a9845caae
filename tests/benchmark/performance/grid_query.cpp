#include "grid_query.h"

#include <algorithm>
#include <cmath>

namespace bumper::benchmark {

namespace {

// How far the outline comes in a step at most, m: more than CollisionStep::reach() of the drives.
constexpr double farthestReach = 0.5;

}  // namespace

GridQuery::GridQuery(const Scene& scene) : outline_(queryCar()), grid_(scene, outline_.radius()) {}

GridSweep::GridSweep(const Scene& scene)
    : grid_(scene, Outline(queryCar()).radius() + farthestReach) {}

std::size_t GridSweep::query() {
  count_ = 0;
  const std::span<const PlanSegment> walls = grid_.near(pose_.place.position);
  if (walls.empty()) return 0;
  const PlanPlace& place = pose_.place;
  PlanarMotion motion;
  motion.velocity = {place.cosine * pose_.velocity.x() + place.sine * pose_.velocity.y(),
                     place.cosine * pose_.velocity.y() - place.sine * pose_.velocity.x()};
  motion.yawRate = pose_.yawRate;
  const double reach = CollisionStep::reach(car_, motion, settings_.penetrationTime, stepSize);
  const double front = car_.massCentreToFront + reach;
  const double rear = -car_.massCentreToRear - reach;
  const double side = 0.5 * car_.width + reach;
  segments_.clear();
  for (const PlanSegment& wall : walls) {
    Segment segment;
    segment.start = place.toVehicle(wall.start);
    segment.end = place.toVehicle(wall.end);
    if (std::min(segment.start.x(), segment.end.x()) > front ||
        std::max(segment.start.x(), segment.end.x()) < rear ||
        std::min(segment.start.y(), segment.end.y()) > side ||
        std::max(segment.start.y(), segment.end.y()) < -side) {
      continue;
    }
    segment.normal = turnedLeft(segment.end - segment.start).normalized();
    segment.id = static_cast<int>(segments_.size());
    segments_.push_back(segment);
  }
  if (segments_.empty()) return 0;
  const StepOutcome outcome =
      collision_.resolve(car_, motion, {segments_, {&surface_, 1}}, stepSize);
  count_ = outcome.impacts.size() + (outcome.shift.velocity.isZero(0.0) ? 0 : 1);
  return count_;
}

}  // namespace bumper::benchmark
