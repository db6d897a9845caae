#pragma once

#include "bumper/response/impact.h"
#include "pair_contact.h"

namespace bumper {

/// The response of the first of two bodies to their contact, which closes.
ImpactResponse respondTo(const PairContact& contact, const PlanarBody& first,
                         const PlanarBody& second, const ResponseSettings& settings);

}  // namespace bumper
