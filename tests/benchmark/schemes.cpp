#include "schemes.h"

#include <ode/ode.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <optional>

#include "bumper/engine_adapter/responder.h"
#include "bumper/response/error.h"
#include "bumper/response/force_pulse.h"
#include "mean_contact_scheme.h"
#include "ode_scheme.h"
#include "ode_world.h"
#ifdef BUMPER_BULLET
#include "bullet_scheme.h"
#endif

namespace bumper::benchmark {

namespace {

using examples::YawPlaneCar;

// Contacts of a pair that ODE's programs usually ask for.
constexpr int mostContacts = 8;

/// Bumper: its pairs are left out of ODE's contacts.
class BumperScheme : public OdeScheme {
 public:
  BumperScheme(Setting setting, int triangles, Method method)
      : OdeScheme(setting), method_(method), scene_(wallScene(triangles)) {}

 protected:
  void begin(const Run& run, const YawPlaneCar& car) override {
    const CaseLaw& law = run.impactCase->law;
    if (!responder_ || law_ != law.id) {
      law_ = law.id;
      ResponderOptions options;
      options.response = law.settings;
      options.response.method = method_;
      responder_.emplace(ode().world, options);
      responder_->addBarrier(scene_, {.space = ode().space});
    }
    vehicle_ = responder_->addVehicle(car.body(), run.impactCase->car.body);
  }

  void step(const Run& run, int /*index*/) override {
    dSpaceCollide(ode().space, &*responder_, [](void* responder, dGeomID a, dGeomID b) {
      // One car and one wall: every pair is Bumper's, or nothing's.
      if (!static_cast<Responder*>(responder)->claims(a, b)) std::abort();
    });
    responder_->step(run.step);
    dWorldQuickStep(ode().world, run.step);
  }

  void finish() override { responder_->removeVehicle(vehicle_); }

 private:
  Method method_;
  Scene scene_;
  std::optional<Responder> responder_;
  int law_ = 0;
  VehicleId vehicle_;
};

/// ODE's own answer: contact joints with bounce and friction.
class JointScheme : public OdeScheme {
 public:
  enum class Stepper { quick, exact };

  JointScheme(Setting setting, int triangles, Stepper stepper, bool trueNormals)
      : OdeScheme(setting),
        stepper_(stepper),
        trueNormals_(trueNormals),
        joints_(dJointGroupCreate(0)),
        wall_(ode().space, wallScene(triangles)) {
    const StraightWall line = theWall();
    origin_ = line.start;
    normal_ = turnedLeft((line.end - line.start).normalized());
  }
  ~JointScheme() override { dJointGroupDestroy(joints_); }
  JointScheme(const JointScheme&) = delete;
  JointScheme& operator=(const JointScheme&) = delete;
  JointScheme(JointScheme&&) = delete;
  JointScheme& operator=(JointScheme&&) = delete;

 protected:
  void begin(const Run& run, const YawPlaneCar& car) override {
    car_ = car.geom();
    restitution_ = run.impactCase->law.restitution;
    friction_ = run.impactCase->law.friction;
  }

  void step(const Run& run, int /*index*/) override {
    dSpaceCollide(ode().space, this, [](void* scheme, dGeomID /*a*/, dGeomID /*b*/) {
      static_cast<JointScheme*>(scheme)->collide();
    });
    if (stepper_ == Stepper::quick) {
      dWorldQuickStep(ode().world, run.step);
    } else {
      dWorldStep(ode().world, run.step);
    }
    dJointGroupEmpty(joints_);
  }

 private:
  void collide() {
    std::array<dContact, mostContacts> contacts;
    const int count = dCollide(car_, wall_.geom, mostContacts, &contacts[0].geom, sizeof(dContact));
    for (int i = 0; i < count; ++i) {
      dContact& contact = contacts[static_cast<std::size_t>(i)];
      contact.surface = {};
      contact.surface.mode = dContactBounce | dContactApprox1;
      contact.surface.mu = friction_;
      contact.surface.bounce = restitution_;
      contact.surface.bounce_vel = 0.1;
      if (trueNormals_) straighten(contact.geom);
      dJointAttach(dJointCreateContact(ode().world, joints_, &contact), dGeomGetBody(car_),
                   nullptr);
    }
  }

  /// The wall's normal, and no more depth than the car's deepest corner has: ODE's can be far more,
  /// as it belongs to another normal.
  void straighten(dContactGeom& contact) const {
    const dReal* centre = dGeomGetPosition(car_);
    const double height = normal_.dot(Vector2(centre[0], centre[1]) - origin_);
    const Vector2 normal = height < 0.0 ? Vector2(-normal_) : normal_;
    const dReal* axes = dGeomGetRotation(car_);
    dVector3 sides;
    dGeomBoxGetLengths(car_, sides);
    const double reach = 0.5 * sides[0] * std::abs(normal.x() * axes[0] + normal.y() * axes[4]) +
                         0.5 * sides[1] * std::abs(normal.x() * axes[1] + normal.y() * axes[5]);
    contact.normal[0] = normal.x();
    contact.normal[1] = normal.y();
    contact.normal[2] = 0.0;
    contact.depth = std::clamp(reach - std::abs(height), 0.0, contact.depth);
  }

  Stepper stepper_;
  bool trueNormals_;
  dJointGroupID joints_;
  tests::OdeMesh wall_;
  Vector2 origin_;
  Vector2 normal_;
  dGeomID car_ = nullptr;
  double restitution_ = 0.0;
  double friction_ = 0.0;
};

/// The best that the force pulse can do: the reference's impulses at the reference's times.
class GivenScheme : public OdeScheme {
 public:
  using OdeScheme::OdeScheme;

 protected:
  void begin(const Run& /*run*/, const YawPlaneCar& car) override {
    body_ = car.body();
    next_ = 0;
    pulse_ = {};
  }

  void step(const Run& run, int index) override {
    const double now = index * run.step;
    const std::vector<FlightImpact>& impacts = run.reference->flight.impacts;
    for (; next_ < impacts.size() && impacts[next_].time < now + run.step; ++next_) {
      const double start = std::clamp(impacts[next_].time - now, 0.0, run.step);
      pulse_.add(impacts[next_].impulse, start, run.step);
    }
    const PlanarForce force = pulse_.take(run.step);
    dBodyAddForce(body_, force.force.x(), force.force.y(), 0.0);
    dBodyAddTorque(body_, 0.0, 0.0, force.yawMoment);
    dWorldQuickStep(ode().world, run.step);
  }

 private:
  dBodyID body_ = nullptr;
  std::size_t next_ = 0;
  ForcePulse pulse_;
};

}  // namespace

std::unique_ptr<Scheme> makeScheme(const std::string& name, Setting setting, int triangles) {
  if (name == "bumper") {
    return std::make_unique<BumperScheme>(setting, triangles, Method::bumper);
  }
  if (name == "paper") return std::make_unique<BumperScheme>(setting, triangles, Method::paper);
  if (name == "ode_contacts") return makeMeanContactScheme(setting, triangles);
  using Stepper = JointScheme::Stepper;
  if (name == "ode_quickstep") {
    return std::make_unique<JointScheme>(setting, triangles, Stepper::quick, false);
  }
  if (name == "ode_quickstep_true_normal") {
    return std::make_unique<JointScheme>(setting, triangles, Stepper::quick, true);
  }
  if (name == "ode_worldstep") {
    return std::make_unique<JointScheme>(setting, triangles, Stepper::exact, false);
  }
  if (name == "reference_impulses") return std::make_unique<GivenScheme>(setting);
#ifdef BUMPER_BULLET
  if (name == "bullet") return makeBulletScheme(triangles);
#endif
  throw Error("there is no scheme " + name);
}

std::vector<std::string> schemeNames(Setting setting) {
  std::vector<std::string> names = {"bumper",        "paper",         "ode_contacts",
                                    "ode_quickstep", "ode_worldstep", "ode_quickstep_true_normal"};
  if (setting == Setting::tyres) {
    names.emplace_back("reference_impulses");
  } else {
#ifdef BUMPER_BULLET
    names.emplace_back("bullet");
#endif
  }
  return names;
}

double cpuTime() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace bumper::benchmark
