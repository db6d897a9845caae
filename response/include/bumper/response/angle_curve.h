#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "bumper/base/api.h"
#include "bumper/response/planar_motion.h"

namespace BUMPER_API bumper {

/// A direction of attack on a wall, by its parts across and along it, ≥ 0 and in any unit. The
/// paper's curves need the angle's cosine only, which costs much less than the angle.
struct AttackDirection {
  double across = 0.0;
  double along = 0.0;

  /// From 0 (grazing) to π/2 (head-on), rad; 0 for a zero direction.
  [[nodiscard]] double angle() const;
  [[nodiscard]] double cosine() const {
    const double length2 = across * across + along * along;
    return length2 > 0.0 ? along / std::sqrt(length2) : 1.0;
  }
};

/// A direction against a wall with the given unit normal.
inline AttackDirection attackOn(const Vector2& direction, const Vector2& normal) {
  return {.across = std::abs(direction.dot(normal)), .along = std::abs(cross(direction, normal))};
}

/// A quantity as a function of the angle of attack: restitution, friction, or the fraction of
/// energy that remains. The paper calls its curves "cosine shaped" (Figure 4), which can be read in
/// two ways; both are here, and any table. All throw Error on a number that is not finite.
class AngleCurve {
 public:
  /// The same value at every angle.
  static AngleCurve constant(double value);
  /// headOn + (grazing − headOn) cos α: "a cosine function of the angle of attack".
  static AngleCurve cosine(double grazing, double headOn);
  /// headOn + (grazing − headOn) cos² α: half a period of a cosine, flat at both ends.
  static AngleCurve halfCosine(double grazing, double headOn);
  /// Straight lines between (angle in rad, value) points, constant beyond the first and the last.
  /// Throws Error if there is no point or the angles do not increase.
  static AngleCurve table(std::vector<std::pair<double, double>> points);

  /// The value at an angle of attack from 0 (grazing) to π/2 (head-on), rad.
  [[nodiscard]] double operator()(double angle) const;
  [[nodiscard]] double operator()(const AttackDirection& attack) const;

  /// Smallest and largest value over 0 to π/2.
  [[nodiscard]] std::pair<double, double> range() const;

  /// What it was made of: a constant is a cosine with equal ends, a table has no ends.
  enum class Shape { cosine, half_cosine, table };
  [[nodiscard]] Shape shape() const { return shape_; }
  [[nodiscard]] double grazing() const { return grazing_; }
  [[nodiscard]] double headOn() const { return headOn_; }

 private:
  [[nodiscard]] double atCosine(double cosine) const;
  [[nodiscard]] double inTable(double angle) const;

  Shape shape_ = Shape::cosine;
  double grazing_ = 0.0;
  double headOn_ = 0.0;
  std::vector<std::pair<double, double>> points_;
};

/// The direction that defines the angle of attack; the paper's text allows the second and the
/// third.
enum class AngleDefinition {
  contact_velocity,  ///< the direction in which the contact point moves
  centre_velocity,   ///< the direction in which the mass centre moves
  heading            ///< the vehicle's x axis
};

/// The angle against the wall by all three definitions, rad, each folded to [0, π/2].
struct AnglesOfAttack {
  double contactVelocity = 0.0;
  double centreVelocity = 0.0;
  double heading = 0.0;
};

}  // namespace bumper
