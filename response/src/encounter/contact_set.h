#pragma once

#include <optional>
#include <span>
#include <vector>

#include "bumper/response/contact_point.h"
#include "bumper/response/response_settings.h"
#include "participant.h"
#include "wall_merge.h"

namespace bumper {

/// One point of the outline, a wall's normal there, and how fast they close, m/s.
struct Approach {
  ContactPoint contact{};
  Vector2 normal = Vector2::Zero();
  double speed = 0.0;
};

/// What the response to a touched wall acts on.
struct Answer {
  Approach at{};
  /// By what share of 1 the wall yields: this contact, and not the points of first touch, says
  /// whether they approach.
  double yielding = 0.0;
  Vector2 onwards = Vector2::Zero();  ///< from the touch to where it is engaged, m
  bool meets = true;  ///< it yields, and nothing is in the way: they pass by each other
};

/// The contact manifold of a vehicle and one wall nearby, and its state in this step.
struct Manifold {
  Segment segment;
  Overlap overlap{};       ///< if touched
  ContactPoints points{};  ///< all that touches, the first point before others; if touched
  bool touched = false;    ///< the outline touches or overlaps the wall
  bool hidden = false;     ///< … but it lies behind another touched wall
  bool struck = false;     ///< … and `answered` has had an impulse at this instant
  bool passed = false;     ///< it lets the vehicle through, or is ignored for the rest of this step
  double ignoredUntil = 0.0;  ///< touches before this time were checked, to no effect
  Answer answered{};
};

/// The end of a wall that meets a place, the nearer one if both do; none if neither does.
std::optional<Vector2> endAt(const Segment& wall, const Vector2& place);

/// The walls near a vehicle, merged, and how its outline touches them where it is now.
class ContactSet {
 public:
  explicit ContactSet(const Participant& vehicle) : vehicle_(vehicle) {}

  void begin(std::span<const Segment> segments, std::span<const Surface> surfaces);

  /// Finds what the outline touches where it and the walls are now, `time` seconds into the step:
  /// within touchTolerance, along the direction of least penetration.
  void update(double time);
  /// After an update at the start of a step: if the walls that the outline was put into lead
  /// nowhere, all of them get one normal, the way out of all.
  void findWayOut();
  /// The same as in the paper: overlaps, along the wall's own normal.
  void updateByFaces();

  [[nodiscard]] std::span<Manifold> all() { return manifolds_; }
  [[nodiscard]] std::span<const Manifold> all() const { return manifolds_; }
  [[nodiscard]] bool anyMoves() const { return anyMoves_; }
  [[nodiscard]] const Surface& surfaceOf(const Manifold& wall) const {
    return surfaces_[static_cast<std::size_t>(wall.segment.surface)];
  }
  [[nodiscard]] const ResponseSettings& settingsOf(const Manifold& wall) const {
    return *surfaceOf(wall).settings;
  }
  /// The id of the segment at a place of a wall.
  [[nodiscard]] int pieceAt(const Manifold& wall, const Vector2& point) const;

  /// The body that a wall belongs to, as it moves now: a fixed one, or a driven one.
  [[nodiscard]] PlanarBody bodyOf(const Manifold& wall) const;
  /// A wall where it is at another time, s into the step.
  [[nodiscard]] Segment segmentAt(const Manifold& wall, double time) const;

  /// The maximum acceleration of any gap between outline and wall in free flight, m/s².
  [[nodiscard]] double gapAcceleration(const Manifold& wall) const;
  /// A wall, and what touches it, carried on to another time.
  struct Forecast {
    Segment segment;
    Overlap overlap;
  };
  [[nodiscard]] Forecast forecast(const Manifold& wall, double time) const;
  [[nodiscard]] Participant seenFrom(const Manifold& wall) const;
  /// Whether the wall's own direction changes.
  [[nodiscard]] bool turns(const Manifold& wall) const {
    return surfaceOf(wall).motion.yawRate != 0.0;
  }

  /// How fast a wall itself moves at a contact, along its normal, m/s.
  [[nodiscard]] double speedOf(const Manifold& wall, const Approach& at) const;

  [[nodiscard]] Approach approach(const Manifold& wall, const ContactPoint& contact,
                                  const Vector2& normal) const;
  /// Of the point of first touch and what else touches: the first if it approaches, else the
  /// fastest. After an answer to a wall that yields each is by that share the answer's contact.
  [[nodiscard]] Approach touching(const Manifold& wall, const Answer& answered = {}) const;
  /// How long ago the wall was touched at such a speed, s.
  [[nodiscard]] static double sinceTouch(const Manifold& wall, double speed);
  /// The contact at the depth that the outline reaches in the penetration time, if `first`
  /// approaches: of a flat wall the middle of the line of interference; elsewhere see
  /// engagedContact().
  [[nodiscard]] Answer answerTo(const Manifold& struck, const Approach& first) const;

 private:
  static void setOverlap(Manifold& wall, const std::optional<Overlap>& overlap);
  void moveWalls();
  void finish();
  [[nodiscard]] Vector2 relativeVelocity(const Manifold& wall, const ContactPoint& contact) const;
  [[nodiscard]] const Segment& givenSegment(const Manifold& wall) const {
    return given_[static_cast<std::size_t>(&wall - manifolds_.data())];
  }
  [[nodiscard]] bool isSideOfBody(const Segment& wall) const;
  [[nodiscard]] std::optional<double> depthOfStanding(const Manifold& wall) const;
  [[nodiscard]] bool standsWithoutWayOut() const;
  [[nodiscard]] Vector2 withoutLeadingThrough(const Vector2& way) const;
  void takeWayOut();
  [[nodiscard]] std::optional<Overlap> overlapWith(const Segment& wall, double time) const;
  [[nodiscard]] bool isShielded(const Overlap& end) const;
  [[nodiscard]] bool isHidden(const Manifold& wall) const;
  [[nodiscard]] double sinceTouch(const Manifold& wall) const;

  const Participant& vehicle_;
  std::span<const Surface> surfaces_;
  WallMerge merge_;
  std::span<const Segment> given_;  // the merged walls where the step begins
  bool anyMoves_ = false;
  std::vector<Manifold> manifolds_;
  Placement place_;    // of the vehicle, when last updated
  double time_ = 0.0;  // … s into the step
};

}  // namespace bumper
