#pragma once

#include <span>
#include <vector>

#include "bumper/response/step_outcome.h"
#include "contact_set.h"
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

/// Applies impulses at one instant until nothing that touches approaches.
class Instant {
 public:
  Instant(Participant& vehicle, ContactSet& contacts);

  /// Before the first instant of a step of `step` seconds.
  void begin(double step);

  /// `time` seconds into the step. The contacts are those of now.
  Settled settle(double time);

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
  void answer(const Next& next, double time, Rebound rebound);
  void answerTogether(double time);
  void record(const Manifold& wall, const Approach& at, double time,
              const ImpactResponse& response);

  Participant& vehicle_;
  ContactSet& contacts_;
  double step_ = 0.0;
  int answers_ = 0;
  std::vector<StepImpact> impacts_;
};

}  // namespace bumper
