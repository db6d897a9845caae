#pragma once

#include "contact_set.h"

namespace bumper {

/// Walls that go on from a touched one where the outline engages it: they have one contact.
struct EngagedContact {
  bool exists = false;  ///< false: the outline engages one wall alone, or its free end
  bool meets = false;   ///< false: where the outline is engaged it meets none of them, it passes by
  ContactPoint contact{};
  Vector2 normal = Vector2::Zero();
};

/// The contact of a touched wall and of those that go on from its ends, with the outline at `pose`,
/// `reached` m deep.
///
/// The walls go on at the outermost one of each vertex, as the vehicle sees them, and end where
/// they turn towards the vehicle by 5° or more: an inside corner has two contacts.
EngagedContact engagedContact(const ContactSet& contacts, const Manifold& struck,
                              const Outline& outline, const Placement& pose, double reached);

}  // namespace bumper
