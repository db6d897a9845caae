#include "pair_scan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>

#include "bumper/response/island_step.h"
#include "bumper/response/pair.h"

namespace bumper::tests {
namespace {

constexpr double oneDegree = std::numbers::pi / 180.0;
constexpr double scanStep = 0.005;  // s

/// Velocities, m/s, and yaw rates, rad/s, of both after it: means of the last tenth of a second, as
/// an impact that just falls within the time is no jump.
using After = std::array<double, 6>;

constexpr double meanOver = 0.1;  // s

After whatFollows(const Meeting& e) {
  static const ResponseSettings settings;
  const double room = Outline(e.first).radius() + Outline(e.second).radius();
  std::array<IslandMember, 2> members;
  members[0].vehicle = e.first;
  members[1].vehicle = e.second;
  members[0].motion = {.position = {-room - 0.01, 0.0},
                       .yaw = e.firstYaw * oneDegree,
                       .velocity = {e.speed, 0.0},
                       .yawRate = e.firstYawRate};
  members[1].motion = {
      .position = {0.0, e.offset}, .yaw = e.heading * oneDegree, .yawRate = e.secondYawRate};
  // Past each other without a hit, and more.
  const double duration = 2.0 * room / e.speed + meanOver;
  const auto both = [](const PlanarMotion& a, const PlanarMotion& b) {
    return After{a.velocity.x(), a.velocity.y(), a.yawRate,
                 b.velocity.x(), b.velocity.y(), b.yawRate};
  };
  if (!e.whole) {
    const auto hit = respondPair({e.first, members[0].motion}, {e.second, members[1].motion},
                                 settings, duration);
    return hit ? both(hit->response.after, hit->response.otherAfter)
               : both(members[0].motion, members[1].motion);
  }
  IslandStep step;
  IslandPair pair;
  pair.second = 1;
  pair.settings = &settings;
  const int steps = static_cast<int>(duration / scanStep);
  const int last = static_cast<int>(meanOver / scanStep);
  std::array<PlanarMotion, 2> earlier;
  for (int i = 0; i < steps; ++i) {
    if (i == steps - last) earlier = {members[0].motion, members[1].motion};
    step.resolve(members, {&pair, 1}, scanStep);
    for (std::size_t k = 0; k < 2; ++k) members[k].motion = step.outcome(k).after;
  }
  for (std::size_t k = 0; k < 2; ++k) {
    earlier[k].velocity = (members[k].motion.position - earlier[k].position) / meanOver;
    earlier[k].yawRate = (members[k].motion.yaw - earlier[k].yaw) / meanOver;
  }
  return both(earlier[0], earlier[1]);
}

/// How much two results differ: in °/s, and in thousandths of the speed.
double jump(const After& a, const After& b, double speed) {
  double most = 0.0;
  for (const std::size_t k : {0U, 3U}) {
    most = std::max({most, std::hypot(a[k] - b[k], a[k + 1] - b[k + 1]) / (1e-3 * speed),
                     std::abs(a[k + 2] - b[k + 2]) / oneDegree});
  }
  return most;
}

/// The steepest place between two, by halving down to 1e-9 of °  or m.
double trueJump(Meeting e, double Meeting::*parameter, double low, double high, After atLow,
                After atHigh, double limit, double& place) {
  double now = jump(atLow, atHigh, e.speed);
  while (high - low > 1e-9 && now > limit) {
    e.*parameter = 0.5 * (low + high);
    const After middle = whatFollows(e);
    const double lower = jump(atLow, middle, e.speed);
    const double upper = jump(middle, atHigh, e.speed);
    if (lower > upper) {
      high = e.*parameter;
      atHigh = middle;
      now = lower;
    } else {
      low = e.*parameter;
      atLow = middle;
      now = upper;
    }
  }
  place = 0.5 * (low + high);
  return now;
}

}  // namespace

std::ostream& operator<<(std::ostream& out, const Meeting& e) {
  out.precision(12);
  return out << e.first.mass << " kg at " << e.speed << " m/s, yaw " << e.firstYaw << " deg, "
             << e.firstYawRate << " rad/s, on " << e.second.mass << " kg, heading " << e.heading
             << " deg, " << e.secondYawRate << " rad/s, offset " << e.offset << " m"
             << (e.whole ? "" : ", first impact");
}

ScanResult scan(Meeting e, double Meeting::*parameter, double from, double to, double by,
                double limit) {
  ScanResult result;
  e.*parameter = from;
  After last = whatFollows(e);
  const int cells = static_cast<int>(std::lround((to - from) / by));
  for (int i = 1; i <= cells; ++i) {
    const double high = from + i * by;
    e.*parameter = high;
    const After next = whatFollows(e);
    ++result.cells;
    if (jump(last, next, e.speed) > limit) {
      double place = high;
      const double found = trueJump(e, parameter, high - by, high, last, next, limit, place);
      if (found > limit) ++result.jumps;
      if (found > limit && found > result.worst) {
        e.*parameter = place;
        std::ostringstream where;
        where << e;
        result.worst = found;
        result.where = where.str();
      }
    }
    last = next;
  }
  return result;
}

}  // namespace bumper::tests
