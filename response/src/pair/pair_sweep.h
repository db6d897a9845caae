#pragma once

#include "pair_body.h"

namespace bumper {

/// How far two outlines are apart, m, along the side of either that separates them best; negative:
/// the least depth of their overlap.
struct PairSeparation {
  double distance = 0.0;
  Vector2 normal = Vector2::Zero();  ///< unit, out of the second into the first
};
PairSeparation separation(const Outline& first, const Placement& firstAt, const Outline& second,
                          const Placement& secondAt);

/// The first time up to `until`, s from now, at which two outlines touch in free flight, whatever
/// their speeds; `never` if they do not. They must be apart now.
double timeOfTouch(const PairBody& first, const PairBody& second, double until);

/// No distance between points of the two outlines changes its rate faster than this, m/s².
double gapAcceleration(const PairBody& first, const PairBody& second);

}  // namespace bumper
