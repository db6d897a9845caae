// Cars slide along rows of blocks, with joints and not quite in line, by themselves and on wheels.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "box_car.h"
#include "bumper/engine_adapter/responder.h"
#include "hinge2_car.h"
#include "ode_world.h"

namespace bumper::tests {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double h = 0.005;
constexpr double speed = 30.0;   // m/s
constexpr double hardest = 1.5;  // m/s, change of velocity in one step
constexpr double into = 0.5 * std::numbers::pi / 180.0;

enum class Kind { scene, singleMesh };
enum class Car { free, wheels };

struct Row {
  Vector2d origin = Vector2d::Zero();
  double yaw = 0.0;
  double off = 0.0;  // blocks stand out by up to this, m
  double smallestJoint = 0.01;
  double largestJoint = 0.2;

  [[nodiscard]] Vector2d at(double along, double out) const {
    return origin + Vector2d(std::cos(yaw) * along - std::sin(yaw) * out,
                             std::sin(yaw) * along + std::cos(yaw) * out);
  }
};

/// Closed blocks, 6 to 12 m long, whose faces look to the row's left.
Scene blocks(const Row& row, std::mt19937_64& random, double& foremost) {
  std::uniform_real_distribution<double> share(0.0, 1.0);
  Scene scene;
  scene.name = "row";
  scene.meshes.emplace_back();
  foremost = 0.0;
  for (double from = -20.0; from < 90.0;) {
    const double to = from + 6.0 + 6.0 * share(random);
    const double out = row.off * share(random);
    foremost = std::max(foremost, out);
    const auto first = static_cast<std::uint32_t>(scene.vertices.size());
    for (const double z : {0.0, 0.8}) {
      for (const Vector2d& place :
           {row.at(from, out - 0.6), row.at(to, out - 0.6), row.at(to, out), row.at(from, out)}) {
        scene.vertices.emplace_back(place.x(), place.y(), z);
      }
    }
    const auto addQuad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
      scene.triangles.push_back({.corners = {first + a, first + b, first + c}});
      scene.triangles.push_back({.corners = {first + a, first + c, first + d}});
    };
    for (std::uint32_t k = 0; k < 4; ++k) addQuad(k, (k + 1) % 4, (k + 1) % 4 + 4, k + 4);
    addQuad(4, 5, 6, 7);
    from = to + row.smallestJoint + (row.largestJoint - row.smallestJoint) * share(random);
  }
  return scene;
}

/// An application's own mesh in single precision.
class SingleMesh {
 public:
  SingleMesh(dSpaceID space, const Scene& scene) : data_(dGeomTriMeshDataCreate()) {
    for (const Vector3d& v : scene.vertices) {
      for (const double value : {v.x(), v.y(), v.z()}) {
        vertices_.push_back(static_cast<float>(value));
      }
    }
    for (const Scene::Triangle& t : scene.triangles) {
      indices_.insert(indices_.end(), {t.corners[0], t.corners[1], t.corners[2]});
    }
    dGeomTriMeshDataBuildSingle(data_, vertices_.data(), 3 * sizeof(float),
                                static_cast<int>(vertices_.size() / 3), indices_.data(),
                                static_cast<int>(indices_.size()), 3 * sizeof(dTriIndex));
    geom = dCreateTriMesh(space, data_, nullptr, nullptr, nullptr);
  }
  ~SingleMesh() {
    dGeomDestroy(geom);
    dGeomTriMeshDataDestroy(data_);
  }
  SingleMesh(const SingleMesh&) = delete;
  SingleMesh& operator=(const SingleMesh&) = delete;
  SingleMesh(SingleMesh&&) = delete;
  SingleMesh& operator=(SingleMesh&&) = delete;

  dGeomID geom = nullptr;

 private:
  std::vector<float> vertices_;
  std::vector<dTriIndex> indices_;
  dTriMeshDataID data_;
};

struct Slide {
  double hardest = 0.0;    // change of velocity in one step, m/s
  double hardestAt = 0.0;  // along the row, m
  double endSpeed = 0.0;
  double distance = 0.0;
  int mostJoints = 0;  // at the chassis
};

Slide slide(const Row& row, Kind kind, Car which, std::mt19937_64& random) {
  double foremost = 0.0;
  const Scene scene = blocks(row, random, foremost);
  OdeWorld ode(9.81);
  Responder responder(ode.world);
  std::unique_ptr<SingleMesh> mesh;
  if (kind == Kind::scene) {
    responder.addBarrier(scene, {.space = ode.space});
  } else {
    mesh = std::make_unique<SingleMesh>(ode.space, scene);
    responder.addBarrier(mesh->geom);
  }
  const double yaw = row.yaw - into;
  const Vector2d out(-std::sin(row.yaw), std::cos(row.yaw));
  const Vector2d along(std::cos(row.yaw), std::sin(row.yaw));
  const Vector2d start = row.at(0.0, foremost + 0.03 + 2.1 * std::sin(into) + 0.9);
  std::unique_ptr<Hinge2Car> wheeled;
  std::unique_ptr<BoxCar> box;
  VehicleId id;
  if (which == Car::wheels) {
    dCreatePlane(ode.space, 0.0, 0.0, 1.0, 0.0);
    wheeled = std::make_unique<Hinge2Car>(ode.world, ode.space, start, 0.0, yaw, speed);
    id = responder.addVehicle(wheeled->chassis, wheeled->parameters(),
                              {.linkedBodies = wheeled->wheels});
    wheeled->drive(speed, 300.0);
  } else {
    box = std::make_unique<BoxCar>(ode.world, ode.space);
    dBodySetGravityMode(box->body, 0);
    box->place({start.x(), start.y(), 0.55},
               Eigen::AngleAxisd(yaw, Vector3d::UnitZ()).toRotationMatrix());
    box->move({speed * std::cos(yaw), speed * std::sin(yaw), 0.0}, Vector3d::Zero());
    id = responder.addVehicle(box->body, box->parameters);
  }
  const auto velocity = [&]() -> Vector2d { return responder.velocity(id).head<2>(); };
  Slide result;
  Vector2d last = velocity();
  for (double t = 0.0; t < 2.0; t += h) {
    ode.step(h, &responder, [&] {
      if (box) dBodyAddForce(box->body, -1500.0 * out.x(), -1500.0 * out.y(), 0.0);
      responder.step(h);
      const dBodyID chassis = box ? box->body : wheeled->chassis;
      result.mostJoints = std::max(result.mostJoints, dBodyGetNumJoints(chassis));
    });
    const Vector2d place = responder.position(id).head<2>() - row.origin;
    if ((velocity() - last).norm() > result.hardest) {
      result.hardest = (velocity() - last).norm();
      result.hardestAt = along.dot(place);
    }
    last = velocity();
    result.distance = along.dot(place);
  }
  result.endSpeed = along.dot(last);
  return result;
}

class BlockRows : public ::testing::Test {
 protected:
  double uniform(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random_);
  }
  void expectSlides(Car which, Kind kind, int runs, bool far) {
    for (int i = 0; i < runs; ++i) {
      Row row;
      row.yaw = uniform(-std::numbers::pi, std::numbers::pi);
      row.off = i % 3 == 0 ? 0.0 : uniform(0.0002, far ? 0.005 : 0.015);
      row.largestJoint = i % 2 == 0 ? 0.02 : 0.2;
      if (far) {
        const double where = uniform(-std::numbers::pi, std::numbers::pi);
        row.origin = 20e3 * Vector2d(std::cos(where), std::sin(where));
      }
      const Slide result = slide(row, kind, which, random_);
      SCOPED_TRACE(testing::Message()
                   << "run " << i << ", off " << row.off << ", joints to " << row.largestJoint
                   << ", yaw " << row.yaw << ", from " << row.origin.transpose());
      EXPECT_LT(result.hardest, hardest) << "at " << result.hardestAt << " m";
      EXPECT_GT(result.endSpeed, 0.9 * speed);
      // Guard contacts act beside the wheels' own joints, and not without.
      if (which == Car::wheels) {
        EXPECT_GT(result.mostJoints, 4);
      } else {
        EXPECT_EQ(result.mostJoints, 0);
      }
      EXPECT_GT(result.distance, 0.9 * speed * 2.0);
    }
  }

 private:
  std::mt19937_64 random_{11};
};

TEST_F(BlockRows, AFreeCarSlidesAlongAScene) {
  expectSlides(Car::free, Kind::scene, 12, false);
  expectSlides(Car::free, Kind::scene, 12, true);
}
TEST_F(BlockRows, AFreeCarSlidesAlongAMesh) {
  expectSlides(Car::free, Kind::singleMesh, 12, false);
  expectSlides(Car::free, Kind::singleMesh, 12, true);
}
TEST_F(BlockRows, ACarOnWheelsSlidesAlongAScene) {
  expectSlides(Car::wheels, Kind::scene, 8, false);
  expectSlides(Car::wheels, Kind::scene, 8, true);
}
TEST_F(BlockRows, ACarOnWheelsSlidesAlongAMesh) {
  expectSlides(Car::wheels, Kind::singleMesh, 8, false);
  expectSlides(Car::wheels, Kind::singleMesh, 8, true);
}

}  // namespace
}  // namespace bumper::tests
