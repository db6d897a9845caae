// One vehicle, one step: an encounter of its outline with the walls nearby, or the paper's step.

#include "bumper/response/collision_step.h"

#include <cmath>
#include <cstddef>

#include "encounter/encounter.h"
#include "paper_step.h"

namespace bumper {

CollisionStep::CollisionStep()
    : encounter_(std::make_unique<Encounter>()), paper_(std::make_unique<PaperStep>()) {}

CollisionStep::~CollisionStep() = default;
CollisionStep::CollisionStep(CollisionStep&&) noexcept = default;
CollisionStep& CollisionStep::operator=(CollisionStep&&) noexcept = default;

StepOutcome CollisionStep::resolve(const VehicleParameters& vehicle, const PlanarMotion& motion,
                                   const Walls& walls, double h) {
  asPaper_ = !walls.surfaces.empty() && walls.surfaces.front().settings->method == Method::paper;
  const PlanarBody body = freeBody(vehicle, motion);
  const Outline outline(vehicle);
  return asPaper_ ? paper_->resolve(body, outline, walls, h)
                  : encounter_->resolve(body, outline, walls, h);
}

StepOutcome CollisionStep::resolve(const VehicleParameters& vehicle, const PlanarMotion& motion,
                                   std::span<const WallSegment> walls, double h) {
  segments_.clear();
  surfaces_.clear();
  groups_.clear();
  for (const WallSegment& wall : walls) {
    std::size_t surface = 0;
    while (surface < surfaces_.size() &&
           (surfaces_[surface].settings != wall.settings || groups_[surface] != wall.group)) {
      ++surface;
    }
    if (surface == surfaces_.size()) {
      surfaces_.push_back({.settings = wall.settings});
      groups_.push_back(wall.group);
    }
    segments_.push_back(wall);
    segments_.back().surface = static_cast<int>(surface);
  }
  return resolve(vehicle, motion, {segments_, surfaces_}, h);
}

std::span<const SpeculativeContact> CollisionStep::speculativeContacts(const PlanarMotion& motion,
                                                                       const PlanarMotion& after,
                                                                       double distance, double h) {
  if (asPaper_) return {};
  return encounter_->speculativeContacts(motion, after, distance, h);
}

double CollisionStep::reach(const VehicleParameters& vehicle, const PlanarMotion& motion,
                            double penetrationTime, double h) {
  // The fastest that a point of the outline can be with the energy there is.
  const double radius = Outline(vehicle).radius();
  const double energy = freeBody(vehicle, motion).energy();
  const double fastest =
      std::sqrt(2.0 * energy * (1.0 / vehicle.mass + radius * radius / vehicle.yawInertia));
  return fastest * (h + penetrationTime) + maxRecoverySpeed * h + 1e-6;
}

}  // namespace bumper
