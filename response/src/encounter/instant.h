#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "bumper/response/step_outcome.h"
#include "contact_set.h"
#include "end_approach.h"
#include "participant.h"

namespace bumper {

/// A contact that does not approach may do so later, as the outline turns: the maximum number of
/// checks in a step.
inline constexpr double looksInStep = 12.0;

/// How the approach at one instant ended.
enum class Settled {
  without_impulse,  ///< there was none
  by_impulses,
  for_now  ///< by the last impulse that a step allows: the vehicle is held until the next one
};

/// Whether the settings' rebound is still asked for at an instant.
enum class Effort {
  as_set,
  plastic  ///< so often answered already that nothing rebounds any more
};

/// Of impulses that act together: the response's share of what they dissipate, J, ≤ 0, in place of
/// what its own impulse would, from an energy of `before`, J.
void takeShare(ImpactResponse& response, double before, double change);

/// Applies impulses at one instant until nothing that touches approaches.
class Instant {
 public:
  Instant(Participant& vehicle, ContactSet& contacts);

  /// Before the first instant of a step of `step` seconds.
  void begin(double step);

  /// `time` seconds into the step. The contacts are those of now. Called again at the same instant
  /// it goes on: walls that were answered count as such.
  Settled settle(double time, Effort effort = Effort::as_set);

  /// For impulses at all walls that are touched now, and at other vehicles, at once: the points
  /// that they act at, and the part at one of them with its share of the energy, J. Valid until the
  /// next settle().
  std::span<const TouchingPoint> touchingPoints();
  void takePart(std::size_t point, const ContactImpulse& impulse, double energyChange, double time);

  /// Of all instants since begin().
  [[nodiscard]] std::span<const StepImpact> impacts() const { return impacts_; }

 private:
  // The next impulse to apply; none if `wall` is null.
  struct Next {
    Manifold* wall = nullptr;
    Approach at{};
  };

  Next firstNewWall();
  Next fastestStruckWall();
  [[nodiscard]] Impact impactAt(const Manifold& wall, const Approach& at) const;
  void answer(const Next& next, double time, Rebound rebound);
  void answerTogether(double time);
  void record(const Manifold& wall, const Approach& at, double time,
              const ImpactResponse& response);

  Participant& vehicle_;
  ContactSet& contacts_;
  double step_ = 0.0;
  int answers_ = 0;
  std::vector<StepImpact> impacts_;
  // All contacts that act together.
  std::array<TouchingPoint, mostTouchingPoints> points_;
  std::array<Next, mostTouchingPoints> owners_;
};

}  // namespace bumper
