#include "bumper/response/island_step.h"

#include "encounter/island.h"

namespace bumper {

PlanarMotion PairFrame::inPlane(const PlanarMotion& motion) const {
  const Placement place(origin, yaw);
  return {.position = origin + place.turned(motion.position),
          .yaw = yaw + motion.yaw,
          .velocity = place.turned(motion.velocity),
          .yawRate = motion.yawRate};
}

IslandStep::IslandStep() : island_(std::make_unique<Island>()) {}
IslandStep::~IslandStep() = default;
IslandStep::IslandStep(IslandStep&&) noexcept = default;
IslandStep& IslandStep::operator=(IslandStep&&) noexcept = default;

void IslandStep::resolve(std::span<const IslandMember> members, std::span<const IslandPair> pairs,
                         double h) {
  island_->resolve(members, pairs, h);
}

StepOutcome IslandStep::outcome(std::size_t member) const { return island_->outcome(member); }

std::span<const PairImpact> IslandStep::pairImpacts() const { return island_->pairImpacts(); }

std::span<const SpeculativeContact> IslandStep::speculativeContacts(std::size_t member,
                                                                    const PlanarMotion& motion,
                                                                    const PlanarMotion& after,
                                                                    double distance, double h) {
  return island_->speculativeContacts(member, motion, after, distance, h);
}

}  // namespace bumper
