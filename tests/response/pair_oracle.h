#pragma once

#include <optional>

#include "bumper/response/response_settings.h"
#include "random_pairs.h"

/// The hit of two vehicles, worked out anew in extended precision: polygons clipped one half-plane
/// after the other, the time of touch by bisection, and the two equations of the contact.
namespace bumper::tests {

struct OracleHit {
  double time = 0.0;  ///< of first touch, s
  Vector2 point = Vector2::Zero();
  Vector2 normal = Vector2::Zero();   ///< out of the second into the first
  Vector2 impulse = Vector2::Zero();  ///< on the first, N s, undiminished
  double approach = 0.0;              ///< of the contact point, m/s; ≤ 0: none
  double speed = 0.0;                 ///< of the contact point, m/s
  double extent = 0.0;                ///< of the overlap in the engaged pose, along the normal, m
  double slip = 0.0;                  ///< along the contact before, m/s
  double criticalRatio = 0.0;
};

/// What the first touch within `h` seconds does under the restitution law; none if they do not
/// touch. Without the cap on the engaged depth and without the fading of slivers.
std::optional<OracleHit> oracleHit(const Pair& pair, const ResponseSettings& settings, double h);

/// How far apart the outlines are after `time` seconds, m: by the best of their eight sides;
/// negative if they overlap.
long double oracleSeparation(const Pair& pair, long double time);

}  // namespace bumper::tests
