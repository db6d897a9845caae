#pragma once

#include <memory>
#include <span>

#include "bumper/response/segment.h"
#include "bumper/response/speculative_contact.h"
#include "bumper/response/step_outcome.h"

namespace bumper {

class Encounter;
class PaperStep;

/// How deep a vehicle that approaches a wall so fast, m/s, goes into it at most while a force pulse
/// of `contactTime` seconds turns it round, m.
inline double enteredDepth(double speed, double contactTime) { return 0.5 * speed * contactTime; }

/// One vehicle, one step: walls nearby in, impacts out. Knows no engine. Holds only scratch memory
/// that is used again from step to step, so one object serves any number of vehicles in turn.
class CollisionStep {
 public:
  CollisionStep();
  ~CollisionStep();
  CollisionStep(const CollisionStep&) = delete;
  CollisionStep& operator=(const CollisionStep&) = delete;
  CollisionStep(CollisionStep&&) noexcept;
  CollisionStep& operator=(CollisionStep&&) noexcept;

  /// At most this many times an impulse answers what approaches in one step. The last of them ends
  /// all approach, and the vehicle is held where it is until the next step.
  static constexpr int maxAnswers = 48;
  /// At most this many impacts are reported: an answer to all that touches together, of which there
  /// are three at most, is reported as up to three impacts.
  static constexpr int maxImpacts = maxAnswers + 6;
  /// Penetration recovery is no faster than this, m/s.
  static constexpr double maxRecoverySpeed = 2.0;

  /// What the segments near a vehicle are, and what they answer with.
  struct Walls {
    std::span<const Segment> segments;  ///< all within reach() of the outline
    std::span<const Surface> surfaces;  ///< Segment::surface numbers these
  };

  /// `motion` is the vehicle's position now with the velocity that it would have in this step of
  /// `h` seconds without walls.
  ///
  /// The outline is swept along its motion. At each time of impact, and for walls that it
  /// penetrates at once, impulses act until nothing that touches approaches; then the sweep goes on
  /// with the new velocity. With h = 0 only what touches already is answered. Surfaces of
  /// Method::paper, all of them or none, are answered as the paper does: once, where the step
  /// begins, by their overlap.
  StepOutcome resolve(const VehicleParameters& vehicle, const PlanarMotion& motion,
                      const Walls& walls, double h);

  /// Of the step that was resolved last, whose walls must still be there: the points of the outline
  /// that may meet a wall with which they are no further apart than `distance` at its end, m, for
  /// the engine's own solver. `motion` and `h` as for resolve(), `after` as it came out. Walls with
  /// a contact time let it in by enteredDepth(); those that break and those of Method::paper are
  /// left out. Valid until the next call.
  std::span<const SpeculativeContact> speculativeContacts(const PlanarMotion& motion,
                                                          const PlanarMotion& after,
                                                          double distance, double h);

  /// How far any point of the outline can come in a step of `h` seconds, whatever it hits, and how
  /// far beyond that walls take part in a contact point, m.
  static double reach(const VehicleParameters& vehicle, const PlanarMotion& motion,
                      double penetrationTime, double h);

 private:
  std::unique_ptr<Encounter> encounter_;
  std::unique_ptr<PaperStep> paper_;
  bool asPaper_ = false;  // the step that was resolved last
};

}  // namespace bumper
