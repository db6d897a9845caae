#include "oracle.h"

#include <Eigen/LU>
#include <cmath>

namespace bumper::tests {
namespace {

using Row = Eigen::Matrix<Real, 1, 8>;

// Where the unknowns stand: both bodies' velocity and yaw rate after the impact, and the impulse on
// the vehicle by its components along x and y.
constexpr int vehicleX = 0, vehicleY = 1, vehicleYaw = 2;
constexpr int otherX = 3, otherY = 4, otherYaw = 5;
constexpr int impulseX = 6, impulseY = 7;

Plane exact(const Vector2& vector) { return vector.cast<Real>(); }
Plane left(const Plane& vector) { return {-vector.y(), vector.x()}; }

Plane pointVelocity(const ContactBody& body, const BodyState& state) {
  return state.velocity + state.yawRate * left(exact(body.arm));
}

BodyState stateOf(const ContactBody& body) { return {exact(body.velocity), Real{body.yawRate}}; }

Real energyOf(const ContactBody& body, const BodyState& state) {
  Real energy = 0.0L;
  if (body.inverseMass > 0.0) energy += state.velocity.squaredNorm() / Real{body.inverseMass};
  if (body.inverseYawInertia > 0.0) {
    energy += state.yawRate * state.yawRate / Real{body.inverseYawInertia};
  }
  return 0.5L * energy;
}

/// The velocity of the contact point along a direction, as a row of the system.
Row relativeVelocityAlong(const Situation& situation, const Plane& direction) {
  Row row = Row::Zero();
  row(vehicleX) = direction.x();
  row(vehicleY) = direction.y();
  row(vehicleYaw) = direction.dot(left(exact(situation.vehicle.arm)));
  row(otherX) = -direction.x();
  row(otherY) = -direction.y();
  row(otherYaw) = -direction.dot(left(exact(situation.other.arm)));
  return row;
}

/// Eqs. 1 and 2 for both bodies, Eq. 3, and one more row that says how friction acts.
Exact solved(const Situation& situation, Real restitution, const Row& friction) {
  Eigen::Matrix<Real, 8, 8> matrix = Eigen::Matrix<Real, 8, 8>::Zero();
  Eigen::Matrix<Real, 8, 1> right = Eigen::Matrix<Real, 8, 1>::Zero();
  const auto momentum = [&](int firstRow, const ContactBody& body, Real sign) {
    const Plane arm = exact(body.arm);
    matrix.block<3, 3>(firstRow, firstRow).setIdentity();
    matrix(firstRow, impulseX) = -sign * Real{body.inverseMass};
    matrix(firstRow + 1, impulseY) = -sign * Real{body.inverseMass};
    matrix(firstRow + 2, impulseX) = sign * Real{body.inverseYawInertia} * arm.y();
    matrix(firstRow + 2, impulseY) = -sign * Real{body.inverseYawInertia} * arm.x();
    right(firstRow) = Real{body.velocity.x()};
    right(firstRow + 1) = Real{body.velocity.y()};
    right(firstRow + 2) = Real{body.yawRate};
  };
  momentum(vehicleX, situation.vehicle, 1.0L);
  momentum(otherX, situation.other, -1.0L);
  matrix.row(6) = relativeVelocityAlong(situation, exact(situation.normal));
  right(6) = -restitution * normalBefore(situation);
  matrix.row(7) = friction;
  const Eigen::Matrix<Real, 8, 1> unknowns = matrix.fullPivLu().solve(right);

  const Plane impulse(unknowns(impulseX), unknowns(impulseY));
  return applied(situation, impulse.dot(exact(situation.normal)),
                 impulse.dot(left(exact(situation.normal))));
}

Row ratioRow(const Situation& situation, Real ratio) {
  const Plane direction = left(exact(situation.normal)) - ratio * exact(situation.normal);
  Row row = Row::Zero();
  row(impulseX) = direction.x();
  row(impulseY) = direction.y();
  return row;
}

}  // namespace

Plane closingVelocity(const Situation& situation) {
  return pointVelocity(situation.vehicle, stateOf(situation.vehicle)) -
         pointVelocity(situation.other, stateOf(situation.other));
}

Real normalBefore(const Situation& situation) {
  return closingVelocity(situation).dot(exact(situation.normal));
}

Real tangentBefore(const Situation& situation) {
  return closingVelocity(situation).dot(left(exact(situation.normal)));
}

Exact applied(const Situation& situation, Real normal, Real tangent) {
  const Plane n = exact(situation.normal);
  Exact result;
  result.impulseNormal = normal;
  result.impulseTangent = tangent;
  result.impulse = normal * n + tangent * left(n);
  const auto push = [&](const ContactBody& body, const Plane& impulse) {
    BodyState state = stateOf(body);
    result.energyBefore += energyOf(body, state);
    const Plane arm = exact(body.arm);
    state.velocity += Real{body.inverseMass} * impulse;
    state.yawRate += Real{body.inverseYawInertia} * (arm.x() * impulse.y() - arm.y() * impulse.x());
    result.energyAfter += energyOf(body, state);
    return state;
  };
  result.vehicle = push(situation.vehicle, result.impulse);
  result.other = push(situation.other, -result.impulse);
  const Plane after = pointVelocity(situation.vehicle, result.vehicle) -
                      pointVelocity(situation.other, result.other);
  result.normalAfter = after.dot(n);
  result.tangentAfter = after.dot(left(n));
  return result;
}

std::optional<Exact> atRatio(const Situation& situation, Real restitution, Real ratio) {
  const Exact result = solved(situation, restitution, ratioRow(situation, ratio));
  if (!(result.impulseNormal > 0.0L)) return std::nullopt;
  return result;
}

Exact withoutSlip(const Situation& situation, Real restitution) {
  return solved(situation, restitution,
                relativeVelocityAlong(situation, left(exact(situation.normal))));
}

std::optional<Exact> coulomb(const Situation& situation, Real restitution, Real friction) {
  if (normalBefore(situation) >= 0.0L) return applied(situation, 0.0L, 0.0L);
  Exact sticking = withoutSlip(situation, restitution);
  if (sticking.impulseNormal > 0.0L &&
      std::abs(sticking.impulseTangent) <= friction * sticking.impulseNormal) {
    sticking.regime = Regime::sticking;
    return sticking;
  }
  const Real slipBefore = tangentBefore(situation);
  for (const Real slip : {1.0L, -1.0L}) {  // of the contact point in the end
    std::optional<Exact> sliding = atRatio(situation, restitution, -slip * friction);
    if (!sliding || sliding->tangentAfter * slip < 0.0L) continue;
    sliding->regime = slipBefore * slip >= 0.0L ? Regime::sliding : Regime::reverse_slip;
    return sliding;
  }
  return std::nullopt;
}

EnergyLine::EnergyLine(Situation situation, Real slope)
    : situation_(std::move(situation)), slope_(slope) {
  const auto alongImpulse = [&](Real normal) {
    const Exact state = at(normal);
    return state.normalAfter + slope_ * state.tangentAfter;
  };
  if (alongImpulse(0.0L) >= 0.0L) return;
  Real low = 0.0L, high = 1.0L;
  while (alongImpulse(high) < 0.0L) high *= 2.0L;
  for (int i = 0; i < 80; ++i) {
    const Real middle = 0.5L * (low + high);
    (alongImpulse(middle) < 0.0L ? low : high) = middle;
  }
  deepest_ = 0.5L * (low + high);
}

std::optional<Real> EnergyLine::smaller(Real energy) const { return root(energy, -1.0L); }
std::optional<Real> EnergyLine::larger(Real energy) const { return root(energy, 1.0L); }

std::optional<Real> EnergyLine::root(Real energy, Real direction) const {
  if (at(deepest_).energyAfter > energy) return std::nullopt;
  Real inside = 0.0L, outside = 1.0L;
  while (at(deepest_ + direction * outside).energyAfter < energy) outside *= 2.0L;
  for (int i = 0; i < 90; ++i) {
    const Real middle = 0.5L * (inside + outside);
    (at(deepest_ + direction * middle).energyAfter < energy ? inside : outside) = middle;
  }
  return deepest_ + direction * 0.5L * (inside + outside);
}

}  // namespace bumper::tests
