#include "paper_step.h"

#include <algorithm>

#include "bumper/response/sweep.h"

namespace bumper {

StepOutcome PaperStep::resolve(const PlanarBody& body, const Outline& outline,
                               const CollisionStep::Walls& walls, double h) {
  vehicle_ = {.body = body, .outline = outline};
  contacts_.begin(walls.segments, walls.surfaces);
  contacts_.updateByFaces();

  const Manifold* first = nullptr;
  Approach at;
  double longest = -1.0;
  for (const Manifold& wall : contacts_.all()) {
    if (!wall.touched || wall.hidden || wall.passed) continue;
    const ContactPoint middle = contactPoint(outline, body.motion.placement(), wall.segment,
                                             wall.overlap, wall.overlap.depth);
    const Approach approach = contacts_.approach(wall, middle, wall.overlap.normal);
    if (approach.speed <= restTolerance) continue;
    const double since = ContactSet::sinceTouch(wall, approach.speed);
    if (since <= longest) continue;
    longest = since;
    first = &wall;
    at = approach;
  }

  StepOutcome outcome;
  outcome.after = advanced(body.motion, h);
  if (first == nullptr) return outcome;
  const PlanarBody barrier = contacts_.bodyOf(*first);
  const Impact impact{.wall = contacts_.pieceAt(*first, at.contact.point),
                      .point = at.contact.point,
                      .normal = at.normal,
                      .arm = at.contact.arm,
                      .otherArm = at.contact.point - barrier.motion.position,
                      .depth = std::max(first->overlap.depth, 0.0)};
  impact_ = {.impact = impact,
             .response = respond(impact, body, barrier, contacts_.settingsOf(*first))};
  outcome.impacts = {&impact_, 1};
  outcome.impulse = impact_.response.impulse;
  outcome.after = advanced(impact_.response.after, h);
  return outcome;
}

}  // namespace bumper
