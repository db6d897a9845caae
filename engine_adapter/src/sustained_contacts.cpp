#include "sustained_contacts.h"

#include <algorithm>

namespace bumper {

bool isInContact(const std::vector<SustainedContact>& contacts, BarrierId barrier) {
  return std::any_of(contacts.begin(), contacts.end(),
                     [&](const SustainedContact& each) { return each.barrier == barrier; });
}

bool addToContact(std::vector<SustainedContact>& contacts, const ContactShare& share, double time,
                  bool mayBegin) {
  auto contact = std::find_if(contacts.begin(), contacts.end(), [&](const SustainedContact& each) {
    return each.barrier == share.barrier;
  });
  const bool begins = contact == contacts.end();
  if (begins) {
    if (!mayBegin) return false;
    contact = contacts.insert(contacts.end(), {.barrier = share.barrier, .begun = time});
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

}  // namespace bumper
