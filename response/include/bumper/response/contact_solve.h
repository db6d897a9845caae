#pragma once

#include "bumper/base/api.h"
#include "bumper/response/planar_body.h"

/// One contact point between a vehicle and something else, as linear algebra. `normal` is a unit
/// vector out of the other body into the vehicle; the tangent is z × normal. With A, B, C below an
/// impulse (J_n, J_t) on the vehicle changes the contact point's relative velocity by
///
///     Δv_n = A J_n + C J_t        Δv_t = C J_n + B J_t
///
/// A and −C are the paper's h and k (Eqs. 15 and 16).
namespace BUMPER_API bumper {

/// One of the two bodies in contact. The default is a barrier: at rest and of infinite mass.
struct ContactBody {
  double inverseMass = 0.0;            ///< 1/kg; 0 for a fixed barrier
  double inverseYawInertia = 0.0;      ///< 1/(kg m²); 0 for a fixed barrier
  Vector2 arm = Vector2::Zero();       ///< mass centre to contact point, m
  Vector2 velocity = Vector2::Zero();  ///< mass centre, m/s
  double yawRate = 0.0;                ///< rad/s
};

/// A body whose contact point lies at `arm` from its mass centre, m.
inline ContactBody contactBody(const PlanarBody& body, const Vector2& arm) {
  return {.inverseMass = 1.0 / body.mass,
          .inverseYawInertia = 1.0 / body.yawInertia,
          .arm = arm,
          .velocity = body.motion.velocity,
          .yawRate = body.motion.yawRate};
}

/// Inverse effective mass at the contact point, 1/kg.
struct ContactMobility {
  double normal = 0.0;    ///< A: normal velocity per normal impulse
  double tangent = 0.0;   ///< B: tangential velocity per tangential impulse
  double coupling = 0.0;  ///< C: either velocity per the other impulse

  /// A B − C² > 0.
  [[nodiscard]] double determinant() const { return normal * tangent - coupling * coupling; }
};

/// Velocity of the vehicle's contact point relative to the other body, m/s. Approaching means
/// normal < 0.
struct ContactVelocity {
  double normal = 0.0;
  double tangent = 0.0;
};

/// Impulse on the vehicle, N s; the other body gets the opposite.
struct ContactImpulse {
  double normal = 0.0;
  double tangent = 0.0;
};

/// What one body adds; a barrier adds nothing.
inline ContactMobility contactMobility(const ContactBody& body, const Vector2& normal) {
  const double armNormal = body.arm.dot(normal);
  const double armTangent = body.arm.dot(turnedLeft(normal));
  return {.normal = body.inverseMass + armTangent * armTangent * body.inverseYawInertia,
          .tangent = body.inverseMass + armNormal * armNormal * body.inverseYawInertia,
          .coupling = -armNormal * armTangent * body.inverseYawInertia};
}

/// Of both bodies together.
inline ContactMobility contactMobility(const ContactBody& vehicle, const ContactBody& other,
                                       const Vector2& normal) {
  const ContactMobility a = contactMobility(vehicle, normal);
  const ContactMobility b = contactMobility(other, normal);
  return {.normal = a.normal + b.normal,
          .tangent = a.tangent + b.tangent,
          .coupling = a.coupling + b.coupling};
}

/// Of a body's contact point, m/s.
inline Vector2 pointVelocity(const ContactBody& body) {
  return body.velocity + body.yawRate * turnedLeft(body.arm);
}

/// Of a body's contact point relative to a body at rest.
inline ContactVelocity contactVelocity(const ContactBody& body, const Vector2& normal) {
  const Vector2 velocity = pointVelocity(body);
  return {.normal = velocity.dot(normal), .tangent = velocity.dot(turnedLeft(normal))};
}

inline ContactVelocity contactVelocity(const ContactBody& vehicle, const ContactBody& other,
                                       const Vector2& normal) {
  const Vector2 relative = pointVelocity(vehicle) - pointVelocity(other);
  return {.normal = relative.dot(normal), .tangent = relative.dot(turnedLeft(normal))};
}

/// The contact point's velocity after an impulse.
inline ContactVelocity afterImpulse(const ContactVelocity& before, const ContactMobility& mobility,
                                    const ContactImpulse& impulse) {
  return {.normal = before.normal + mobility.normal * impulse.normal +
                    mobility.coupling * impulse.tangent,
          .tangent = before.tangent + mobility.coupling * impulse.normal +
                     mobility.tangent * impulse.tangent};
}

/// Kinetic energy that an impulse adds to both bodies together, J; negative for a loss.
inline double energyChange(const ContactVelocity& before, const ContactMobility& mobility,
                           const ContactImpulse& impulse) {
  const ContactVelocity after = afterImpulse(before, mobility, impulse);
  return 0.5 * ((before.normal + after.normal) * impulse.normal +
                (before.tangent + after.tangent) * impulse.tangent);
}

/// The impulse as a vector in the plane with its moment about the vehicle's mass centre.
inline PlanarImpulse onVehicle(const ContactImpulse& impulse, const Vector2& normal,
                               const Vector2& arm) {
  const Vector2 linear = impulse.normal * normal + impulse.tangent * turnedLeft(normal);
  return {.linear = linear, .angular = cross(arm, linear)};
}

}  // namespace bumper
