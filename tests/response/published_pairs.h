#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "random_pairs.h"

/// Published impacts of two vehicles (tests/data): states, contact, and what was measured.
namespace bumper::tests {

struct PublishedPair {
  std::string id;
  Pair atContact;  ///< in the pose of the published contact, with the velocities before
  Vector2 point = Vector2::Zero();
  Vector2 normal = Vector2::Zero();  ///< out of the second into the first
  double restitution = 0.0;
  double friction = 0.0;  ///< Coulomb's; 0 where it is critical
  double deltaV[2]{};     ///< m/s
  double yawRate[2]{};    ///< magnitudes, °/s
};

/// pair_tests.csv. One plane frame; headings are counter-clockwise from its x axis, the contact's
/// polar angle from the vehicle's own heading; the normal axis stands at normal_angle_deg and
/// points out of vehicle 2 into vehicle 1.
std::vector<PublishedPair> publishedPairs(const std::filesystem::path& data);

/// pccrash_t.csv, PC-Crash's own output.
PublishedPair pcCrashPair(const std::filesystem::path& data);

/// What an impulse at a point changes: speeds, m/s, and yaw rates, °/s.
struct PairChange {
  double deltaV[2]{};
  double yawRate[2]{};
  Vector2 normal = Vector2::Zero();  ///< out of the second into the first
};

/// At the published point, along the published normal; friction critical unless it is given.
PairChange changeAtPublishedPoint(const PublishedPair& pair, RestitutionKind kind);

/// By respondPair(), from outlines and states alone; Kudlich and Slibar, the published restitution,
/// friction critical unless it is given.
PairChange changeFromOutlines(const PublishedPair& pair, double penetrationTime);

}  // namespace bumper::tests
