#pragma once

#include "bumper/response/pair.h"
#include "pair_body.h"

namespace bumper {

/// As they are now.
PairSeparation separation(const PairBody& first, const PairBody& second);

/// The first time up to `until`, s from now, at which two outlines touch in free flight, whatever
/// their speeds; `never` if they do not. They must be apart now.
double timeOfTouch(const PairBody& first, const PairBody& second, double until);

/// No two points of the outlines close faster than this, m/s.
double fastestClosing(const PairBody& first, const PairBody& second);

/// No distance between points of the two outlines changes its rate faster than this, m/s².
double gapAcceleration(const PairBody& first, const PairBody& second);

}  // namespace bumper
