#include "random_impacts.h"

#include <cmath>
#include <iomanip>
#include <numbers>

namespace bumper::tests {
namespace {

Vector2 randomArm(Random& random, const VehicleParameters& vehicle) {
  const double x = random.chance(0.5) ? vehicle.massCentreToFront : -vehicle.massCentreToRear;
  const double y = 0.5 * vehicle.width * random.sign();
  const double choice = random.uniform(0.0, 1.0);
  if (choice < 0.4) return {x, y};
  if (choice < 0.5) return {x, y * random.uniform(0.0, 1.0)};
  if (choice < 0.6) return {x * random.uniform(0.0, 1.0), y};
  return {random.uniform(-4.0, 4.0), random.uniform(-4.0, 4.0)};
}

ContactBody randomBody(Random& random, double angle) {
  const VehicleParameters vehicle = randomVehicle(random);
  const double speed = std::pow(10.0, random.uniform(-1.0, 1.7));
  ContactBody body;
  body.inverseMass = 1.0 / vehicle.mass;
  body.inverseYawInertia = 1.0 / vehicle.yawInertia;
  body.arm = direction(angle).x() * randomArm(random, vehicle) +
             direction(angle).y() * turnedLeft(randomArm(random, vehicle));
  body.velocity = speed * direction(random.uniform(-std::numbers::pi, std::numbers::pi));
  body.yawRate = random.chance(0.3) ? 0.0 : random.uniform(-6.0, 6.0);
  return body;
}

Vector2 turnedBy(const Vector2& vector, double angle) {
  return std::cos(angle) * vector + std::sin(angle) * turnedLeft(vector);
}

Vector2 flipped(const Vector2& vector) { return {vector.x(), -vector.y()}; }

void print(std::ostream& out, const char* name, const ContactBody& body) {
  out << name << ": 1/m " << body.inverseMass << ", 1/I " << body.inverseYawInertia << ", arm ("
      << body.arm.transpose() << "), velocity (" << body.velocity.transpose() << "), yaw rate "
      << body.yawRate << '\n';
}

}  // namespace

std::ostream& operator<<(std::ostream& out, const Situation& situation) {
  out << std::setprecision(17);
  print(out, "vehicle", situation.vehicle);
  print(out, "other", situation.other);
  return out << "normal (" << situation.normal.transpose() << ")\n";
}

VehicleParameters randomVehicle(Random& random) {
  VehicleParameters vehicle;
  vehicle.mass = random.uniform(700.0, 3000.0);
  const double radiusOfGyration = random.uniform(0.9, 1.8);
  vehicle.yawInertia = vehicle.mass * radiusOfGyration * radiusOfGyration;
  vehicle.massCentreToFront = random.uniform(1.7, 2.6);
  vehicle.massCentreToRear = random.uniform(1.9, 3.4);
  vehicle.width = random.uniform(1.5, 2.1);
  vehicle.massCentreHeight = random.uniform(0.45, 0.8);
  return vehicle;
}

Situation randomImpact(Random& random, Other other) {
  Situation situation;
  situation.vehicle = randomBody(random, random.uniform(-std::numbers::pi, std::numbers::pi));
  if (other == Other::vehicle) {
    situation.other = randomBody(random, random.uniform(-std::numbers::pi, std::numbers::pi));
  }
  situation.normal = direction(random.uniform(-std::numbers::pi, std::numbers::pi));
  const auto speed = [](const ContactBody& body) -> Vector2 {
    return body.velocity + body.yawRate * turnedLeft(body.arm);
  };
  const Vector2 closing = speed(situation.vehicle) - speed(situation.other);
  if (closing.dot(situation.normal) > 0.0) {  // run the film backwards
    for (ContactBody* body : {&situation.vehicle, &situation.other}) {
      body->velocity = -body->velocity;
      body->yawRate = -body->yawRate;
    }
  }
  return situation;
}

double randomRestitution(Random& random) {
  const double choice = random.uniform(0.0, 1.0);
  if (choice < 0.1) return 0.0;
  if (choice < 0.2) return 1.0;
  return random.uniform(0.0, 1.0);
}

double randomFriction(Random& random) {
  const double choice = random.uniform(0.0, 1.0);
  if (choice < 0.1) return 0.0;
  return random.uniform(0.0, choice < 0.6 ? 0.5 : 3.0);
}

Situation mirrored(const Situation& situation) {
  Situation result = situation;
  result.normal = flipped(situation.normal);
  for (ContactBody* body : {&result.vehicle, &result.other}) {
    body->arm = flipped(body->arm);
    body->velocity = flipped(body->velocity);
    body->yawRate = -body->yawRate;
  }
  return result;
}

Situation turned(const Situation& situation, double angle) {
  Situation result = situation;
  result.normal = turnedBy(situation.normal, angle);
  for (ContactBody* body : {&result.vehicle, &result.other}) {
    body->arm = turnedBy(body->arm, angle);
    body->velocity = turnedBy(body->velocity, angle);
  }
  return result;
}

}  // namespace bumper::tests
