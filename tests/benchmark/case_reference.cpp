#include "case_reference.h"

#include <algorithm>
#include <cmath>

#include "car_world.h"

namespace bumper::benchmark {

namespace {

constexpr double grid = 0.020;        // s
constexpr int shortest = 20;          // of the grid: 0.4 s
constexpr int longest = 25;           // … but for a contact that lasts
constexpr double startMoved = 1e-10;  // m

Flight fly(const ImpactCase& impactCase, const PlanarMotion& start, Setting setting,
           double duration) {
  if (setting == Setting::free_flight) {
    return freeFlight(impactCase.car.body, start, theWall(), impactCase.law.settings, duration);
  }
  return forcedFlight(impactCase.car.body, start, theWall(), impactCase.law.settings, duration,
                      tyreForces(impactCase), tyreReferenceStep);
}

/// The first duration at whose end every pulse has run out; the longest if there is none.
double quietDuration(const Flight& flight) {
  constexpr double rounding = 1e-6;
  for (int count = shortest; count < longest; ++count) {
    const double end = count * grid;
    if (std::ranges::none_of(flight.impacts, [&](const FlightImpact& impact) {
          return impact.time > end - grid - rounding && impact.time < end + rounding;
        })) {
      return end;
    }
  }
  return longest * grid;
}

}  // namespace

const char* nameOf(Setting setting) { return setting == Setting::tyres ? "tyres" : "free_flight"; }

CaseReference referenceOf(const ImpactCase& impactCase, Setting setting) {
  CaseReference reference;
  reference.flight = fly(impactCase, impactCase.start, setting, longest * grid);
  reference.duration = quietDuration(reference.flight);
  reference.flight = fly(impactCase, impactCase.start, setting, reference.duration);
  if (setting == Setting::tyres || reference.flight.lasting) return reference;
  const StraightWall wall = theWall();
  const Vector2 along = (wall.end - wall.start).normalized();
  for (const Vector2& way : {along, turnedLeft(along)}) {
    PlanarMotion moved = impactCase.start;
    moved.position += startMoved * way;
    if (fly(impactCase, moved, setting, reference.duration).impulses != reference.flight.impulses) {
      reference.sensitive = true;
    }
  }
  return reference;
}

EndError errorOf(const ImpactCase& impactCase, const CaseReference& reference,
                 const PlanarMotion& end) {
  const PlanarMotion& exact = reference.flight.end;
  const double change = (exact.velocity - impactCase.start.velocity).norm();
  return {.deltaV = (end.velocity - exact.velocity).norm() / change,
          .yawRate = std::abs(end.yawRate - exact.yawRate),
          .position = (end.position - exact.position).norm()};
}

}  // namespace bumper::benchmark
