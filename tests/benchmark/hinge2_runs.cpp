#include "hinge2_runs.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "bumper/engine_adapter/responder.h"
#include "car_world.h"
#include "hinge2_car.h"
#include "schemes.h"

namespace bumper::benchmark {

namespace {

using tests::Hinge2Car;

// Cases of which the time is taken.
constexpr std::size_t timedCases = 20;

VehicleParameters parameters() {
  const CarWorld ode;
  return Hinge2Car(ode.world, ode.space, Eigen::Vector2d::Zero(), 0.0, 0.0, 0.0).parameters();
}

struct Hinge2Result {
  EndError error;
  double energyGain = 0.0;
  double cpuTime = 0.0;
};

/// The velocity that the pulses have delivered by `time`: the law's, averaged over the last step.
Vector2 deliveredVelocity(const CaseReference& reference, const PlanarMotion& start, double time,
                          double h) {
  return (motionAt(reference.flight, start, time).position -
          motionAt(reference.flight, start, time - h).position) /
         h;
}

Hinge2Result run(const ImpactCase& impactCase, const CaseReference& reference, int wallTriangles,
                 double h) {
  const PlanarMotion& start = impactCase.start;
  const CarWorld ode;
  Hinge2Result result;
  Responder responder(ode.world, {.response = impactCase.law.settings});
  responder.addBarrier(wallScene(wallTriangles), {.space = ode.space});
  Hinge2Car car(ode.world, ode.space, start.position, 0.0, start.yaw, start.velocity.norm());
  dBodySetFiniteRotationMode(car.chassis, 1);
  responder.addVehicle(car.chassis, car.parameters(), {.linkedBodies = car.wheels});

  const FlightImpact& first = reference.flight.impacts.front();
  const double firstDeltaV = first.impulse.linear.norm() / Hinge2Car::mass();
  // The end of the step in which the first pulse has run out.
  const auto delivered = static_cast<int>(std::ceil(first.time / h)) + 1;
  const auto steps = static_cast<int>(std::lround(reference.duration / h));
  const double energy = 0.5 * Hinge2Car::mass() * start.velocity.squaredNorm();
  double most = energy;
  dRandSetSeed(1);
  const double clock = cpuTime();
  for (int k = 1; k <= steps; ++k) {
    dSpaceCollide(ode.space, &responder, [](void* claimer, dGeomID a, dGeomID b) {
      static_cast<void>(static_cast<Responder*>(claimer)->claims(a, b));
    });
    responder.step(h);
    dWorldQuickStep(ode.world, h);
    const Vector2 velocity = car.velocity().head<2>();
    const double yawRate = dBodyGetAngularVel(car.chassis)[2];
    most = std::max(most, 0.5 * Hinge2Car::mass() * velocity.squaredNorm() +
                              0.5 * impactCase.car.body.yawInertia * yawRate * yawRate);
    if (k == delivered) {
      result.error.deltaV =
          (velocity - deliveredVelocity(reference, start, k * h, h)).norm() / firstDeltaV;
    }
  }
  result.cpuTime = cpuTime() - clock;
  const PlanarMotion& end = reference.flight.end;
  result.error.yawRate = std::abs(dBodyGetAngularVel(car.chassis)[2] - end.yawRate);
  result.error.position = (car.massCentre().head<2>() - end.position).norm();
  result.energyGain = most / energy - 1.0;
  return result;
}

}  // namespace

std::vector<Row> hinge2Rows(std::size_t count, std::uint64_t seed, int repetitions) {
  examples::YawPlaneCarDesign design;
  design.body = parameters();
  const std::vector<ImpactCase> cases = makeCases({design}, count, count, seed);
  std::vector<CaseReference> references;
  std::ranges::transform(cases, std::back_inserter(references), [](const ImpactCase& one) {
    return referenceOf(one, Setting::free_flight);
  });
  std::vector<Row> rows;
  for (const int triangles : wallMeshes) {
    for (const double h : stepSizes) {
      RowMaker maker;
      for (std::size_t k = 0; k < count; ++k) {
        const Hinge2Result result = run(cases[k], references[k], triangles, h);
        maker.add(result.error, result.energyGain);
      }
      Row row = maker.row(Setting::free_flight, hinge2Scheme, triangles, h);
      double least = 0.0;
      for (int repetition = 0; repetition < repetitions; ++repetition) {
        double time = 0.0;
        double simulated = 0.0;
        for (std::size_t k = 0; k < std::min(count, timedCases); ++k) {
          time += run(cases[k], references[k], triangles, h).cpuTime;
          simulated += references[k].duration;
        }
        const double cost = 1e6 * time / simulated;
        if (repetition == 0 || cost < least) least = cost;
      }
      row.cpuPerSimulatedTime = least;
      rows.push_back(row);
    }
  }
  return rows;
}

}  // namespace bumper::benchmark
