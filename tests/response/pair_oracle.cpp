#include "pair_oracle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace bumper::tests {
namespace {

using Extended = long double;

struct Point {
  Extended x = 0.0L;
  Extended y = 0.0L;
};
Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
Point operator*(Extended s, Point a) { return {s * a.x, s * a.y}; }
Extended inner(Point a, Point b) { return a.x * b.x + a.y * b.y; }
Extended outer(Point a, Point b) { return a.x * b.y - a.y * b.x; }
Point left(Point a) { return {-a.y, a.x}; }
Point extended(const Vector2& v) { return {v.x(), v.y()}; }
Vector2 plain(Point a) { return {static_cast<double>(a.x), static_cast<double>(a.y)}; }

using Polygon = std::vector<Point>;

/// out · p ≤ reach
struct HalfPlane {
  Point out;
  Extended reach = 0.0L;
  [[nodiscard]] Extended beyond(Point p) const { return inner(out, p) - reach; }
};

Polygon clipped(const Polygon& polygon, const HalfPlane& by) {
  Polygon result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point a = polygon[i];
    const Point b = polygon[(i + 1) % polygon.size()];
    const Extended beyondA = by.beyond(a);
    const Extended beyondB = by.beyond(b);
    if (beyondA <= 0.0L) result.push_back(a);
    if ((beyondA < 0.0L && beyondB > 0.0L) || (beyondA > 0.0L && beyondB < 0.0L)) {
      result.push_back(a + (beyondA / (beyondA - beyondB)) * (b - a));
    }
  }
  return result;
}

struct Measures {
  Extended area = 0.0L;
  Point centroid;
};

Measures measures(const Polygon& polygon) {
  Measures result;
  if (polygon.size() < 3) return result;
  Point moment;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Point a = polygon[i] - polygon[0];
    const Point b = polygon[i + 1] - polygon[0];
    const Extended triangle = 0.5L * outer(a, b);
    result.area += triangle;
    moment = moment + (triangle / 3.0L) * (a + b);
  }
  if (result.area > 0.0L) result.centroid = polygon[0] + (1.0L / result.area) * moment;
  return result;
}

struct Pose {
  Point position;
  Extended cosine = 1.0L;
  Extended sine = 0.0L;
  [[nodiscard]] Point turned(Point p) const {
    return {cosine * p.x - sine * p.y, sine * p.x + cosine * p.y};
  }
  [[nodiscard]] Point place(Point p) const { return position + turned(p); }
  [[nodiscard]] Point local(Point p) const {
    const Point d = p - position;
    return {cosine * d.x + sine * d.y, cosine * d.y - sine * d.x};
  }
};

Pose poseAt(const PlanarMotion& motion, Extended time) {
  const Extended yaw = motion.yaw + time * motion.yawRate;
  return {extended(motion.position) + time * extended(motion.velocity), std::cos(yaw),
          std::sin(yaw)};
}

Polygon outlineAt(const VehicleParameters& vehicle, const Pose& pose) {
  const Extended front = vehicle.massCentreToFront;
  const Extended rear = vehicle.massCentreToRear;
  const Extended half = 0.5L * vehicle.width;
  return {pose.place({front, half}), pose.place({-rear, half}), pose.place({-rear, -half}),
          pose.place({front, -half})};
}

std::array<HalfPlane, 4> sidesAt(const VehicleParameters& vehicle, const Pose& pose) {
  const std::array<Point, 4> outs{Point{1, 0}, Point{-1, 0}, Point{0, 1}, Point{0, -1}};
  const std::array<Extended, 4> reaches{vehicle.massCentreToFront, vehicle.massCentreToRear,
                                        0.5L * vehicle.width, 0.5L * vehicle.width};
  std::array<HalfPlane, 4> result;
  for (std::size_t i = 0; i < 4; ++i) {
    result[i].out = pose.turned(outs[i]);
    result[i].reach = reaches[i] + inner(result[i].out, pose.position);
  }
  return result;
}

Extended farthest(const std::array<HalfPlane, 4>& sides, const Polygon& other) {
  Extended most = -std::numeric_limits<Extended>::infinity();
  for (const HalfPlane& side : sides) {
    Extended least = std::numeric_limits<Extended>::infinity();
    for (const Point& p : other) least = std::min(least, side.beyond(p));
    most = std::max(most, least);
  }
  return most;
}

/// Σ over the sides of the area of the part of the overlap that is nearest to each, times its
/// normal.
Point sideAreas(const Polygon& overlap, const std::array<HalfPlane, 4>& sides) {
  Point sum;
  for (std::size_t i = 0; i < 4; ++i) {
    Polygon part = overlap;
    for (std::size_t k = 0; k < 4; ++k) {
      if (k == i) continue;
      // Nearer to side i: reach_i − out_i · p ≤ reach_k − out_k · p.
      part = clipped(part, {sides[k].out - sides[i].out, sides[k].reach - sides[i].reach});
    }
    sum = sum + measures(part).area * sides[i].out;
  }
  return sum;
}

std::optional<Extended> firstTouch(const Pair& pair, Extended h) {
  if (oracleSeparation(pair, 0.0L) <= 0.0L) return 0.0L;
  const auto sweep = [](const PairState& state) {
    return std::abs(static_cast<Extended>(state.motion.yawRate)) * Outline(state.vehicle).radius();
  };
  const Point closing =
      extended(pair.first.motion.velocity) - extended(pair.second.motion.velocity);
  const Extended fastest =
      std::hypot(closing.x, closing.y) + sweep(pair.first) + sweep(pair.second);
  // No faster than they can close; what is grazed by less than 1e-8 m is left out, then bisection.
  Extended time = 0.0L;
  Extended last = 0.0L;
  for (;;) {
    const Extended gap = oracleSeparation(pair, time);
    if (gap <= 0.0L) break;
    last = time;
    time += std::max(gap, 1e-8L) / fastest;
    if (time > h) return std::nullopt;
  }
  for (int i = 0; i < 80; ++i) {
    const Extended middle = 0.5L * (last + time);
    (oracleSeparation(pair, middle) > 0.0L ? last : time) = middle;
  }
  return time;
}

}  // namespace

long double oracleSeparation(const Pair& pair, long double time) {
  const Pose a = poseAt(pair.first.motion, time);
  const Pose b = poseAt(pair.second.motion, time);
  return std::max(farthest(sidesAt(pair.first.vehicle, a), outlineAt(pair.second.vehicle, b)),
                  farthest(sidesAt(pair.second.vehicle, b), outlineAt(pair.first.vehicle, a)));
}

std::optional<OracleHit> oracleHit(const Pair& pair, const ResponseSettings& settings, double h) {
  const std::optional<Extended> touch = firstTouch(pair, h);
  if (!touch) return std::nullopt;
  const auto& [first, second] = pair;
  const Extended engagedAt = *touch + settings.penetrationTime;
  const Pose engagedA = poseAt(first.motion, engagedAt);
  const Pose engagedB = poseAt(second.motion, engagedAt);
  const auto sidesA = sidesAt(first.vehicle, engagedA);
  const auto sidesB = sidesAt(second.vehicle, engagedB);
  Polygon overlap = outlineAt(first.vehicle, engagedA);
  for (const HalfPlane& side : sidesB) overlap = clipped(overlap, side);
  const Measures whole = measures(overlap);
  OracleHit hit{.time = static_cast<double>(*touch)};
  if (!(whole.area > 0.0L)) return hit;
  const Point sum = sideAreas(overlap, sidesB) - sideAreas(overlap, sidesA);
  const Point n = (1.0L / std::hypot(sum.x, sum.y)) * sum;
  const Pose a = poseAt(first.motion, *touch);
  const Pose b = poseAt(second.motion, *touch);
  const Point point =
      0.5L * (a.place(engagedA.local(whole.centroid)) + b.place(engagedB.local(whole.centroid)));

  const Point t = left(n);
  Extended normalMobility = 0.0L;
  Extended tangentMobility = 0.0L;
  Extended coupling = 0.0L;
  Point relative;
  Extended sign = 1.0L;
  for (const PairState* state : {&first, &second}) {
    const Point arm = point - (state == &first ? a : b).position;
    const Extended m = state->vehicle.mass;
    const Extended inertia = state->vehicle.yawInertia;
    normalMobility += 1.0L / m + inner(arm, t) * inner(arm, t) / inertia;
    tangentMobility += 1.0L / m + inner(arm, n) * inner(arm, n) / inertia;
    coupling -= inner(arm, n) * inner(arm, t) / inertia;
    relative = relative + sign * (extended(state->motion.velocity) +
                                  static_cast<Extended>(state->motion.yawRate) * left(arm));
    sign = -1.0L;
  }
  const Extended vn = inner(relative, n);
  const Extended vt = inner(relative, t);
  hit.point = plain(point);
  hit.normal = plain(n);
  const auto along = [&](Point p, Point q) { return inner(p, n) < inner(q, n); };
  const auto [low, high] = std::minmax_element(overlap.begin(), overlap.end(), along);
  hit.extent = static_cast<double>(inner(*high - *low, n));
  hit.approach = static_cast<double>(-vn);
  hit.slip = static_cast<double>(vt);
  hit.speed = static_cast<double>(std::hypot(vn, vt));
  if (vn >= 0.0L) return hit;
  const AttackDirection attack{.across = static_cast<double>(-vn),
                               .along = static_cast<double>(std::abs(vt))};
  const Extended e = settings.restitution(attack) *
                     std::min(1.0L, -vn / static_cast<Extended>(settings.restSpeed));
  const Extended mu = settings.friction(attack);
  const bool wholeImpulse = settings.restitutionKind == RestitutionKind::kudlich_slibar;
  const Extended leaving = wholeImpulse ? 0.0L : e;
  const Extended determinant = normalMobility * tangentMobility - coupling * coupling;
  const Extended stickingN =
      (-(1.0L + leaving) * vn * tangentMobility + coupling * vt) / determinant;
  const Extended stickingT =
      (-vt * normalMobility + (1.0L + leaving) * vn * coupling) / determinant;
  Extended ratio = stickingN > 0.0L ? stickingT / stickingN : (vt > 0.0L ? -mu : mu);
  hit.criticalRatio =
      stickingN > 0.0L ? static_cast<double>(ratio) : std::numeric_limits<double>::quiet_NaN();
  ratio = std::clamp(ratio, -mu, mu);
  Extended normalImpulse = -(1.0L + leaving) * vn / (normalMobility + ratio * coupling);
  if (wholeImpulse) normalImpulse *= 1.0L + e;
  hit.impulse = plain(normalImpulse * n + ratio * normalImpulse * t);
  return hit;
}

}  // namespace bumper::tests
