#pragma once

#include "bumper/response/pair.h"
#include "pair_contact.h"

namespace bumper {

/// The response of the first of two bodies to their contact, which closes.
ImpactResponse respondTo(const PairContact& contact, const PlanarBody& first,
                         const PlanarBody& second, const ResponseSettings& settings,
                         Rebound rebound = Rebound::as_set);

/// A hit as the second of two bodies sees it. `before` is the second one's motion at its time.
PairHit asSeenByOther(const PairHit& hit, const PlanarMotion& before);

}  // namespace bumper
