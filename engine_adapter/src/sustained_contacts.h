#pragma once

#include <vector>

#include "bumper/engine_adapter/saved_state.h"
#include "bumper/response/response_settings.h"

namespace bumper {

/// A contact has ended when there was no impulse for this time, s, and the outline is further than
/// that from its partner, m.
inline constexpr double contactPause = 0.5;
inline constexpr double contactDistance = 0.02;

/// While a contact lasts, an impulse is an impact of its own above this many rest speeds.
inline constexpr double impactInContact = 5.0;

/// One impulse on a vehicle, for the sums of a contact.
struct ContactShare {
  ContactPartner with;
  int wall = 0;
  double impulseNormal = 0.0;
  double impulseTangent = 0.0;
  double energyLost = 0.0;
  Eigen::Vector3d contact = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
};

/// Above which approach speed, m/s, an impulse is an impact of its own.
double impactSpeed(const std::vector<SustainedContact>& contacts, const ContactPartner& with,
                   const ResponseSettings& settings);

/// Whether any of them has had no impulse for so long that it may have ended.
bool mayHaveEnded(const std::vector<SustainedContact>& contacts, double time);

/// In how many steps of `h` seconds at most certainly none of them can have ended.
int stepsUntilEnd(const std::vector<SustainedContact>& contacts, double time, double h);

/// Adds an impulse to the vehicle's contact with that partner. Returns whether it began with it;
/// `mayBegin` false: it counts only if there is such a contact.
bool addToContact(std::vector<SustainedContact>& contacts, const ContactShare& share, double time,
                  bool mayBegin);

/// The loads of contacts fade within contactPause.
void fadeLoads(std::vector<SustainedContact>& contacts, double step);

/// A load, N, on a partner that the vehicle is in contact with. Returns whether it is at least
/// twice the recent maximum: a blow, not a steady load.
bool raiseLoad(std::vector<SustainedContact>& contacts, const ContactPartner& with, double load);

}  // namespace bumper
