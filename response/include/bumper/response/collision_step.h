#pragma once

#include <span>
#include <vector>

#include "bumper/response/force_pulse.h"
#include "bumper/response/impact.h"
#include "bumper/response/speculative_contact.h"
#include "bumper/response/sweep.h"

namespace bumper {

/// An impact of this step and the response to it. Its impulse acts at its arm, and leads from the
/// motion before to the motion after.
///
/// What several points take at once, when many impacts at one instant are solved together, is told
/// as one impact for each, the fastest first. The motions in between never were, and may be fast
/// where walls face each other. So approachSpeed is the one before all of them; energyChange and
/// energyRatio are shares, none of which gains, of what all of them together do to the energy.
struct StepImpact {
  double time = 0.0;  ///< of the impact, s from the step's start
  Impact impact{};
  ImpactResponse response{};
  /// A part of a contact that lasts within the step: an end of a wall that a turning side slides
  /// along.
  bool slides = false;
  /// The next one and this are parts of one impulse, which ended the approach at several points at
  /// once: what holds of an impulse's energy holds of them together.
  bool isPartOfNext = false;
};

/// A velocity and yaw rate for one step only. It eases an outline out of walls that it stands in,
/// or holds a vehicle back.
struct StepShift {
  Vector2 velocity = Vector2::Zero();  ///< m/s
  double yawRate = 0.0;                ///< rad/s
};

/// What a vehicle's walls do to it in one step.
struct StepOutcome {
  /// In the order in which they act; valid until the next call.
  std::span<const StepImpact> impacts;
  PlanarImpulse impulse;  ///< of all impacts together
  PlanarMotion after;     ///< at the step's end; the paper's other choice, state reset
  /// A motion for this step only: it is part of `after`'s position and yaw, not of its velocity.
  StepShift shift;
  /// False: after maxAnswers the vehicle was held where it was for the rest of the step.
  bool settled = true;
};

/// How deep a vehicle that approaches a wall so fast, m/s, goes into it at most while a force pulse
/// of `contactTime` seconds turns it round, m.
inline double enteredDepth(double speed, double contactTime) { return 0.5 * speed * contactTime; }

/// One vehicle, one step: walls nearby in, impacts out. Knows no engine. Holds only scratch memory
/// that is used again from step to step, so one object serves any number of vehicles in turn.
class CollisionStep {
 public:
  CollisionStep();

  /// At most this many times an impulse answers what approaches in one step. The last of them ends
  /// all approach, and the vehicle is held where it is until the next step.
  static constexpr int maxAnswers = 48;
  /// At most this many impacts are told: an answer to all that touches together, of which there are
  /// three at most, is told as up to three impacts.
  static constexpr int maxImpacts = maxAnswers + 6;
  /// An outline is eased out of a wall no faster than this, m/s.
  static constexpr double maxEaseOut = 2.0;

  /// `walls` are those within reach() of the outline. `motion` is the vehicle's position now with
  /// the velocity that it would have in this step of `h` seconds without walls.
  ///
  /// The outline is swept along its motion. At each first touch, and for walls that it stands in at
  /// once, impulses push back until nothing that touches approaches; then the sweep goes on with
  /// the new velocity. With h = 0 only what touches already is answered. Walls of Method::paper are
  /// answered as the paper does: once, where the step begins, by their overlap.
  StepOutcome resolve(const VehicleParameters& vehicle, const PlanarMotion& motion,
                      std::span<const WallSegment> walls, double h);

  /// Of the step that was resolved last: the points of the outline that may meet a wall with which
  /// they are no further apart than `distance` at its end, m, for the engine's own solver. `motion`
  /// and `h` as for resolve(), `after` as it came out. Walls with a contact time let it in by
  /// enteredDepth(); those that break and those of Method::paper are left out. Valid until the next
  /// call.
  std::span<const SpeculativeContact> speculativeContacts(const PlanarMotion& motion,
                                                          const PlanarMotion& after,
                                                          double distance, double h);

  /// How far any point of the outline can come in a step of `h` seconds, whatever it hits, and how
  /// far beyond that walls take part in a contact point, m.
  static double reach(const VehicleParameters& vehicle, const PlanarMotion& motion,
                      double penetrationTime, double h);

 private:
  /// One point of the outline, a wall's normal there, and how fast they close, m/s.
  struct Approach {
    ContactPoint contact{};
    Vector2 normal = Vector2::Zero();
    double speed = 0.0;
  };

  /// A wall nearby, and what is known of the outline in it.
  struct Wall {
    WallSegment segment;
    Overlap overlap{};       ///< if touched
    ContactPoints points{};  ///< all that touches, the first point before others; if touched
    bool touched = false;    ///< the outline touches or overlaps it
    bool hidden = false;     ///< … but it lies behind another touched wall
    bool struck = false;     ///< … and `contact` has had an impulse at this instant
    bool passed = false;     ///< it lets the vehicle through, or takes part no more in this step
    double unheardOf = 0.0;  ///< touches before this time were looked at, to no effect
    Approach contact{};
  };

  /// A piece of a wall, by its place along its own line.
  struct Ordered {
    std::size_t piece = 0;
    double place = 0.0;
  };

  /// The next impulse to apply; none if `wall` is null.
  struct Next {
    Wall* wall = nullptr;
    Approach at{};
  };

  /// The wall that is touched next; none if `wall` is null.
  struct NextTouch {
    double time = 0.0;
    Wall* wall = nullptr;
  };

  enum class Settled { without_impulse, by_impulses, for_now };

  void mergeWalls(std::span<const WallSegment> walls, const Vector2& centre);
  void lookAround(double time);
  void findTouched(double time);
  [[nodiscard]] std::optional<Overlap> overlapWith(const WallSegment& wall, double time) const;
  [[nodiscard]] bool isShielded(const Overlap& end) const;
  void findHidden();
  [[nodiscard]] Vector2 easeOut(double h) const;
  Settled settle(double time);
  void answer(const Next& next, double time, Rebound rebound);
  void answerTogether(double time);
  void record(const Wall& wall, const Approach& at, double time, const ImpactResponse& response);
  NextTouch nextTouch(double from, double until);
  [[nodiscard]] double gapAcceleration() const;
  [[nodiscard]] double quietTime(const Wall& wall, double h) const;
  [[nodiscard]] double pause(double h) const;

  Next firstNewWall();
  Next fastestStruckWall();
  [[nodiscard]] Approach approach(const ContactPoint& contact, const Vector2& normal) const;
  [[nodiscard]] Approach touching(const Wall& wall) const;
  [[nodiscard]] Approach middleOfChain(const Wall& struck, double penetration) const;
  [[nodiscard]] double sinceTouch(const Wall& wall) const;
  [[nodiscard]] int wallAt(const Wall& wall, const Vector2& point) const;

  // Of the step that is being resolved.
  VehicleParameters vehicle_;
  Outline outline_{VehicleParameters{}};
  PlanarMotion motion_;
  double step_ = 0.0;
  Placement place_;  // of motion_, when one last looked around
  std::span<const WallSegment> given_;

  std::vector<WallSegment> oriented_;
  std::vector<Ordered> order_;
  std::vector<Wall> walls_;
  std::vector<StepImpact> impacts_;
  int answers_ = 0;
  SpeculativeContacts speculative_;
};

}  // namespace bumper
