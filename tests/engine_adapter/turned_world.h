#pragma once

#include <ode/ode.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "bumper/engine_adapter/responder.h"
#include "ode_world.h"

namespace bumper::tests {

/// Other axes than the usual: how a vector with z up is written in that world, and how one in the
/// axes forward, left, up is written in the chassis' own.
struct OtherAxes {
  Eigen::Matrix3d world = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d chassis = Eigen::Matrix3d::Identity();
  double metre = 1.0;
};

/// The columns are where x, y, z go.
inline Eigen::Matrix3d columns(const Eigen::Vector3d& x, const Eigen::Vector3d& y,
                               const Eigen::Vector3d& z) {
  Eigen::Matrix3d matrix;
  matrix << x, y, z;
  return matrix;
}

/// A car of one body and what it may hit, described in metres with z up and x forward, built in a
/// world with other axes. The reference: nothing here is Bumper's own.
class TurnedWorld {
 public:
  explicit TurnedWorld(const OtherAxes& axes, const ResponderOptions& options = {})
      : axes_(axes), responder(ode_.world, with(options, axes)) {}
  ~TurnedWorld() {
    for (dBodyID body : bodies_) dBodyDestroy(body);
  }
  TurnedWorld(const TurnedWorld&) = delete;
  TurnedWorld& operator=(const TurnedWorld&) = delete;
  TurnedWorld(TurnedWorld&&) = delete;
  TurnedWorld& operator=(TurnedWorld&&) = delete;

  [[nodiscard]] Eigen::Vector3d there(const Eigen::Vector3d& v) const {
    return axes_.metre * (axes_.world * v);
  }
  [[nodiscard]] Eigen::Vector3d here(const Eigen::Vector3d& v) const {
    return axes_.world.transpose() * v / axes_.metre;
  }
  [[nodiscard]] Eigen::Vector3d here(const dReal* v) const {
    return here(Eigen::Vector3d(v[0], v[1], v[2]));
  }
  [[nodiscard]] Scene there(Scene scene) const {
    for (Eigen::Vector3d& vertex : scene.vertices) vertex = there(vertex);
    return scene;
  }
  [[nodiscard]] dSpaceID space() const { return ode_.space; }
  [[nodiscard]] dWorldID world() const { return ode_.world; }

  /// Upright, turned by `yaw`.
  dGeomID addBox(const Eigen::Vector3d& place, double yaw, const Eigen::Vector3d& lengths) {
    // In a tilted world its own axes are the usual ones, tilted alike; else the world's.
    const Eigen::Vector3d size =
        axes_.metre * (isTilted() ? lengths : Eigen::Vector3d((axes_.world * lengths).cwiseAbs()));
    const dGeomID box = dCreateBox(ode_.space, size.x(), size.y(), size.z());
    stand(box, place, yaw);
    return box;
  }
  dGeomID addPlane(const Eigen::Vector3d& normal, double distance) {
    const Eigen::Vector3d n = axes_.world * normal;
    return dCreatePlane(ode_.space, n.x(), n.y(), n.z(), axes_.metre * distance);
  }
  dGeomID addSphere(const Eigen::Vector3d& place, double radius) {
    const dGeomID sphere = dCreateSphere(ode_.space, axes_.metre * radius);
    move(sphere, place);
    return sphere;
  }
  dGeomID addCylinder(const Eigen::Vector3d& place, const Eigen::Vector3d& axis, double radius,
                      double length) {
    const dGeomID geom = dCreateCylinder(ode_.space, axes_.metre * radius, axes_.metre * length);
    point(geom, place, axis);
    return geom;
  }
  dGeomID addCapsule(const Eigen::Vector3d& place, const Eigen::Vector3d& axis, double radius,
                     double length) {
    const dGeomID geom = dCreateCapsule(ode_.space, axes_.metre * radius, axes_.metre * length);
    point(geom, place, axis);
    return geom;
  }
  dGeomID addMesh(const Scene& scene) {
    meshes_.push_back(std::make_unique<OdeMesh>(ode_.space, there(scene)));
    return meshes_.back()->geom;
  }

  struct Start {
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    double yaw = 0.0;
    double lean = 0.0;  ///< about the car's own x axis, rad
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
    double yawRate = 0.0;
  };
  VehicleId addCar(const Start& start, const std::string& name = "") {
    const double m = axes_.metre;
    dBodyID body = dBodyCreate(ode_.world);
    const Eigen::Matrix3d inertia = axes_.chassis *
                                    Eigen::Vector3d(600.0, 2400.0, 2600.0).asDiagonal() *
                                    axes_.chassis.transpose() * (m * m);
    dMass mass;
    dMassSetParameters(&mass, 1500.0, 0.0, 0.0, 0.0, inertia(0, 0), inertia(1, 1), inertia(2, 2),
                       inertia(0, 1), inertia(0, 2), inertia(1, 2));
    dBodySetMass(body, &mass);
    dBodySetFiniteRotationMode(body, 1);
    // ODE solves for it row by row, which rounds differently in other axes.
    dBodySetGyroscopicMode(body, 0);
    const Eigen::Vector3d p = there(start.place);
    dBodySetPosition(body, p.x(), p.y(), p.z());
    turn(body, start);
    const Eigen::Vector3d v = there(start.velocity);
    dBodySetLinearVel(body, v.x(), v.y(), v.z());
    const Eigen::Vector3d w = axes_.world * Eigen::Vector3d(0.0, 0.0, start.yawRate);
    dBodySetAngularVel(body, w.x(), w.y(), w.z());
    const Eigen::Vector3d size = m * (axes_.chassis * Eigen::Vector3d(4.6, 1.8, 0.7)).cwiseAbs();
    const dGeomID box = dCreateBox(ode_.space, size.x(), size.y(), size.z());
    dGeomSetBody(box, body);
    const Eigen::Vector3d offset = m * (axes_.chassis * Eigen::Vector3d(-0.2, 0.0, 0.0));
    dGeomSetOffsetPosition(box, offset.x(), offset.y(), offset.z());
    bodies_.push_back(body);
    const ChassisAxes own{.forward = axes_.chassis.col(0), .up = axes_.chassis.col(2)};
    cars_.push_back(responder.addVehicle(
        body, parametersFromBodies(body, {}, 2.1 * m, 2.5 * m, 1.8 * m, 0.55 * m, own),
        {.name = name, .axes = own}));
    return cars_.back();
  }
  [[nodiscard]] dBodyID body(std::size_t car) const { return bodies_[car]; }
  [[nodiscard]] VehicleId car(std::size_t number) const { return cars_[number]; }

  /// What happened in a step, with z up and in metres: events, and how the cars move after it.
  struct Step {
    std::vector<ImpactEvent> events;
    std::vector<Eigen::Vector3d> places;
    std::vector<Eigen::Vector3d> velocities;
    std::vector<Eigen::Vector3d> turning;
  };
  Step step(double h) {
    Step result;
    for (ImpactEvent event : responder.step(h)) {
      event.normal = axes_.world.transpose() * event.normal;
      event.contact = here(event.contact);
      event.velocityAfter = here(event.velocityAfter);
      event.otherVelocityAfter = here(event.otherVelocityAfter);
      result.events.push_back(event);
    }
    dWorldQuickStep(ode_.world, h);
    for (dBodyID each : bodies_) {
      result.places.push_back(here(dBodyGetPosition(each)));
      result.velocities.push_back(here(dBodyGetLinearVel(each)));
      const dReal* w = dBodyGetAngularVel(each);
      result.turning.emplace_back(axes_.world.transpose() * Eigen::Vector3d(w[0], w[1], w[2]));
    }
    return result;
  }

 private:
  [[nodiscard]] bool isTilted() const { return axes_.world.col(2).cwiseAbs().maxCoeff() != 1.0; }
  static ResponderOptions with(ResponderOptions options, const OtherAxes& axes) {
    options.axes = {.up = axes.world.col(2), .metre = axes.metre};
    return options;
  }
  void move(dGeomID geom, const Eigen::Vector3d& place) {
    const Eigen::Vector3d p = there(place);
    dGeomSetPosition(geom, p.x(), p.y(), p.z());
  }
  // About the world's up axis.
  void stand(dGeomID geom, const Eigen::Vector3d& place, double yaw) {
    move(geom, place);
    const Eigen::Vector3d up = axes_.world.col(2);
    if (!isTilted()) {
      dMatrix3 rotation;
      dRFromAxisAndAngle(rotation, up.x(), up.y(), up.z(), yaw);
      dGeomSetRotation(geom, rotation);
      return;
    }
    const Eigen::Matrix3d r =
        axes_.world * Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    set(geom, r);
  }
  static void set(dGeomID geom, const Eigen::Matrix3d& r) {
    const dMatrix3 rotation = {r(0, 0), r(0, 1), r(0, 2), 0.0,     r(1, 0), r(1, 1),
                               r(1, 2), 0.0,     r(2, 0), r(2, 1), r(2, 2), 0.0};
    dGeomSetRotation(geom, rotation);
  }
  void point(dGeomID geom, const Eigen::Vector3d& place, const Eigen::Vector3d& axis) {
    move(geom, place);
    const Eigen::Vector3d z = axes_.world * axis;
    if ((z.array() == 0.0).count() == 2) {
      // To the last bit.
      set(geom, columns({z.z(), z.x(), z.y()}, {z.y(), z.z(), z.x()}, z));
      return;
    }
    set(geom, Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), z).toRotationMatrix());
  }
  void turn(dBodyID body, const Start& start) const {
    const Eigen::Vector3d up = axes_.world.col(2);
    if (start.lean == 0.0 && axes_.world == axes_.chassis) {
      // Its own axes lie as the world's: to the last bit.
      const double s = std::sin(0.5 * start.yaw);
      const dQuaternion q = {std::cos(0.5 * start.yaw), s * up.x(), s * up.y(), s * up.z()};
      dBodySetQuaternion(body, q);
      return;
    }
    const Eigen::Matrix3d r = axes_.world *
                              (Eigen::AngleAxisd(start.yaw, Eigen::Vector3d::UnitZ()) *
                               Eigen::AngleAxisd(start.lean, Eigen::Vector3d::UnitX()))
                                  .toRotationMatrix() *
                              axes_.chassis.transpose();
    const Eigen::Quaterniond q(r);
    const dQuaternion quaternion = {q.w(), q.x(), q.y(), q.z()};
    dBodySetQuaternion(body, quaternion);
  }

  OtherAxes axes_;
  OdeWorld ode_;
  std::vector<std::unique_ptr<OdeMesh>> meshes_;
  std::vector<dBodyID> bodies_;
  std::vector<VehicleId> cars_;

 public:
  Responder responder;
};

}  // namespace bumper::tests
