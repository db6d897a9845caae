#pragma once

#include <Eigen/Core>
#include <optional>

#include "bumper/response/restitution_law.h"
#include "random_impacts.h"

/// A second way to the answer for one impact, in extended precision. It knows Newton's laws for
/// both bodies, restitution and Coulomb's law, and nothing of the closed form that the library
/// uses: the equations of both bodies are put into one linear system, every way in which friction
/// could act is tried, and the one that Coulomb's law allows is taken.
namespace bumper::tests {

using Real = long double;
using Plane = Eigen::Matrix<Real, 2, 1>;

/// Distance of an answer from the exact one.
inline double apart(const Vector2& answer, const Plane& exact) {
  return static_cast<double>((answer.cast<Real>() - exact).norm());
}

struct BodyState {
  Plane velocity = Plane::Zero();
  Real yawRate = 0.0L;
};

/// Both bodies after an impulse, and what follows from that directly.
struct Exact {
  Plane impulse = Plane::Zero();  ///< on the vehicle, in the situation's frame
  Real impulseNormal = 0.0L;
  Real impulseTangent = 0.0L;
  BodyState vehicle;
  BodyState other;
  Real normalAfter = 0.0L;  ///< of the contact point, relative
  Real tangentAfter = 0.0L;
  Real energyBefore = 0.0L;  ///< of both bodies
  Real energyAfter = 0.0L;
  Regime regime = Regime::separating;
};

/// Contact-point velocity relative to the other body.
Plane closingVelocity(const Situation& situation);
Real normalBefore(const Situation& situation);
Real tangentBefore(const Situation& situation);

/// What an impulse (normal, tangent) does to both bodies.
Exact applied(const Situation& situation, Real normal, Real tangent);

/// The impulse that ends with −e v_n and a given J_t/J_n; nothing if it would pull.
std::optional<Exact> atRatio(const Situation& situation, Real restitution, Real ratio);

/// The impulse that ends with −e v_n and without slip, whatever its sign.
Exact withoutSlip(const Situation& situation, Real restitution);

/// The impulse that Coulomb's law allows, found by trying all three.
std::optional<Exact> coulomb(const Situation& situation, Real restitution, Real friction);

/// Kinetic energy along impulses (J, slope J), J being the normal component.
class EnergyLine {
 public:
  EnergyLine(Situation situation, Real slope);

  [[nodiscard]] Exact at(Real normal) const { return applied(situation_, normal, slope_ * normal); }
  /// Where the kinetic energy is least: there the contact no longer moves along the impulse.
  [[nodiscard]] Real deepest() const { return deepest_; }
  /// The J on either side of the deepest at which the energy is `energy`; nothing if the deepest
  /// keeps more than that.
  [[nodiscard]] std::optional<Real> smaller(Real energy) const;
  [[nodiscard]] std::optional<Real> larger(Real energy) const;

 private:
  [[nodiscard]] std::optional<Real> root(Real energy, Real direction) const;

  Situation situation_;
  Real slope_;
  Real deepest_ = 0.0L;
};

}  // namespace bumper::tests
