#pragma once

#include "contact_set.h"

namespace bumper {

/// How a touched wall yields to an outline that slides along another one.
struct Yielding {
  Vector2 aside =
      Vector2::Zero();  ///< by how much the outline is to step aside before it is engaged, m
  double share = 0.0;   ///< 0: not at all; 1: the wall does not catch
  /// Depth, m, at which the contact is found: what is left of the feature becomes an obstacle over
  /// about this height.
  double reach = 0.0;
};

/// A wall touched at `touched`, along `normal`, yields if no more than a smallest feature of it is
/// exposed in front of another one that the outline slides on; less again for up to twice that
/// size, so that the response grows without a jump.
Yielding yieldingOf(const ContactSet& contacts, const Manifold& struck, const Vector2& touched,
                    const Vector2& normal, const Outline& outline, const Placement& at);

}  // namespace bumper
