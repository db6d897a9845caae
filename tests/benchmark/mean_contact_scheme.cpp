#include "mean_contact_scheme.h"

#include <array>
#include <optional>

#include "bumper/engine_adapter/vehicle.h"
#include "bumper/response/force_pulse.h"
#include "bumper/response/impact.h"
#include "bumper/response/outline.h"
#include "ode_scheme.h"
#include "ode_world.h"

namespace bumper::benchmark {

namespace {

using Eigen::Vector3d;

// A mean normal that points up more than this has no direction in the plane.
constexpr double leastPlanarNormal = 0.1;

class MeanContactScheme : public OdeScheme {
 public:
  MeanContactScheme(Setting setting, int triangles)
      : OdeScheme(setting),
        wall_(ode().space, wallScene(triangles)),
        box_(dCreateBox(nullptr, 1.0, 1.0, 1.0)) {}
  ~MeanContactScheme() override { dGeomDestroy(box_); }
  MeanContactScheme(const MeanContactScheme&) = delete;
  MeanContactScheme& operator=(const MeanContactScheme&) = delete;
  MeanContactScheme(MeanContactScheme&&) = delete;
  MeanContactScheme& operator=(MeanContactScheme&&) = delete;

 protected:
  void begin(const Run& run, const examples::YawPlaneCar& car) override {
    car_ = &car;
    pulse_ = {};
    const VehicleParameters& body = run.impactCase->car.body;
    const Band band = defaultBand(body);
    dGeomBoxSetLengths(box_, body.massCentreToFront + body.massCentreToRear, body.width,
                       band.top - band.bottom);
    toMiddle_ = {0.5 * (body.massCentreToFront - body.massCentreToRear), 0.0,
                 0.5 * (band.bottom + band.top) - body.massCentreHeight};
  }

  void step(const Run& run, int /*index*/) override {
    const VehicleParameters& body = run.impactCase->car.body;
    if (const std::optional<Impact> impact = meanOfContacts()) {
      const PlanarMotion motion = motionAhead(body, run.step);
      if (velocityAt(motion, impact->arm).dot(impact->normal) < 0.0) {
        const ImpactResponse response =
            respond(*impact, freeBody(body, motion), run.impactCase->law.settings);
        pulse_.add(response.impulse, 0.0, run.step);
      }
    }
    const PlanarForce force = pulse_.take(run.step);
    dBodyAddForce(car_->body(), force.force.x(), force.force.y(), 0.0);
    dBodyAddTorque(car_->body(), 0.0, 0.0, force.yawMoment);
    dWorldQuickStep(ode().world, run.step);
  }

 private:
  // The car's motion as it would be in this step without the wall.
  [[nodiscard]] PlanarMotion motionAhead(const VehicleParameters& body, double h) const {
    PlanarMotion motion = motionOf(*car_);
    const PlanarImpulse due = pulse_.due(h);
    const dReal* force = dBodyGetForce(car_->body());
    motion.velocity += (h * Vector2(force[0], force[1]) + due.linear) / body.mass;
    motion.yawRate += (h * dBodyGetTorque(car_->body())[2] + due.angular) / body.yawInertia;
    return motion;
  }

  [[nodiscard]] std::optional<Impact> meanOfContacts() const {
    const Vector3d centre = car_->position();
    const Vector3d middle = centre + car_->axes() * toMiddle_;
    dGeomSetPosition(box_, middle.x(), middle.y(), middle.z());
    dGeomSetRotation(box_, dBodyGetRotation(car_->body()));
    constexpr int capacity = 64;
    std::array<dContactGeom, capacity> contacts;
    const int count = dCollide(box_, wall_.geom, capacity, contacts.data(), sizeof(dContactGeom));
    Vector3d point = Vector3d::Zero();
    Vector3d normal = Vector3d::Zero();
    double weight = 0.0;
    for (int i = 0; i < count; ++i) {
      const dContactGeom& contact = contacts[static_cast<std::size_t>(i)];
      point += contact.depth * Vector3d(contact.pos[0], contact.pos[1], contact.pos[2]);
      normal += contact.depth * Vector3d(contact.normal[0], contact.normal[1], contact.normal[2]);
      weight += contact.depth;
    }
    const Vector2 planar = normal.head<2>();
    if (weight <= 0.0 || planar.norm() <= leastPlanarNormal * normal.norm()) return std::nullopt;
    Impact impact;
    impact.normal = planar.normalized();
    impact.point = (point / weight).head<2>();
    impact.arm = impact.point - centre.head<2>();
    return impact;
  }

  tests::OdeMesh wall_;
  dGeomID box_;
  Vector3d toMiddle_ = Vector3d::Zero();
  const examples::YawPlaneCar* car_ = nullptr;
  ForcePulse pulse_;
};

}  // namespace

std::unique_ptr<Scheme> makeMeanContactScheme(Setting setting, int triangles) {
  return std::make_unique<MeanContactScheme>(setting, triangles);
}

}  // namespace bumper::benchmark
