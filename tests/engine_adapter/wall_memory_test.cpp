// What a barrier keeps of its walls: how much memory, and whether they are still the same.

#include <gtest/gtest.h>
#include <malloc.h>
#include <ode/ode.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include "box_car.h"
#include "bumper/engine_adapter/responder.h"
#include "bumper/scenes/paper_scenes.h"
#include "ode_world.h"

namespace bumper::tests {
namespace {

std::size_t bytesInUse() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

/// Walls and ground of a course with panels of 0.54 m.
Scene fineCourse() {
  return course(
      {.innerPanels = 10000, .outerPanels = 10000, .groundAlong = 2000, .groundAcross = 3});
}

/// ODE's own mesh of the walls, as an application would build it: corners that are the same once.
class PlainMesh {
 public:
  explicit PlainMesh(const Scene& scene) {
    std::vector<int> number(scene.vertices.size(), -1);
    std::size_t corners = 0;
    const Walls walls = selectWalls(scene);
    for (const Wall& wall : walls.walls) {
      for (const std::uint32_t corner :
           scene.triangles[static_cast<std::size_t>(wall.triangle)].corners) {
        if (number[corner] < 0) number[corner] = static_cast<int>(corners++);
      }
    }
    vertices_.resize(3 * corners);
    indices_.reserve(3 * walls.walls.size());
    for (const Wall& wall : walls.walls) {
      for (const std::uint32_t corner :
           scene.triangles[static_cast<std::size_t>(wall.triangle)].corners) {
        const auto own = static_cast<std::size_t>(number[corner]);
        indices_.push_back(static_cast<dTriIndex>(own));
        for (std::size_t axis = 0; axis < 3; ++axis) {
          vertices_[3 * own + axis] = scene.vertices[corner][static_cast<int>(axis)];
        }
      }
    }
    const std::size_t before = bytesInUse();
    data_ = dGeomTriMeshDataCreate();
    dGeomTriMeshDataBuildDouble(data_, vertices_.data(), 3 * sizeof(double),
                                static_cast<int>(corners), indices_.data(),
                                static_cast<int>(indices_.size()), 3 * sizeof(dTriIndex));
    mesh_ = dCreateTriMesh(nullptr, data_, nullptr, nullptr, nullptr);
    memory_ = bytesInUse() - before + vertices_.size() * sizeof(double) +
              indices_.size() * sizeof(dTriIndex);
  }
  ~PlainMesh() {
    dGeomDestroy(mesh_);
    dGeomTriMeshDataDestroy(data_);
  }
  PlainMesh(const PlainMesh&) = delete;
  PlainMesh& operator=(const PlainMesh&) = delete;
  PlainMesh(PlainMesh&&) = delete;
  PlainMesh& operator=(PlainMesh&&) = delete;

  [[nodiscard]] std::size_t memory() const { return memory_; }

 private:
  std::vector<double> vertices_;
  std::vector<dTriIndex> indices_;
  dTriMeshDataID data_ = nullptr;
  dGeomID mesh_ = nullptr;
  std::size_t memory_ = 0;
};

TEST(WallMemory, IsLittleMoreThanThatOfOdesOwnMesh) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer's allocator does not count for mallinfo2()";
#endif
  const Scene scene = fineCourse();
  const PlainMesh plain(scene);
  OdeWorld ode;
  Responder responder(ode.world);
  const std::size_t before = bytesInUse();
  const BarrierId barrier = responder.addBarrier(scene);
  const std::size_t memory = bytesInUse() - before;
  EXPECT_EQ(responder.report(barrier).walls, 40000U);
  EXPECT_LT(static_cast<double>(memory), 1.25 * static_cast<double>(plain.memory()));
  // And the report says it; names and the like are left out, and so is what malloc counts as in use
  // because it keeps small freed blocks at hand: some 2 KB.
  EXPECT_NEAR(static_cast<double>(responder.report(barrier).memory), static_cast<double>(memory),
              8192.0);
}

/// The first impact of a car with the wall that runs through a place.
std::optional<ImpactEvent> firstImpact(const Eigen::Vector3d& place, double yaw, double heading) {
  const Eigen::Vector3d along(std::cos(yaw), std::sin(yaw), 0.0);
  const Eigen::Vector3d normal(-along.y(), along.x(), 0.0);
  Scene scene = straightWall(-30.0 * along.head<2>(), 30.0 * along.head<2>(), 1.0, 200, 2);
  for (Eigen::Vector3d& vertex : scene.vertices) vertex += place;
  OdeWorld ode;
  Responder responder(ode.world);
  responder.addBarrier(scene);
  BoxCar car(ode.world);
  responder.addVehicle(car.body, car.parameters);
  const double forward = yaw - heading;
  const Eigen::Vector3d start =
      place + 4.0 * normal + Eigen::Vector3d(0, 0, car.parameters.massCentreHeight);
  dBodySetPosition(car.body, start.x(), start.y(), start.z());
  dMatrix3 rotation;
  dRFromAxisAndAngle(rotation, 0.0, 0.0, 1.0, forward);
  dBodySetRotation(car.body, rotation);
  dBodySetLinearVel(car.body, 20.0 * std::cos(forward), 20.0 * std::sin(forward), 0.0);
  for (int i = 0; i < 400; ++i) {
    for (const ImpactEvent& event : responder.step(0.005)) return event;
    dWorldQuickStep(ode.world, 0.005);
  }
  return std::nullopt;
}

TEST(WallMemory, WallsFarFromTheOriginAreAsExactAsNearIt) {
  // Where ODE's single precision is 8 mm, and beyond where it is none at all.
  for (const double away : {1e5, 1e6}) {
    // Of the coordinates there.
    const double rounding = 64.0 * (std::nextafter(away, 2.0 * away) - away);
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> turn(-std::numbers::pi, std::numbers::pi);
    std::uniform_real_distribution<double> attack(0.1, 1.5);
    for (int i = 0; i < 50; ++i) {
      const double yaw = turn(random);
      const double heading = attack(random);
      const Eigen::Vector3d place(away, -0.7 * away, 0.01 * away);
      const std::optional<ImpactEvent> here = firstImpact(Eigen::Vector3d::Zero(), yaw, heading);
      const std::optional<ImpactEvent> there = firstImpact(place, yaw, heading);
      ASSERT_TRUE(here.has_value());
      ASSERT_TRUE(there.has_value());
      EXPECT_NEAR(there->time, here->time, rounding);
      EXPECT_LT((there->contact - place - here->contact).norm(), 20.0 * rounding);
      EXPECT_NEAR(there->impulseNormal, here->impulseNormal, 1e6 * rounding);
    }
  }
}

}  // namespace
}  // namespace bumper::tests
