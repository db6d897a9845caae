// Random impacts of every kind, one million of them: nothing that is not finite, no energy out of
// nothing, no wall crossed.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "bumper/engine_adapter/responder.h"
#include "bumper/response/collision_step.h"
#include "extent.h"
#include "ode_joints.h"
#include "ode_world.h"
#include "random_situations.h"

namespace bumper::tests {
namespace {

constexpr double energyTolerance = 1e-12;  // relative, per impact: rounding

// What may not happen, counted, with the first case of each.
struct Fault {
  std::string name;
  int count = 0;
  std::string first;

  void note(const std::function<void(std::ostream&)>& describe) {
    if (count++ > 0) return;
    std::ostringstream out;
    describe(out);
    first = out.str();
  }
};

struct Faults {
  Fault notFinite{.name = "not finite", .first = {}};
  Fault energy{.name = "energy created", .first = {}};
  Fault path{.name = "not where the impulses lead", .first = {}};
  Fault through{.name = "mass centre through a wall", .first = {}};
  Fault inside{.name = "outline in a wall", .first = {}};
  Fault stopped{.name = "stopped by a slow touch", .first = {}};
  double worstEnergy = 0.0;
  double worstInside = 0.0;

  void expectNone() const {
    for (const Fault* fault : {&notFinite, &energy, &path, &through, &inside, &stopped}) {
      EXPECT_EQ(fault->count, 0) << fault->name << ", first of " << fault->count << ":\n"
                                 << fault->first;
    }
    std::printf("[ figures  ] energy created at most %.3g, outline in a wall at most %.3g m\n",
                worstEnergy, worstInside);
  }
};

// One step, checked impact by impact against free flight from one to the next. `mostInside` is how
// deep the outline may have come into a wall so far.
void check(const VehicleParameters& vehicle, const PlanarMotion& start, double h, const Plan& plan,
           const StepOutcome& outcome, double& mostInside, Faults& faults) {
  const auto describe = [&](std::ostream& out) {
    printExactly(out, vehicle, start, plan) << "step " << h << ", impacts:\n";
    for (const StepImpact& each : outcome.impacts) {
      out << "  at " << each.time << " wall " << each.impact.wall << " normal ("
          << each.impact.normal.transpose() << ") arm (" << each.impact.arm.transpose()
          << ") approach " << each.response.approachSpeed << " energy ratio "
          << each.response.energyRatio << '\n';
    }
    out << "after: position (" << outcome.after.position.transpose() << "), velocity ("
        << outcome.after.velocity.transpose() << "), yaw " << outcome.after.yaw << ", yaw rate "
        << outcome.after.yawRate << ", settled " << outcome.settled << ", shifted by ("
        << outcome.shift.velocity.transpose() << ") m/s, " << outcome.shift.yawRate
        << " rad/s, then " << deepestIntrusion(vehicle, outcome.after, plan) << " m in a wall\n";
  };

  PlanarMotion motion = start;
  double time = 0.0;
  const auto fly = [&](double until, const StepShift& shift) {
    const Vector2 before = motion.position;
    motion.position += (until - time) * motion.velocity + h * shift.velocity;
    motion.yaw += (until - time) * motion.yawRate + h * shift.yawRate;
    time = until;
    if (leadsThrough(before, motion.position, plan)) faults.through.note(describe);
  };
  double before = -1.0;  // energy, of an impulse that is told in parts before the first of them
  for (const StepImpact& each : outcome.impacts) {
    if (!(each.time >= time && each.time <= h)) faults.path.note(describe);
    fly(each.time, {});
    if (before < 0.0) before = yawPlaneEnergy(motion, vehicle.mass, vehicle.yawInertia);
    const PlanarMotion next =
        afterImpulse(motion, each.response.impulse, vehicle.mass, vehicle.yawInertia);
    if (!isFinite(next) || !std::isfinite(each.response.contact.impulse.normal)) {
      faults.notFinite.note(describe);
    }
    if (!each.isPartOfNext) {
      const double after = yawPlaneEnergy(next, vehicle.mass, vehicle.yawInertia);
      const double created = before > 0.0 ? after / before - 1.0 : 0.0;
      faults.worstEnergy = std::max(faults.worstEnergy, created);
      if (created > energyTolerance) faults.energy.note(describe);
      before = -1.0;
    }
    motion.velocity = next.velocity;
    motion.yawRate = next.yawRate;
    mostInside = std::max(mostInside, slidingDepth(vehicle, motion, h));
  }
  if (!outcome.settled) {
    // The impulse that ends an endless row of them must not end the ride.
    const ImpactResponse& last = outcome.impacts.back().response;
    const double taken = last.before.velocity.norm() - last.after.velocity.norm();
    if (taken > 1.0 + 10.0 * std::max(0.0, last.approachSpeed)) faults.stopped.note(describe);
  }
  fly(h, outcome.shift);
  if (!isFinite(outcome.after)) faults.notFinite.note(describe);
  const double speed = start.velocity.norm() + 5.0 * std::abs(start.yawRate);
  const double pathTolerance = 1e-9 + 1e-12 * speed;
  if (!((outcome.after.position - motion.position).norm() <= pathTolerance) ||
      !((outcome.after.velocity - motion.velocity).norm() <= 1e-12 * (1.0 + speed)) ||
      !(std::abs(outcome.after.yaw - motion.yaw) <= 1e-9)) {
    faults.path.note(describe);
  }
  const double inside = deepestIntrusion(vehicle, outcome.after, plan);
  faults.worstInside = std::max(faults.worstInside, inside);
  mostInside = std::max(
      {mostInside, slidingDepth(vehicle, start, h), slidingDepth(vehicle, outcome.after, h)});
  // What is exposed by less than a smallest feature in front of another wall does not catch.
  const double feature =
      ResponseSettings{}.smallestFeature * (vehicle.massCentreToFront + vehicle.massCentreToRear);
  if (inside > mostInside + feature) faults.inside.note(describe);
}

TEST(MillionImpacts, OfACollisionStep) {
  Random random(20031);
  Faults faults;
  CollisionStep collision;
  int impacts = 0;
  int steps = 0;
  int unsettled = 0;
  for (int i = 0; impacts < extent(20'000, 1'000'000); ++i) {
    const VehicleParameters vehicle = randomVehicle(random);
    const Plan plan = randomPlan(random, static_cast<Layout>(i % layouts));
    const ResponseSettings settings = randomSettings(random);
    const Surface surface{.settings = &settings};
    const std::vector<Segment> walls = segmentsOf(plan);
    const double mostStep = randomStep(random);
    std::optional<PlanarMotion> motion = randomApproach(random, vehicle, plan, mostStep);
    if (!motion) continue;
    double mostInside = 0.0;
    for (int k = 0; k < 12; ++k) {
      const double h = random.chance(0.5) ? mostStep : randomStep(random);
      const StepOutcome outcome = collision.resolve(vehicle, *motion, {walls, {&surface, 1}}, h);
      check(vehicle, *motion, h, plan, outcome, mostInside, faults);
      impacts += static_cast<int>(outcome.impacts.size());
      ++steps;
      if (!outcome.settled) ++unsettled;
      *motion = outcome.after;
    }
  }
  faults.expectNone();
  std::printf("[ figures  ] %d impacts in %d steps, %d of them unsettled\n", impacts, steps,
              unsettled);
  // The bound on impacts in a step is for freaks.
  EXPECT_LE(unsettled, steps / 10'000);
}

// Through ODE: each wall as quads with degenerate and sliver triangles among them.
Scene withBadTriangles(Random& random, Scene scene) {
  const std::size_t count = scene.triangles.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Scene::Triangle triangle = scene.triangles[i];
    const auto [a, b, c] = triangle.corners;
    switch (random.below(4)) {
      case 0:  // a point
        scene.triangles.push_back({.corners = {a, a, a}, .mesh = 0});
        break;
      case 1: {  // a line
        const auto middle = static_cast<std::uint32_t>(scene.vertices.size());
        scene.vertices.emplace_back(0.5 * (scene.vertices[a] + scene.vertices[b]));
        scene.triangles.push_back({.corners = {a, middle, b}, .mesh = 0});
        break;
      }
      case 2: {  // a sliver along an edge, in the wall's plane
        const auto beside = static_cast<std::uint32_t>(scene.vertices.size());
        const double share = std::pow(10.0, random.uniform(-9.0, -3.0));
        scene.vertices.emplace_back(scene.vertices[b] +
                                    share * (scene.vertices[c] - scene.vertices[b]));
        scene.triangles.push_back({.corners = {a, b, beside}, .mesh = 0});
        break;
      }
      default:
        break;
    }
  }
  std::shuffle(scene.triangles.begin(), scene.triangles.end(), random.engine());
  return scene;
}

struct OdeCase {
  Plan plan;
  ResponseSettings settings;
  PlanarMotion start;
  double h = 0.0;
};

std::optional<OdeCase> randomOdeCase(Random& random, const VehicleParameters& vehicle, int number) {
  OdeCase result;
  result.plan = randomPlan(random, static_cast<Layout>(number % layouts));
  if (number % layouts == static_cast<int>(Layout::slivers)) {
    // ODE's own mesh cannot have walls of 1e-9 m; Scene's triangles are cut up below.
    result.plan = {{result.plan.front().start, result.plan.back().end}};
  }
  result.settings = randomSettings(random);
  result.h = randomStep(random);
  const std::optional<PlanarMotion> start = randomApproach(random, vehicle, result.plan, result.h);
  if (!start) return std::nullopt;
  result.start = *start;
  return result;
}

TEST(MillionImpacts, ThroughOde) {
  Random random(20032);
  Faults faults;
  int impacts = 0;
  OdeWorld ode;
  BoxCar car(ode.world);
  for (int i = 0; impacts < extent(2'000, 50'000); ++i) {
    const std::optional<OdeCase> given = randomOdeCase(random, car.parameters, i);
    if (!given) continue;
    const Scene scene = withBadTriangles(
        random, standing(given->plan, 1.0, 1 + static_cast<std::size_t>(random.below(4)), 1));
    Responder responder(ode.world, {.response = given->settings});
    responder.addBarrier(scene);
    responder.addVehicle(car.body, car.parameters);
    place(car, given->start);
    double energy = lawEnergyOf(car, responder);
    const double energyAtStart = energy;
    double mostInside = 0.0;
    for (int k = 0; k < 12; ++k) {
      const PlanarMotion before = motionOf(car.body);
      double ratio = 0.0;
      for (const ImpactEvent& event : responder.step(given->h)) {
        if (event.phase != EventPhase::impact) continue;
        ++impacts;
        ratio = std::max(ratio, event.energyRatio);
      }
      dWorldQuickStep(ode.world, given->h);
      const PlanarMotion now = motionOf(car.body);
      const double energyBefore = energy;
      energy = lawEnergyOf(car, responder);
      // As a speed: a car that has lost all but 1e-6 m/s still carries the rounding of what it had.
      const double gained =
          (std::sqrt(energy) - std::sqrt(energyBefore)) / std::sqrt(energyAtStart);
      const auto describe = [&](std::ostream& out) {
        printExactly(out, car.parameters, given->start, given->plan)
            << "step " << given->h << ", in step " << k << " from position ("
            << before.position.transpose() << "), yaw " << before.yaw << ", velocity ("
            << before.velocity.transpose() << "), yaw rate " << before.yawRate << " to position ("
            << now.position.transpose() << "), yaw " << now.yaw << "; energy ratio of an impact "
            << ratio << ", speed grown by " << gained << " of the first\n";
      };
      if (!isFinite(now)) {
        faults.notFinite.note(describe);
        break;
      }
      if (gained > energyTolerance || ratio > 1.0 + energyTolerance) faults.energy.note(describe);
      faults.worstEnergy = std::max(faults.worstEnergy, gained);
      if (leadsThrough(before.position, now.position, given->plan)) faults.through.note(describe);
      const double inside = deepestIntrusion(car.parameters, now, given->plan);
      faults.worstInside = std::max(faults.worstInside, inside);
      mostInside = std::max({mostInside, slidingDepth(car.parameters, before, given->h),
                             slidingDepth(car.parameters, now, given->h)});
      if (inside > mostInside) faults.inside.note(describe);
    }
  }
  faults.expectNone();
}

// The same cases, with ODE's contact joints instead.
TEST(MillionImpacts, ContactJointsCreateEnergyAndLetCarsThrough) {
  Random random(20032);
  OdeWorld unused;
  const BoxCar car(unused.world);
  int cases = 0;
  int gained = 0;
  int through = 0;
  int inside = 0;
  for (int i = 0; cases < extent(300, 3'000); ++i) {
    const std::optional<OdeCase> given = randomOdeCase(random, car.parameters, i);
    if (!given) continue;
    ++cases;
    const JointRun run = runWithJoints(
        given->plan, given->start,
        {.step = given->h, .duration = std::max(0.3, 12.0 * given->h), .bounce = 0.3});
    gained += run.mostEnergy > 1.01 ? 1 : 0;
    through += run.ledThrough ? 1 : 0;
    inside += run.deepest > 0.1 ? 1 : 0;
  }
  std::printf(
      "[ figures  ] joints, of %d: %d gained energy, %d led through, %d over 10 cm inside\n", cases,
      gained, through, inside);
  EXPECT_GT(gained, 0);
  EXPECT_GT(through, cases / 50);
  EXPECT_GT(inside, cases / 10);
}

}  // namespace
}  // namespace bumper::tests
