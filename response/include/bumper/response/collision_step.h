#pragma once

#include <memory>
#include <span>
#include <vector>

#include "bumper/base/api.h"
#include "bumper/response/segment.h"
#include "bumper/response/speculative_contact.h"
#include "bumper/response/step_outcome.h"

namespace BUMPER_API bumper {

class Encounter;
class PaperStep;

/// The greatest penetration, m, of a vehicle that approaches a wall at `speed`, m/s, while a force
/// pulse of `contactTime` seconds reverses it.
inline double enteredDepth(double speed, double contactTime) { return 0.5 * speed * contactTime; }

/// A segment with settings of its own, for callers without a table of surfaces.
struct WallSegment : Segment {
  const ResponseSettings* settings = nullptr;  ///< not owned, never null
  int group = 0;                               ///< what breaks as one
};

/// One vehicle, one step: walls nearby in, impacts out. Independent of any engine. Holds only
/// scratch memory, so one object serves any number of vehicles in turn.
class CollisionStep {
 public:
  CollisionStep();
  ~CollisionStep();
  CollisionStep(const CollisionStep& other) = delete;
  CollisionStep& operator=(const CollisionStep& other) = delete;
  CollisionStep(CollisionStep&& other) noexcept;
  CollisionStep& operator=(CollisionStep&& other) noexcept;

  /// The maximum number of impulses in one step. The last of them ends all approach, and the
  /// vehicle is held where it is until the next step.
  static constexpr int maxAnswers = 48;
  /// The maximum number of impacts reported: an impulse at several contacts at once, of which there
  /// are three at most, is reported as up to three impacts.
  static constexpr int maxImpacts = maxAnswers + 6;
  /// Penetration recovery is no faster than this, m/s.
  static constexpr double maxRecoverySpeed = 2.0;

  /// The segments near a vehicle, and the surfaces that say how they respond.
  struct Walls {
    std::span<const Segment> segments;  ///< all within reach() of the outline
    std::span<const Surface> surfaces;  ///< Segment::surface numbers these
  };

  /// `motion` is the vehicle's position now with the velocity that it would have in this step of
  /// `h` seconds without walls.
  ///
  /// The outline is swept along its motion. At each time of impact, and for walls that it
  /// penetrates at once, impulses act until no contact point approaches; then the sweep goes on
  /// with the new velocity. With h = 0 only existing contacts are resolved. Surfaces of
  /// Method::paper, all of them or none, are resolved as in the paper: once, where the step begins,
  /// by their overlap.
  StepOutcome resolve(const VehicleParameters& vehicle, const PlanarMotion& motion,
                      const Walls& walls, double h);
  /// The same with a surface for each pair of settings and group; Segment::surface does not count.
  StepOutcome resolve(const VehicleParameters& vehicle, const PlanarMotion& motion,
                      std::span<const WallSegment> walls, double h);

  /// For the step resolved last, whose walls must still exist: the points of the outline that may
  /// meet a wall no further away than `distance` at its end, m, for the engine's own solver.
  /// `motion` and `h` as for resolve(), `after` as in its result. Walls with a contact time allow a
  /// penetration of enteredDepth(); those that break and those of Method::paper are left out. Valid
  /// until the next call.
  std::span<const SpeculativeContact> speculativeContacts(const PlanarMotion& motion,
                                                          const PlanarMotion& after,
                                                          double distance, double h);

  /// The farthest that any point of the outline can move in a step of `h` seconds, whatever it
  /// hits, plus the margin within which walls affect a contact point, m.
  static double reach(const VehicleParameters& vehicle, const PlanarMotion& motion,
                      double penetrationTime, double h);

 private:
  std::unique_ptr<Encounter> encounter_;
  std::unique_ptr<PaperStep> paper_;
  bool asPaper_ = false;  // the step that was resolved last
  // Of the walls that came with settings of their own.
  std::vector<Segment> segments_;
  std::vector<Surface> surfaces_;
  std::vector<int> groups_;  // of the surfaces
};

}  // namespace bumper
