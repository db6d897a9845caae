#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "bumper/response/planar_body.h"

namespace bumper {

/// A contact of one body with a fixed or driven one, or of two, as an impulse along its normal acts
/// on them: each body's normal and arm in the frame of its motion.
struct JointContact {
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  std::size_t body = 0;
  Vector2 normal = Vector2::Zero();  ///< unit, into the body
  Vector2 arm = Vector2::Zero();
  std::size_t otherBody = none;
  Vector2 otherNormal = Vector2::Zero();  ///< into the other one
  Vector2 otherArm = Vector2::Zero();
  double wallSpeed = 0.0;  ///< of a fixed body that moves as prescribed, along the normal, m/s
};

/// The impulses that end all approach at many contacts of many bodies at once, without friction or
/// rebound: of all motions in which nothing approaches they lead to the nearest one, in the measure
/// of kinetic energy. endApproach() for several bodies; the active set is found the same way.
class JointApproach {
 public:
  struct Result {
    std::span<const double> impulses;  ///< N s along each contact's normal, ≥ 0
    std::span<const double> speeds;    ///< at which each separates before, m/s
    double energyChange = 0.0;         ///< of all bodies, J, ≤ 0
    double weight = 0.0;               ///< the sum of impulses times approach speeds before, J
  };
  /// Valid until the next call. At most `mostActive` impulses act at once: what still approaches
  /// then is left to the next call.
  Result solve(std::span<const PlanarBody> bodies, std::span<const JointContact> contacts);

  static constexpr std::size_t mostActive = 128;

 private:
  bool balance(std::span<const PlanarBody> bodies, std::span<const JointContact> contacts);
  bool factorise(std::span<const PlanarBody> bodies, std::span<const JointContact> contacts);

  std::vector<double> impulses_;
  std::vector<double> speeds_;   // at which each contact separates before
  std::vector<bool> isUseless_;  // depends on active ones
  std::vector<std::size_t> active_;
  std::vector<double> factor_;  // of the active contacts' couplings, Cholesky, row by row
  std::vector<double> wanted_;
  std::vector<PlanarBody> bodies_;
};

}  // namespace bumper
