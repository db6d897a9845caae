#include "pair_response.h"

namespace bumper {

ImpactResponse respondTo(const PairContact& contact, const PlanarBody& first,
                         const PlanarBody& second, const ResponseSettings& settings) {
  const Impact impact = contact.impact(0.0);
  const ImpactResponse response = respond(impact, first, second, settings);
  return contact.share < 1.0 ? reduced(response, impact, first, second, contact.share) : response;
}

}  // namespace bumper
