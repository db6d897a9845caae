#pragma once

#include "contact_set.h"

namespace bumper {

/// By how much the outline is to step aside, m, so that a wall touched at `touched`, along
/// `normal`, does not catch it: zero unless no more than a smallest feature of that wall is exposed
/// in front of another one that the outline slides on. Less again for up to twice that size, so
/// that the response grows without a jump.
Vector2 stepAside(const ContactSet& contacts, const Manifold& struck, const Vector2& touched,
                  const Vector2& normal, const Outline& outline, const Placement& at);

}  // namespace bumper
