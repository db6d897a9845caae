// Along a curved rail at 30 m/s for kilometres: a polygon, driven round inside and outside.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bumper/engine_adapter/responder.h"
#include "extent.h"
#include "ode_joints.h"
#include "ode_world.h"

namespace bumper::tests {
namespace {

constexpr double radius = 100.0;  // m
constexpr double cruise = 30.0;   // m/s
constexpr double lean = 1.0;      // m/s²: the push against an outside rail beyond the centripetal

enum class Side { inside, outside };

struct Scrape {
  Side side;
  double bend;         // deg from panel to panel
  double restitution;  // < 0: the paper's curve
  double friction;
  double step;  // s
};

void PrintTo(const Scrape& scrape, std::ostream* out) {
  *out << (scrape.side == Side::inside ? "inside" : "outside") << ", panels of " << scrape.bend
       << "°, e " << scrape.restitution << ", μ " << scrape.friction << ", " << 1e3 * scrape.step
       << " ms";
}

ResponseSettings settingsOf(const Scrape& scrape) {
  ResponseSettings settings;
  if (scrape.restitution >= 0.0) {
    settings.restitution = AngleCurve::constant(scrape.restitution);
    settings.friction = AngleCurve::constant(scrape.friction);
  }
  return settings;
}

Plan railOf(const Scrape& scrape) {
  return polygon(radius, static_cast<std::size_t>(std::lround(360.0 / scrape.bend)));
}

PlanarMotion startOf(const Scrape& scrape) {
  // Beside the middle of a panel, 2 cm off it, tangentially; the corners of the outline stand out.
  const double half = 0.5 * scrape.bend * std::numbers::pi / 180.0;
  const double face = radius * std::cos(half);
  const double away =
      scrape.side == Side::inside ? std::sqrt(face * face - 2.6 * 2.6) - 0.92 : radius + 0.92;
  return {.position = away * rotated(Vector2::UnitX(), half),
          .yaw = half + 0.5 * std::numbers::pi,
          .velocity = cruise * rotated(Vector2::UnitY(), half),
          .yawRate = cruise / radius};
}

/// The application's own forces: a motor that holds the speed and can push as hard as friction and
/// the bends slow down, and outside a steady push against the rail.
struct Motor {
  Side side;
  double mass;
  double most;  // m/s²

  [[nodiscard]] Vector2 force(const PlanarMotion& motion) const {
    const Vector2 outward = motion.position.normalized();
    const double along = motion.velocity.dot(turnedLeft(outward));
    Vector2 force = mass * std::clamp(10.0 * (cruise - along), 0.0, most) * turnedLeft(outward);
    if (side == Side::outside) {
      force -= mass * (cruise * cruise / radius + lean) * outward;
    }
    return force;
  }
};

// What the rail may take at most, m/s², of a car of 30 m/s that it turns by its curve: friction on
// a push of v²/r (+ lean), and the loss of the speed across each bend, v sin(bend).
double mostSlowing(const Scrape& scrape) {
  const double bend = scrape.bend * std::numbers::pi / 180.0;
  const double push = cruise * cruise / radius + (scrape.side == Side::outside ? lean : 0.0);
  const double bendsPerSecond = cruise / (radius * bend);
  const double friction = scrape.restitution < 0.0 ? 0.3 : scrape.friction;
  return friction * push + bendsPerSecond * cruise * (1.0 - std::cos(bend));
}

class Scraping : public ::testing::TestWithParam<Scrape> {};

TEST_P(Scraping, NeitherCatchesNorGainsNorSinksIn) {
  const Scrape scrape = GetParam();
  const Plan rail = railOf(scrape);
  OdeWorld ode;
  Responder responder(ode.world, {.response = settingsOf(scrape)});
  responder.addBarrier(standing(rail));
  BoxCar car(ode.world);
  responder.addVehicle(car.body, car.parameters);
  place(car, startOf(scrape));
  const Motor motor{
      .side = scrape.side, .mass = car.parameters.mass, .most = 1.25 * mostSlowing(scrape) + 0.5};

  double energy = lawEnergyOf(car, responder);
  double mostGained = 0.0;  // in one step, beyond the motor's work, relative
  double slowest = cruise;
  double largestLoss = 0.0;  // m/s, in one step
  double deepest = 0.0;
  double mostYawed = 0.0;  // rad against the rail
  double way = 0.0;
  std::size_t events = 0;
  unsigned issues = 0;
  PlanarMotion before = motionOf(car.body);
  bool through = false;
  const double wayInAll = extent(500.0, 10'000.0);  // m
  while (way < wayInAll && slowest > 1.0) {
    const Vector2 force = motor.force(before);
    const Vector2 push = scrape.step / car.parameters.mass * force;
    const double work =
        car.parameters.mass * push.dot(lawMotionOf(car, responder).velocity + 0.5 * push);
    dBodyAddForce(car.body, force.x(), force.y(), 0.0);
    events += responder.step(scrape.step).size();
    issues |= responder.issues();
    dWorldQuickStep(ode.world, scrape.step);
    const PlanarMotion now = motionOf(car.body);
    const double energyBefore = energy + work;
    energy = lawEnergyOf(car, responder);
    mostGained = std::max(mostGained, energy / energyBefore - 1.0);
    slowest = std::min(slowest, now.velocity.norm());
    largestLoss = std::max(largestLoss, before.velocity.norm() - now.velocity.norm());
    deepest = std::max(deepest, deepestIntrusion(car.parameters, now, rail));
    const Vector2 tangent = turnedLeft(now.position.normalized());
    const Vector2 ahead = rotated(Vector2::UnitX(), now.yaw);
    mostYawed =
        std::max(mostYawed, std::abs(std::atan2(cross(tangent, ahead), tangent.dot(ahead))));
    way += (now.position - before.position).norm();
    through = through || leadsThrough(before.position, now.position, rail);
    before = now;
  }
  EXPECT_FALSE(through);
  EXPECT_LE(mostGained, 1e-11);  // rounding of a step
  // No catch: the motor, a quarter stronger than what the rail may take, holds the speed.
  EXPECT_GE(slowest, 0.9 * cruise);
  EXPECT_LE(deepest, 1e-3);
  EXPECT_EQ(issues, step_issue::none);
  std::printf(
      "[ figures  ] gained %.3g, slowest %.3f m/s, largest loss %.3f m/s a step, deepest %.4g "
      "mm, "
      "yawed %.3f deg, %zu events, issues %u\n",
      mostGained, slowest, largestLoss, 1e3 * deepest, mostYawed * 180.0 / std::numbers::pi, events,
      issues);
}

INSTANTIATE_TEST_SUITE_P(Rails, Scraping,
                         ::testing::Values(Scrape{Side::inside, 1.0, -1.0, 0.0, 0.005},
                                           Scrape{Side::inside, 5.0, -1.0, 0.0, 0.005},
                                           Scrape{Side::inside, 1.0, 0.0, 0.3, 0.005},
                                           Scrape{Side::inside, 5.0, 0.2, 0.1, 0.005},
                                           Scrape{Side::inside, 5.0, 0.2, 0.1, 0.02},
                                           Scrape{Side::outside, 1.0, -1.0, 0.0, 0.005},
                                           Scrape{Side::outside, 5.0, -1.0, 0.0, 0.005},
                                           Scrape{Side::outside, 1.0, 0.0, 0.3, 0.005},
                                           Scrape{Side::outside, 5.0, 0.2, 0.1, 0.005},
                                           Scrape{Side::outside, 5.0, 0.2, 0.1, 0.02}),
                         [](const auto& each) {
                           const Scrape& scrape = each.param;
                           std::ostringstream name;
                           name << (scrape.side == Side::inside ? "Inside" : "Outside")
                                << scrape.bend << "deg" << 1e3 * scrape.step << "ms";
                           if (scrape.restitution < 0.0) {
                             name << "Curves";
                           } else {
                             name << "E" << 100.0 * scrape.restitution;
                           }
                           return name.str();
                         });

// Contact joints catch on the edges between panels: one step takes what minutes of scraping may.
TEST(ScrapingWithContactJoints, Catches) {
  double largestLoss = 0.0;
  double topRise = 0.0;
  double mostEnergy = 0.0;
  for (const Side side : {Side::inside, Side::outside}) {
    const Scrape scrape{side, 1.0, 0.0, 0.3, 0.005};
    const BoxCar* driven = nullptr;
    const Motor motor{.side = side, .mass = 1500.0, .most = 1.25 * mostSlowing(scrape) + 0.5};
    const JointRun run =
        runWithJoints(railOf(scrape), startOf(scrape),
                      {.step = scrape.step, .duration = 10.0, .bounce = 0.0}, [&](BoxCar& car) {
                        driven = &car;
                        const Vector2 force = motor.force(motionOf(car.body));
                        dBodyAddForce(car.body, force.x(), force.y(), 0.0);
                      });
    std::printf(
        "[ figures  ] joints: loss %.3f m/s a step, rise %.3f m/s, energy %.3f, deepest "
        "%.3f m, through %d, end speed %.2f\n",
        run.largestLoss, run.topRise, run.mostEnergy, run.deepest, static_cast<int>(run.ledThrough),
        run.end.velocity.norm());
    largestLoss = std::max(largestLoss, run.largestLoss);
    topRise = std::max(topRise, run.topRise);
    mostEnergy = std::max(mostEnergy, run.mostEnergy);
  }
  EXPECT_GT(largestLoss, 1.0);
}

}  // namespace
}  // namespace bumper::tests
