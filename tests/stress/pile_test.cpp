// Random encounters of two to eight vehicles among walls: nothing that is not finite, no energy or
// momentum out of nothing, no vehicle in another or in a wall.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "../response/random_pairs.h"
#include "bumper/response/island_step.h"
#include "extent.h"
#include "random_situations.h"

namespace bumper::tests {
namespace {

constexpr double energyTolerance = 1e-12;  // relative, per step: rounding

struct Pile {
  std::vector<VehicleParameters> vehicles;
  std::vector<PlanarMotion> motions;
  Plan plan;
  std::vector<Segment> walls;
  ResponseSettings settings;
};

void print(std::ostream& out, const Pile& pile) {
  const ResponseSettings& s = pile.settings;
  out << "law " << static_cast<int>(s.law) << ", angle " << static_cast<int>(s.angle) << ", e "
      << s.restitution(0.0) << " to " << s.restitution(1.57) << ", kind "
      << static_cast<int>(s.restitutionKind) << ", friction " << s.friction(0.0) << " to "
      << s.friction(1.57) << ", kind " << static_cast<int>(s.frictionKind) << ", P "
      << s.energyRemaining(0.0) << " to " << s.energyRemaining(1.57) << ", e_max "
      << s.maxRestitution << '\n';
  for (std::size_t i = 0; i < pile.vehicles.size(); ++i) {
    out << PairState{pile.vehicles[i], pile.motions[i]};
  }
  for (const Line& line : pile.plan) {
    out << "wall (" << line.start.transpose() << ") to (" << line.end.transpose() << ")\n";
  }
}

// Least depth of the overlap of two outlines, m; negative if they are apart.
double depthOf(const VehicleParameters& a, const PlanarMotion& motionA, const VehicleParameters& b,
               const PlanarMotion& motionB) {
  const Vector2 between = motionB.position - motionA.position;
  const double room = Outline(a).radius() + Outline(b).radius();
  if (between.squaredNorm() > room * room) return -1.0;
  const auto depth = [](const VehicleParameters& box, const PlanarMotion& at,
                        const VehicleParameters& other, const PlanarMotion& otherAt) {
    double front = -std::numeric_limits<double>::infinity();
    double rear = front;
    double left = front;
    double right = front;
    const Placement place = at.placement();
    const Placement otherPlace = otherAt.placement();
    for (const Vector2& corner : Outline(other).corners()) {
      const Vector2 p = place.local(otherPlace.position + otherPlace.turned(corner));
      front = std::max(front, box.massCentreToFront - p.x());
      rear = std::max(rear, box.massCentreToRear + p.x());
      left = std::max(left, 0.5 * box.width - p.y());
      right = std::max(right, 0.5 * box.width + p.y());
    }
    return std::min({front, rear, left, right});
  };
  return std::min(depth(a, motionA, b, motionB), depth(b, motionB, a, motionA));
}

Pile randomPile(Random& random) {
  constexpr double pi = 3.14159265358979;
  Pile pile;
  pile.settings = randomSettings(random);
  if (pile.settings.law == Law::restitution && random.chance(0.3)) {
    pile.settings.restitutionKind = RestitutionKind::kudlich_slibar;
  }
  const int count = 2 + random.below(7);
  const int walls = random.chance(0.4) ? 0 : 1 + random.below(4);
  for (int i = 0; i < walls; ++i) {
    const Vector2 start(random.uniform(-12.0, 12.0), random.uniform(-12.0, 12.0));
    pile.plan.push_back(
        {start, start + random.uniform(0.3, 12.0) * direction(random.uniform(-pi, pi))});
  }
  pile.walls = segmentsOf(pile.plan);
  for (int tries = 0; tries < 200 && static_cast<int>(pile.vehicles.size()) < count; ++tries) {
    const VehicleParameters vehicle =
        randomVehicle(random, {.leastMass = 5.0, .mostMass = 40'000.0});
    PlanarMotion motion{.position = {random.uniform(-12.0, 12.0), random.uniform(-12.0, 12.0)},
                        .yaw = random.uniform(-pi, pi)};
    if (deepestIntrusion(vehicle, motion, pile.plan) > 0.0) continue;
    bool isFree = true;
    for (std::size_t i = 0; i < pile.vehicles.size(); ++i) {
      isFree = isFree && depthOf(vehicle, motion, pile.vehicles[i], pile.motions[i]) < 0.0;
    }
    if (!isFree) continue;
    // To about the middle, each with half of what they close at.
    const Vector2 target(random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0));
    const Vector2 way = target - motion.position;
    motion.velocity = 0.5 * randomSpeed(random) * way.normalized();
    if (random.chance(0.7)) motion.yawRate = random.uniform(-20.0, 20.0);
    pile.vehicles.push_back(vehicle);
    pile.motions.push_back(motion);
  }
  return pile;
}

struct Faults {
  std::map<std::string, std::pair<int, std::string>> found;

  void note(const std::string& name, const std::function<void(std::ostream&)>& describe) {
    auto& [count, first] = found[name];
    if (count++ > 0) return;
    std::ostringstream out;
    describe(out);
    first = out.str();
  }
  void expectNone() const {
    for (const auto& [name, fault] : found) {
      ADD_FAILURE() << name << ", first of " << fault.first << ":\n" << fault.second;
    }
  }
};

// The velocity of one member from some time on.
struct Turn {
  double time = 0.0;
  Vector2 linear = Vector2::Zero();  // change, m/s
  double angular = 0.0;              // rad/s
};

class PileRun {
 public:
  PileRun(Pile pile, Faults& faults) : pile_(std::move(pile)), start_(pile_), faults_(faults) {
    for (std::size_t i = 0; i < pile_.vehicles.size(); ++i) {
      for (std::size_t k = i + 1; k < pile_.vehicles.size(); ++k) {
        IslandPair pair;
        pair.first = static_cast<int>(i);
        pair.second = static_cast<int>(k);
        pair.settings = &pile_.settings;
        pairs_.push_back(pair);
        fastest_.push_back(0.0);
      }
    }
    firstEnergy_ = energy();
    wallDepth_.resize(pile_.vehicles.size(), 0.0);
  }
  PileRun(const PileRun&) = delete;
  PileRun& operator=(const PileRun&) = delete;

  void step(IslandStep& island, double h, bool again) {
    const Surface surface{.settings = &pile_.settings};
    std::vector<IslandMember> members;
    for (std::size_t i = 0; i < pile_.vehicles.size(); ++i) {
      members.push_back({pile_.vehicles[i], pile_.motions[i], {pile_.walls, {&surface, 1}}});
    }
    h_ = h;
    ++number_;
    noteSpeeds(pile_.motions);
    const double before = energy();
    island.resolve(members, pairs_, h);
    impacts += static_cast<int>(island.pairImpacts().size());
    std::vector<StepOutcome> outcomes;
    std::vector<PlanarMotion> after;
    bool settled = true;
    bool walls = false;
    bool shifted = false;
    for (std::size_t i = 0; i < members.size(); ++i) {
      outcomes.push_back(island.outcome(i));
      after.push_back(outcomes[i].after);
      settled = settled && outcomes[i].settled;
      walls = walls || !outcomes[i].impacts.empty();
      wallImpacts += static_cast<int>(outcomes[i].impacts.size());
      shifted = shifted || outcomes[i].shift.velocity != Vector2::Zero() ||
                outcomes[i].shift.yawRate != 0.0;
    }
    if (!settled) ++unsettled;
    ++steps;
    // Who is held is held while others come: no depth can be said from then on.
    wasHeld_ = wasHeld_ || !settled;
    const std::vector<PlanarMotion> from = pile_.motions;
    checkPath(from, outcomes, island.pairImpacts(), settled);
    pile_.motions = after;
    noteSpeeds(pile_.motions);
    for (std::size_t i = 0; i < after.size(); ++i) {
      if (!isFinite(after[i])) note("not finite");
      if (!settled && leadsThrough(from[i].position, after[i].position, pile_.plan)) {
        note("through a wall while held");
      }
    }
    const double gained = (energy() - before) / firstEnergy_;
    worstGain = std::max(worstGain, gained);
    if (gained > energyTolerance) note("energy created", gained);
    if (!walls) checkMomentum(from, shifted || !settled);
    checkDepths(pile_.motions, "");
    if (again) {
      IslandStep other;
      other.resolve(members, pairs_, h);
      for (std::size_t i = 0; i < members.size(); ++i) {
        const PlanarMotion& a = other.outcome(i).after;
        const PlanarMotion& b = after[i];
        if (a.position != b.position || a.velocity != b.velocity || a.yaw != b.yaw ||
            a.yawRate != b.yawRate) {
          note("depends on what was resolved before");
        }
      }
    }
  }

  int impacts = 0;
  int wallImpacts = 0;
  int steps = 0;
  int unsettled = 0;
  double worstGain = 0.0;
  double worstMomentum = 0.0;
  double worstDepth = 0.0;   // over what is allowed
  double worstInWall = 0.0;  // m

 private:
  [[nodiscard]] double energy() const {
    double sum = 0.0;
    for (std::size_t i = 0; i < pile_.vehicles.size(); ++i) {
      sum += yawPlaneEnergy(pile_.motions[i], pile_.vehicles[i].mass, pile_.vehicles[i].yawInertia);
    }
    return sum;
  }

  void note(const std::string& name, double figure = 0.0) {
    faults_.note(name, [&](std::ostream& out) {
      print(out, start_);
      out << "in step " << number_ << " of " << h_ << " s: " << figure << ", before it\n";
      print(out, pile_);
    });
  }

  // How fast the points of each pair, and of each vehicle, may have moved past each other.
  void noteSpeeds(const std::vector<PlanarMotion>& motions) {
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
      double speed = 0.0;
      const auto i = static_cast<std::size_t>(pairs_[p].first);
      const auto k = static_cast<std::size_t>(pairs_[p].second);
      speed = (motions[i].velocity - motions[k].velocity).norm();
      for (const std::size_t each : {i, k}) {
        speed += std::abs(motions[each].yawRate) * Outline(pile_.vehicles[each]).radius();
      }
      fastest_[p] = std::max(fastest_[p], speed);
    }
    for (std::size_t i = 0; i < wallDepth_.size(); ++i) {
      wallDepth_[i] = std::max(wallDepth_[i], slidingDepth(pile_.vehicles[i], motions[i], h_));
    }
  }

  void checkDepths(const std::vector<PlanarMotion>& motions, const char* when) {
    if (wasHeld_) return;
    // Of the way in the penetration time: of two alone. A third one, or a wall, may press two into
    // each other, as a lorry does with a small thing that it jams: the goal is 0.6 there too, 1.2
    // was seen in 300,000 piles, and the worst is printed.
    const bool areAlone = motions.size() == 2 && wallImpacts == 0;
    const double share = areAlone ? 0.6 : 1.5;
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
      const auto i = static_cast<std::size_t>(pairs_[p].first);
      const auto k = static_cast<std::size_t>(pairs_[p].second);
      const double depth = depthOf(pile_.vehicles[i], motions[i], pile_.vehicles[k], motions[k]);
      const double allowed = 1e-6 + share * fastest_[p] * pile_.settings.penetrationTime;
      worstDepth = std::max(worstDepth, depth / allowed);
      if (depth > allowed) note(std::string("one in another") + when, depth);
    }
    for (std::size_t i = 0; i < motions.size(); ++i) {
      const double inside = deepestIntrusion(pile_.vehicles[i], motions[i], pile_.plan);
      worstInWall = std::max(worstInWall, inside);
      const double feature =
          ResponseSettings{}.smallestFeature *
          (pile_.vehicles[i].massCentreToFront + pile_.vehicles[i].massCentreToRear);
      if (inside > wallDepth_[i] + feature) note(std::string("one in a wall") + when, inside);
    }
  }

  // Free flight from impact to impact, which must lead to where the outcome is, through no wall.
  void checkPath(const std::vector<PlanarMotion>& from, const std::vector<StepOutcome>& outcomes,
                 std::span<const PairImpact> pairImpacts, bool settled) {
    std::vector<std::vector<Turn>> turns(from.size());
    std::vector<double> times{h_};
    const auto add = [&](std::size_t member, const StepImpact& impact, bool other) {
      const ImpactResponse& r = impact.response;
      const VehicleParameters& vehicle = pile_.vehicles[member];
      const double sign = other ? -1.0 : 1.0;
      const double angular = other ? -cross(impact.impact.otherArm, r.impulse.linear)
                                   : cross(impact.impact.arm, r.impulse.linear);
      turns[member].push_back(
          {impact.time, sign * r.impulse.linear / vehicle.mass, angular / vehicle.yawInertia});
      times.push_back(impact.time);
    };
    for (std::size_t i = 0; i < from.size(); ++i) {
      for (const StepImpact& each : outcomes[i].impacts) add(i, each, false);
    }
    for (const PairImpact& each : pairImpacts) {
      const IslandPair& pair = pairs_[static_cast<std::size_t>(each.pair)];
      add(static_cast<std::size_t>(pair.first), each, false);
      add(static_cast<std::size_t>(pair.second), each, true);
    }
    std::ranges::sort(times);
    std::vector<PlanarMotion> now = from;
    double time = 0.0;
    for (std::size_t i = 0; i < now.size(); ++i) {
      std::ranges::stable_sort(turns[i], {}, &Turn::time);
    }
    std::vector<std::size_t> next(now.size(), 0);
    for (const double until : times) {
      for (std::size_t i = 0; i < now.size(); ++i) {
        const Vector2 before = now[i].position;
        now[i] = advanced(now[i], until - time);
        // One that is held in the step's course does not go this way.
        if (settled && leadsThrough(before, now[i].position, pile_.plan)) note("through a wall");
        while (next[i] < turns[i].size() && turns[i][next[i]].time <= until) {
          now[i].velocity += turns[i][next[i]].linear;
          now[i].yawRate += turns[i][next[i]].angular;
          ++next[i];
        }
      }
      noteSpeeds(now);
      if (until > time && settled) checkDepths(now, " within the step");
      time = until;
    }
    if (!settled) return;
    for (std::size_t i = 0; i < now.size(); ++i) {
      const PlanarMotion& after = outcomes[i].after;
      const StepShift& shift = outcomes[i].shift;
      const double scale = 1.0 + from[i].velocity.norm() + now[i].velocity.norm();
      if (!((now[i].position + h_ * shift.velocity - after.position).norm() <= 1e-9) ||
          !(std::abs(now[i].yaw + h_ * shift.yawRate - after.yaw) <= 1e-8) ||
          !((now[i].velocity - after.velocity).norm() <= 1e-9 * scale)) {
        note("not where the impulses lead",
             (now[i].position + h_ * shift.velocity - after.position).norm());
      }
    }
  }

  void checkMomentum(const std::vector<PlanarMotion>& from, bool shifted) {
    Vector2 linear = Vector2::Zero();
    double angular = 0.0;
    double linearScale = 0.0;
    double angularScale = 0.0;
    for (std::size_t i = 0; i < from.size(); ++i) {
      const double mass = pile_.vehicles[i].mass;
      const double inertia = pile_.vehicles[i].yawInertia;
      const PlanarMotion& a = from[i];
      const PlanarMotion& b = pile_.motions[i];
      linear += mass * (b.velocity - a.velocity);
      angular += mass * (cross(b.position, b.velocity) - cross(a.position, a.velocity)) +
                 inertia * (b.yawRate - a.yawRate);
      linearScale += mass * (a.velocity.norm() + b.velocity.norm());
      angularScale += mass * (a.position.norm() + b.position.norm() + 1.0) *
                          (a.velocity.norm() + b.velocity.norm()) +
                      inertia * (std::abs(a.yawRate) + std::abs(b.yawRate));
    }
    double off = linear.norm() / linearScale;
    if (!shifted) off = std::max(off, std::abs(angular) / angularScale);
    worstMomentum = std::max(worstMomentum, off);
    if (off > 1e-12) note("momentum lost", off);
  }

  Pile pile_;
  Pile start_;
  Faults& faults_;
  std::vector<IslandPair> pairs_;
  std::vector<double> fastest_;    // m/s, of pairs
  std::vector<double> wallDepth_;  // m, that each may have come into a wall
  double firstEnergy_ = 0.0;
  bool wasHeld_ = false;
  double h_ = 0.0;
  int number_ = 0;
};

TEST(MillionImpacts, OfPiles) {
  Random random(20061);
  Faults faults;
  IslandStep island;
  long long impacts = 0;
  long long wallImpacts = 0;
  long long steps = 0;
  long long unsettled = 0;
  double gain = 0.0;
  double momentum = 0.0;
  double depth = 0.0;
  double inWall = 0.0;
  for (int i = 0; i < extent(20'000, 300'000); ++i) {
    Pile pile = randomPile(random);
    if (pile.vehicles.size() < 2) continue;
    PileRun run(std::move(pile), faults);
    const double h = randomStep(random);
    for (int k = 0; k < 12; ++k) run.step(island, h, i % 10 == 0);
    impacts += run.impacts;
    wallImpacts += run.wallImpacts;
    steps += run.steps;
    unsettled += run.unsettled;
    gain = std::max(gain, run.worstGain);
    momentum = std::max(momentum, run.worstMomentum);
    depth = std::max(depth, run.worstDepth);
    inWall = std::max(inWall, run.worstInWall);
  }
  std::printf(
      "[ figures  ] %lld impacts of vehicles, %lld with walls in %lld steps, %lld unsettled; "
      "energy "
      "%.2g, momentum %.2g, depth %.2g of that allowed, in a wall %.2g m\n",
      impacts, wallImpacts, steps, unsettled, gain, momentum, depth, inWall);
  faults.expectNone();
  // The bound on impacts in a step is for freaks.
  EXPECT_LE(unsettled, steps / 2'000);
}

}  // namespace
}  // namespace bumper::tests
