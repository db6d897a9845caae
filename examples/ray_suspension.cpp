#include "ray_suspension.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace bumper::examples {

namespace {

constexpr double sag = 0.08;          // of a spring under its static load, m
constexpr double dampingRatio = 0.6;  // of one wheel's quarter of the car
constexpr double travel = 0.25;       // of a spring beyond its static length, m

// The first thing that a ray hits; its depth is the distance from the ray's origin.
bool firstHit(dGeomID ray, dGeomID ground, dContactGeom& hit) {
  return dCollide(ray, ground, 1, &hit, sizeof hit) > 0;
}

}  // namespace

RaySuspension::RaySuspension(YawPlaneCar& car, dGeomID ground, double gravity)
    : car_(car),
      ground_(ground),
      ray_(dCreateRay(nullptr, car.design().body.massCentreHeight + travel)) {
  dGeomRaySetClosestHit(ray_, 1);
  const YawPlaneCarDesign& design = car.design();
  const double perAxle = 0.5 * design.body.mass * gravity /
                         (design.massCentreToFrontAxle + design.massCentreToRearAxle);
  const double front = perAxle * design.massCentreToRearAxle;
  const double rear = perAxle * design.massCentreToFrontAxle;
  staticLoads_ = {front, front, rear, rear};
}

RaySuspension::~RaySuspension() { dGeomDestroy(ray_); }

void RaySuspension::addForces() {
  const Eigen::Matrix3d axes = car_.axes();
  const Eigen::Vector3d up = axes.col(2);
  const Eigen::Vector3d centre = car_.position();
  const dReal* angular = dBodyGetAngularVel(car_.body());
  const Eigen::Vector3d turning(angular[0], angular[1], angular[2]);

  std::array<double, 4> loads{};
  const std::array<Eigen::Vector2d, 4> wheels = car_.wheels();
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    const Eigen::Vector3d arm = axes.leftCols<2>() * wheels[i];
    const Eigen::Vector3d hub = centre + arm;
    dGeomRaySet(ray_, hub.x(), hub.y(), hub.z(), -up.x(), -up.y(), -up.z());
    dContactGeom hit;
    if (!firstHit(ray_, ground_, hit)) continue;
    const double stiffness = staticLoads_[i] / sag;
    const double quarterMass = 0.25 * car_.design().body.mass;
    const double damping = 2.0 * dampingRatio * std::sqrt(stiffness * quarterMass);
    const double compression = sag + car_.design().body.massCentreHeight - hit.depth;
    const double closing = -(car_.velocity() + turning.cross(arm)).dot(up);
    const double force = std::max(0.0, stiffness * compression + damping * closing);
    loads[i] = force;
    dBodyAddForceAtPos(car_.body(), force * up.x(), force * up.y(), force * up.z(), hub.x(),
                       hub.y(), hub.z());
  }
  car_.load(loads);
}

}  // namespace bumper::examples
