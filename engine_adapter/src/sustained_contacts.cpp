#include "sustained_contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bumper {

namespace {

template <typename Contacts>
auto contactWith(Contacts& contacts, const ContactPartner& with) {
  return std::find_if(contacts.begin(), contacts.end(),
                      [&](const SustainedContact& each) { return each.with == with; });
}

}  // namespace

double impactSpeed(const std::vector<SustainedContact>& contacts, const ContactPartner& with,
                   const ResponseSettings& settings) {
  const bool isInContact = contactWith(contacts, with) != contacts.end();
  return isInContact ? impactInContact * settings.restSpeed : settings.restSpeed;
}

bool mayHaveEnded(const std::vector<SustainedContact>& contacts, double time) {
  return std::any_of(contacts.begin(), contacts.end(), [time](const SustainedContact& each) {
    return time - each.last >= contactPause;
  });
}

int stepsUntilEnd(const std::vector<SustainedContact>& contacts, double time, double h) {
  double steps = std::numeric_limits<int>::max();
  for (const SustainedContact& each : contacts) {
    // One less, for rounding in the sum of steps.
    steps = std::min(steps, std::floor((each.last + contactPause - time) / h) - 1.0);
  }
  return static_cast<int>(std::max(steps, 0.0));
}

bool addToContact(std::vector<SustainedContact>& contacts, const ContactShare& share, double time,
                  bool mayBegin) {
  auto contact = contactWith(contacts, share.with);
  const bool begins = contact == contacts.end();
  if (begins) {
    if (!mayBegin) return false;
    contact = contacts.insert(contacts.end(), {.with = share.with, .begun = time});
  }
  contact->wall = share.wall;
  contact->last = time;
  contact->impulseNormal += share.impulseNormal;
  contact->impulseTangent += share.impulseTangent;
  contact->energyLost += share.energyLost;
  contact->contact = share.contact;
  contact->normal = share.normal;
  return begins;
}

void fadeLoads(std::vector<SustainedContact>& contacts, double step) {
  for (SustainedContact& each : contacts) each.load *= std::max(1.0 - step / contactPause, 0.0);
}

bool raiseLoad(std::vector<SustainedContact>& contacts, const ContactPartner& with, double load) {
  const auto contact = contactWith(contacts, with);
  if (contact == contacts.end()) return false;
  const bool rises = load >= 2.0 * contact->load;
  contact->load = std::max(contact->load, load);
  return rises;
}

}  // namespace bumper
