#pragma once

#include "contact_set.h"

namespace bumper {

/// Walls that go on from a touched one where the outline engages it: they have one contact.
struct EngagedContact {
  /// From 0, the outline engages one wall alone or its free end, to 1, a wall goes on straight.
  double share = 0.0;
  bool meets = false;  ///< false: where the outline is engaged it meets none of them, it passes by
  ContactPoint contact{};
  Vector2 normal = Vector2::Zero();
};

/// An outline as it is engaged.
struct Engaged {
  const Outline& outline;
  const Placement& pose;
};

/// The contact of a touched wall and of those that go on from its ends.
///
/// The walls go on at the outermost one of each vertex, as the vehicle sees them, and end where
/// they turn towards the vehicle by 5° or more: an inside corner has two contacts. They count less
/// the more they turn away; what stands at right angles to the touched one lies behind it. If that
/// one yields, by the share `yielding` of 1, they count nevertheless.
EngagedContact engagedContact(const ContactSet& contacts, const Manifold& struck,
                              const Engaged& engaged, double yielding);

}  // namespace bumper
