#include "random_situations.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bumper::tests {

namespace {

constexpr double pi = std::numbers::pi;

Plan twoWalls(double firstAngle, double opening) {
  return {{Vector2::Zero(), 40.0 * direction(firstAngle)},
          {Vector2::Zero(), 40.0 * direction(firstAngle + opening)}};
}

Plan slivers(Random& random, double angle) {
  Plan plan;
  double along = -10.0;
  while (along < 10.0) {
    const double next =
        along + std::pow(10.0, random.uniform(random.chance(0.5) ? -9.0 : -1.0, 0.5));
    const Line piece{along * direction(angle), next * direction(angle)};
    plan.push_back(random.chance(0.5) ? piece : Line{piece.end, piece.start});
    if (random.chance(0.2)) plan.push_back({piece.end, piece.start});
    along = next;
  }
  return plan;
}

AngleCurve randomCurve(Random& random, double low, double high) {
  const double first = random.uniform(low, high);
  return random.chance(0.5) ? AngleCurve::constant(first)
                            : AngleCurve::cosine(first, random.uniform(low, high));
}

}  // namespace

Plan randomPlan(Random& random, Layout layout) {
  const double angle = random.uniform(-pi, pi);
  const Vector2 along = direction(angle);
  switch (layout) {
    case Layout::wall:
      return {{-40.0 * along, 40.0 * along}};
    case Layout::bare_end:
      return {{Vector2::Zero(), random.uniform(0.1, 10.0) * along}};
    case Layout::post:
      return slab({-0.05 * along, 0.05 * along}, 0.1);
    case Layout::thin_slab:
      return slab({-20.0 * along, 20.0 * along}, 0.001);
    case Layout::inside_corner:
      return twoWalls(angle, random.uniform(pi / 3.0, pi));
    case Layout::outside_corner:
      return twoWalls(angle, random.uniform(pi, 5.0 * pi / 3.0));
    case Layout::wedge:
      return twoWalls(angle, random.uniform(pi / 180.0, pi / 3.0));
    case Layout::corridor: {
      const Vector2 aside = random.uniform(1.2, 3.0) * turnedLeft(along);
      const Line left{aside - 40.0 * along, aside + 40.0 * along};
      const Line right{-aside - 40.0 * along, -aside + 40.0 * along};
      return {left, right, {left.end, left.start}, right};
    }
    case Layout::slivers:
      return slivers(random, angle);
    case Layout::soup:
      break;
  }
  Plan plan;
  for (int i = 0; i < 6; ++i) {
    const Vector2 start(random.uniform(-8.0, 8.0), random.uniform(-8.0, 8.0));
    plan.push_back({start, start + random.uniform(0.01, 8.0) * direction(random.uniform(-pi, pi))});
  }
  return plan;
}

double randomSpeed(Random& random) {
  return random.chance(0.1) ? std::pow(10.0, random.uniform(-6.0, 0.0))
                            : random.uniform(0.0, 120.0);
}

double randomStep(Random& random) { return std::pow(10.0, random.uniform(-4.0, std::log10(0.05))); }

ResponseSettings randomSettings(Random& random) {
  ResponseSettings settings;
  settings.law = random.chance(0.5) ? Law::restitution : Law::energy;
  settings.angle = static_cast<AngleDefinition>(random.below(3));
  settings.restitution = random.chance(0.5) ? AngleCurve::constant(randomRestitution(random))
                                            : randomCurve(random, 0.0, 1.0);
  settings.friction = random.chance(0.5) ? AngleCurve::constant(randomFriction(random))
                                         : randomCurve(random, 0.0, 3.0);
  settings.energyRemaining = randomCurve(random, 0.0, 1.0);
  settings.maxRestitution = random.uniform(0.0, 1.0);
  if (settings.law == Law::restitution && random.chance(0.2)) {
    settings.frictionKind = Friction::Kind::fraction_of_critical;
    settings.friction = randomCurve(random, 0.0, 1.0);
  }
  return settings;
}

std::optional<PlanarMotion> randomApproach(Random& random, const VehicleParameters& vehicle,
                                           const Plan& plan, double step) {
  PlanarMotion motion;
  motion.position = {random.uniform(-9.0, 9.0), random.uniform(-9.0, 9.0)};
  motion.yaw = random.uniform(-pi, pi);
  const double speed = randomSpeed(random);
  const Line& aim = plan[static_cast<std::size_t>(random.below(static_cast<int>(plan.size())))];
  const double share =
      random.chance(0.3) ? std::round(random.uniform(0.0, 1.0)) : random.uniform(0.0, 1.0);
  Vector2 target = aim.start + share * (aim.end - aim.start);
  if (target.norm() > 9.0) target *= 9.0 / target.norm();
  const Vector2 way = target - motion.position;
  const Vector2 heading = rotated(way.normalized(), random.uniform(-0.3, 0.3));
  motion.velocity = speed * heading;
  if (random.chance(0.7)) motion.yawRate = std::min(1.0, speed) * random.uniform(-10.0, 10.0);

  if (deepestIntrusion(vehicle, motion, plan) > 0.0) return std::nullopt;
  // Forward in small strides until something is touched, then back out of it.
  constexpr double stride = 0.1;
  for (int strides = 0; strides < 200; ++strides) {
    PlanarMotion further = motion;
    further.position += stride * heading;
    if (leadsThrough(motion.position, further.position, plan)) return std::nullopt;
    if (deepestIntrusion(vehicle, further, plan) > 0.0) {
      const double back = random.uniform(0.0, std::min(speed * step, 1.0));
      further.position = motion.position - back * heading;
      if (deepestIntrusion(vehicle, further, plan) > 0.0 ||
          leadsThrough(motion.position, further.position, plan)) {
        return motion;
      }
      return further;
    }
    motion = further;
  }
  return std::nullopt;
}

}  // namespace bumper::tests
