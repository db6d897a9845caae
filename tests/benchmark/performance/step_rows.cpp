#include "step_rows.h"

#include <algorithm>
#include <memory>

#include "bumper/response/impact.h"
#include "clock.h"
#include "fleet.h"

namespace bumper::benchmark {

namespace {

constexpr int stepsPerRun = 40;

/// One whole step of one vehicle, ns: the mean over a run.
double wholeStep(Fleet& fleet) {
  fleet.reset();
  const Timer timer;
  for (int i = 0; i < stepsPerRun; ++i) {
    fleet.push();
    fleet.collide();
    fleet.respond();
    fleet.stepWorld();
  }
  return timer.elapsed() / stepsPerRun;
}

struct Whole {
  StepRow* row;
  double StepRow::*time;
  std::unique_ptr<Fleet> fleet;
};

std::vector<StepRow> measureWhole(const NamedScene& scene, int repetitions) {
  struct Named {
    const char* name;
    Answer answer;
  };
  std::vector<StepRow> rows;
  std::vector<Whole> all;
  rows.reserve(6);  // pointers stay valid
  for (const bool fiveBodies : {false, true}) {
    for (const auto& [name, answer] :
         {Named{"world", Answer::nobody}, Named{"bumper", Answer::bumper},
          Named{"ode_contacts", Answer::joints}}) {
      StepRow& row = rows.emplace_back();
      row = {.scene = scene.name,
             .scheme = name,
             .bodies = fiveBodies ? 5 : 1,
             .freeTime = infinity,
             .contactTime = infinity};
      for (const bool inContact : {false, true}) {
        all.push_back(
            {.row = &row,
             .time = inContact ? &StepRow::contactTime : &StepRow::freeTime,
             .fleet = std::make_unique<Fleet>(scene.scene, FleetOptions{.fiveBodies = fiveBodies,
                                                                        .inContact = inContact,
                                                                        .answer = answer})});
      }
    }
  }
  // One vehicle's steps are over so soon that they can be repeated more often.
  for (int repetition = 0; repetition < 10 * repetitions; ++repetition) {
    for (Whole& one : all) {
      double& least = one.row->*one.time;
      least = std::min(least, wholeStep(*one.fleet));
    }
  }
  return rows;
}

/// What lies between two calls of Responder::step().
enum class Between { motion_alone, world_step, other_data };

/// More than a processor's caches hold, read and written once.
void fillCaches() {
  static std::vector<char> data(64 << 20, 1);
  for (std::size_t i = 0; i < data.size(); i += 64) ++data[i];
}

/// Responder::step() of a fleet, ns: of each step the least over the repetitions, then the mean.
class FleetTimes {
 public:
  FleetTimes(Fleet& fleet, Between between, int steps)
      : fleet_(fleet),
        between_(between),
        least_(static_cast<std::size_t>(steps), infinity),
        world_(least_) {}

  void repeat() {
    fleet_.reset();
    for (std::size_t i = 0; i < least_.size(); ++i) {
      fleet_.push();
      const Timer responding;
      fleet_.respond();
      least_[i] = std::min(least_[i], responding.elapsed());
      const Timer timer;
      if (between_ == Between::motion_alone) {
        fleet_.glide();
      } else {
        fleet_.stepWorld();
      }
      world_[i] = std::min(world_[i], timer.elapsed());
      if (between_ == Between::other_data) fillCaches();
    }
  }

  [[nodiscard]] double respond() const { return mean(least_) - clockTime(); }
  [[nodiscard]] double between() const { return mean(world_); }

 private:
  static double mean(const std::vector<double>& times) {
    double sum = 0.0;
    for (std::size_t i = 1; i < times.size(); ++i) sum += times[i];  // the first one warms up
    return sum / static_cast<double>(times.size() - 1);
  }

  /// What reading the clock takes.
  static double clockTime() {
    double least = infinity;
    for (int i = 0; i < 100; ++i) {
      const Timer timer;
      least = std::min(least, timer.elapsed());
    }
    return least;
  }

  Fleet& fleet_;
  Between between_;
  std::vector<double> least_;
  std::vector<double> world_;
};

FleetRow measureFleet(const NamedScene& scene, std::size_t vehicles, int repetitions) {
  FleetOptions options{.vehicles = vehicles, .fiveBodies = true};
  Fleet far(scene.scene, options);
  options.inContact = true;
  Fleet leaning(scene.scene, options);
  FleetTimes warm(far, Between::motion_alone, stepsPerRun);
  FleetTimes stepped(far, Between::world_step, stepsPerRun);
  FleetTimes cold(far, Between::other_data, 8);
  FleetTimes inContact(leaning, Between::world_step, stepsPerRun);
  for (int repetition = 0; repetition < repetitions; ++repetition) {
    for (FleetTimes* each : {&warm, &stepped, &cold, &inContact}) each->repeat();
  }
  const auto count = static_cast<double>(vehicles);
  return {.scene = scene.name,
          .vehicles = vehicles,
          .worldStep = stepped.between(),
          .warm = warm.respond() / count,
          .afterWorldStep = stepped.respond() / count,
          .cold = cold.respond() / count,
          .inContact = inContact.respond() / count};
}

/// respond() for impacts at many angles, ns.
double responseTime(Law law, int repetitions) {
  constexpr int impacts = 1000;
  const VehicleParameters car = queryCar();
  ResponseSettings settings;
  settings.law = law;
  std::vector<PlanarMotion> motions;
  for (int i = 0; i < impacts; ++i) {
    const double part = static_cast<double>(i) / impacts;
    motions.push_back({.velocity = {25.0 - 5.0 * part, -1.0 - 10.0 * part}, .yawRate = 0.4 - part});
  }
  Impact impact;
  impact.point = {2.2, -0.9};
  impact.arm = impact.point;
  impact.normal = {0.0, 1.0};
  double least = infinity;
  double sum = 0.0;
  for (int repetition = 0; repetition < 10 * repetitions; ++repetition) {
    const Timer timer;
    for (const PlanarMotion& motion : motions) {
      sum += respond(impact, freeBody(car, motion), settings).impulse.angular;
    }
    least = std::min(least, timer.elapsed());
  }
  // The sum is looked at, so that it is calculated.
  return sum == 0.0 ? unknown : least / impacts;
}

}  // namespace

StepMeasurement measureSteps(const StepOptions& options) {
  const NamedScene scene = makeScene("S2g");
  StepMeasurement result;
  result.steps = measureWhole(scene, options.repetitions);
  for (const std::size_t vehicles : options.fleets) {
    result.fleets.push_back(measureFleet(scene, vehicles, options.repetitions));
  }
  result.responseEnergy = responseTime(Law::energy, options.repetitions);
  result.responseRestitution = responseTime(Law::restitution, options.repetitions);
  return result;
}

}  // namespace bumper::benchmark
