#include "bumper/response/contact_solve.h"

namespace bumper {

namespace {

void addBody(ContactMobility& mobility, const ContactBody& body, const Vector2& normal) {
  const double armNormal = body.arm.dot(normal);
  const double armTangent = body.arm.dot(turnedLeft(normal));
  mobility.normal += body.inverseMass + armTangent * armTangent * body.inverseYawInertia;
  mobility.tangent += body.inverseMass + armNormal * armNormal * body.inverseYawInertia;
  mobility.coupling -= armNormal * armTangent * body.inverseYawInertia;
}

Vector2 pointVelocity(const ContactBody& body) {
  return body.velocity + body.yawRate * turnedLeft(body.arm);
}

}  // namespace

ContactMobility contactMobility(const ContactBody& vehicle, const ContactBody& other,
                                const Vector2& normal) {
  ContactMobility mobility;
  addBody(mobility, vehicle, normal);
  addBody(mobility, other, normal);
  return mobility;
}

ContactVelocity contactVelocity(const ContactBody& vehicle, const ContactBody& other,
                                const Vector2& normal) {
  const Vector2 relative = pointVelocity(vehicle) - pointVelocity(other);
  return {.normal = relative.dot(normal), .tangent = relative.dot(turnedLeft(normal))};
}

ContactVelocity afterImpulse(const ContactVelocity& before, const ContactMobility& mobility,
                             const ContactImpulse& impulse) {
  return {.normal = before.normal + mobility.normal * impulse.normal +
                    mobility.coupling * impulse.tangent,
          .tangent = before.tangent + mobility.coupling * impulse.normal +
                     mobility.tangent * impulse.tangent};
}

double energyChange(const ContactVelocity& before, const ContactMobility& mobility,
                    const ContactImpulse& impulse) {
  const ContactVelocity after = afterImpulse(before, mobility, impulse);
  return 0.5 * ((before.normal + after.normal) * impulse.normal +
                (before.tangent + after.tangent) * impulse.tangent);
}

PlanarImpulse onVehicle(const ContactImpulse& impulse, const Vector2& normal, const Vector2& arm) {
  const Vector2 linear = impulse.normal * normal + impulse.tangent * turnedLeft(normal);
  return {.linear = linear, .angular = cross(arm, linear)};
}

}  // namespace bumper
