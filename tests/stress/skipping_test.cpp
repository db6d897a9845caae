// What is skipped changes nothing: two worlds, one of which asks for everything anew in every step,
// go through the same drives, pushes, teleports and changes of barriers, and stay equal bit by bit.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "../response/random_impacts.h"
#include "bumper/scenes/paper_scenes.h"
#include "bumper/scenes/scene_files.h"
#include "extent.h"
#include "ode_car.h"
#include "ode_world.h"

namespace bumper::tests {
namespace {

constexpr int carCount = 4;

// Where cars are put: somewhere on the ground near a point of a wall, or anywhere.
struct Arena {
  Scene scene;
  Eigen::Vector2d low = Eigen::Vector2d::Zero();
  Eigen::Vector2d high = Eigen::Vector2d::Zero();
  std::vector<Wall> walls;

  explicit Arena(Scene itsScene) : scene(std::move(itsScene)), walls(selectWalls(scene).walls) {
    low = high = walls.front().corners[0].head<2>();
    for (const Wall& wall : walls) {
      for (const Eigen::Vector3d& corner : wall.corners) {
        low = low.cwiseMin(corner.head<2>());
        high = high.cwiseMax(corner.head<2>());
      }
    }
  }
};

/// One of the two worlds.
class Side {
 public:
  Side(const Arena& arena, bool skipping) : responder_(ode_.world, {.skipping = skipping}) {
    responder_.addBarrier(arena.scene);
    for (int i = 0; i < carCount; ++i) {
      cars_.push_back(std::make_unique<BoxCar>(ode_.world));
      responder_.addVehicle(cars_.back()->body, cars_.back()->parameters);
    }
  }
  ~Side() {
    for (dGeomID geom : posts_) dGeomDestroy(geom);
  }
  Side(const Side&) = delete;
  Side& operator=(const Side&) = delete;
  Side(Side&&) = delete;
  Side& operator=(Side&&) = delete;

  void place(int car, const PlanarMotion& motion, double height) {
    BoxCar& each = *cars_[static_cast<std::size_t>(car)];
    each.place({motion.position.x(), motion.position.y(), height},
               Eigen::AngleAxisd(motion.yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix());
    each.move({motion.velocity.x(), motion.velocity.y(), 0.0}, {0.0, 0.0, motion.yawRate});
  }

  void push(int car, const Eigen::Vector2d& force, double moment) {
    dBodyID body = cars_[static_cast<std::size_t>(car)]->body;
    dBodyAddForce(body, force.x(), force.y(), 0.0);
    dBodyAddTorque(body, 0.0, 0.0, moment);
  }

  void move(int car, const Eigen::Vector2d& velocity) {
    dBodySetLinearVel(body(car), velocity.x(), velocity.y(), 0.0);
  }

  void turn(int car, double yaw) {
    dMatrix3 rotation;
    dRFromAxisAndAngle(rotation, 0.0, 0.0, 1.0, yaw);
    dBodySetRotation(body(car), rotation);
  }

  void addPost(const Eigen::Vector3d& place) {
    dGeomID post = dCreateCylinder(ode_.space, 0.2, 2.0);
    dGeomSetPosition(post, place.x(), place.y(), place.z());
    posts_.push_back(post);
    barriers_.push_back(responder_.addBarrier(post));
  }

  void movePost(const Eigen::Vector3d& place) {
    if (barriers_.empty()) return;
    dGeomSetPosition(posts_.back(), place.x(), place.y(), place.z());
    responder_.updateBarrier(barriers_.back());
  }

  void removePost() {
    if (barriers_.empty()) return;
    responder_.removeBarrier(barriers_.back());
    dGeomDestroy(posts_.back());
    barriers_.pop_back();
    posts_.pop_back();
  }

  void step(double h) {
    events = responder_.step(h).size();
    dWorldQuickStep(ode_.world, h);
  }

  [[nodiscard]] dBodyID body(int car) const { return cars_[static_cast<std::size_t>(car)]->body; }
  [[nodiscard]] unsigned issues() const { return responder_.issues(); }

  std::size_t events = 0;

 private:
  OdeWorld ode_;
  std::vector<std::unique_ptr<BoxCar>> cars_;
  std::vector<dGeomID> posts_;
  std::vector<BarrierId> barriers_;
  Responder responder_;
};

bool sameBits(const dReal* a, const dReal* b, int count) {
  for (int k = 0; k < count; ++k) {
    if (a[k] != b[k] && !(std::isnan(a[k]) && std::isnan(b[k]))) return false;
  }
  return true;
}

bool sameState(dBodyID a, dBodyID b) {
  return sameBits(dBodyGetPosition(a), dBodyGetPosition(b), 3) &&
         sameBits(dBodyGetQuaternion(a), dBodyGetQuaternion(b), 4) &&
         sameBits(dBodyGetLinearVel(a), dBodyGetLinearVel(b), 3) &&
         sameBits(dBodyGetAngularVel(a), dBodyGetAngularVel(b), 3);
}

// Along a wall and not far from it, without any turn: skipped for as long as nothing else happens.
PlanarMotion besideAWall(Random& random, const Wall& wall) {
  const Eigen::Vector2d normal = wall.normal.head<2>().normalized();
  const Eigen::Vector2d along = random.sign() * turnedLeft(normal);
  PlanarMotion motion;
  motion.position = wall.corners[0].head<2>() + random.sign() * random.uniform(1.2, 5.0) * normal;
  motion.yaw = std::atan2(along.y(), along.x()) + random.uniform(-0.05, 0.05);
  const double speed = random.uniform(5.0, 45.0);
  motion.velocity = {speed * std::cos(motion.yaw), speed * std::sin(motion.yaw)};
  return motion;
}

// Near a wall's corner three times out of four.
PlanarMotion randomStart(Random& random, const Arena& arena, double& height) {
  PlanarMotion motion;
  const Wall& wall =
      arena.walls[static_cast<std::size_t>(random.below(static_cast<int>(arena.walls.size())))];
  height = wall.foot + 0.55;
  if (random.chance(0.5)) return besideAWall(random, wall);
  if (random.below(4) == 0) {
    motion.position = {random.uniform(arena.low.x() - 20.0, arena.high.x() + 20.0),
                       random.uniform(arena.low.y() - 20.0, arena.high.y() + 20.0)};
  } else {
    motion.position = wall.corners[0].head<2>() +
                      Eigen::Vector2d(random.uniform(-15.0, 15.0), random.uniform(-15.0, 15.0));
  }
  motion.yaw = random.uniform(-3.2, 3.2);
  const double speed = random.uniform(0.0, 50.0);
  const double slip = motion.yaw + random.uniform(-0.4, 0.4);
  motion.velocity = {speed * std::cos(slip), speed * std::sin(slip)};
  motion.yawRate = random.uniform(-1.5, 1.5);
  return motion;
}

void expectEqual(const Arena& arena, int steps, std::uint64_t seed) {
  Random random(seed);
  Side skipping(arena, true);
  Side asking(arena, false);
  const auto both = [&](const std::function<void(Side&)>& act) {
    act(skipping);
    act(asking);
  };
  std::vector<Eigen::Vector2d> force(carCount, Eigen::Vector2d::Zero());
  std::vector<double> moment(carCount, 0.0);
  const auto start = [&](int car) {
    double height = 0.0;
    const PlanarMotion motion = randomStart(random, arena, height);
    both([&](Side& side) { side.place(car, motion, height); });
  };
  for (int car = 0; car < carCount; ++car) start(car);
  // What no driver does: a blow for one step, another velocity, another heading, in mid-drive.
  const auto surprise = [&](int car) {
    const double angle = random.uniform(-3.2, 3.2);
    const Eigen::Vector2d way(std::cos(angle), std::sin(angle));
    const double size = random.uniform(0.0, 1.0);
    switch (random.below(4)) {
      case 0:
        both([&](Side& side) { side.push(car, 1e8 * size * way, 0.0); });
        break;
      case 1:
        both([&](Side& side) { side.push(car, Eigen::Vector2d::Zero(), 1e8 * (size - 0.5)); });
        break;
      case 2:
        both([&](Side& side) { side.move(car, 2000.0 * size * way); });
        break;
      default:
        both([&](Side& side) { side.turn(car, angle); });
        break;
    }
  };
  std::size_t events = 0;
  for (int i = 0; i < steps; ++i) {
    for (int car = 0; car < carCount; ++car) {
      const auto index = static_cast<std::size_t>(car);
      // A new drive or, now and then, another push.
      if (random.below(400) == 0) start(car);
      if (random.below(150) == 0) {
        const double most = random.below(4) == 0 ? 15'000.0 : 0.0;
        force[index] = {random.uniform(-most, most), random.uniform(-most, most)};
        moment[index] = random.uniform(-0.3, 0.3) * most;
      }
      both([&](Side& side) { side.push(car, force[index], moment[index]); });
      if (random.below(300) == 0) surprise(car);
    }
    const int change = random.below(500);
    if (change < 2) {
      const dReal* at = dBodyGetPosition(asking.body(0));
      const Eigen::Vector3d place(at[0] + random.uniform(-8.0, 8.0),
                                  at[1] + random.uniform(-8.0, 8.0), at[2]);
      both([&](Side& side) { change == 0 ? side.addPost(place) : side.movePost(place); });
    }
    if (random.below(500) == 0) both([](Side& side) { side.removePost(); });
    const double h = random.below(100) == 0 ? random.uniform(1e-4, 0.1) : 0.005;
    both([&](Side& side) { side.step(h); });
    for (int car = 0; car < carCount; ++car) {
      ASSERT_TRUE(sameState(skipping.body(car), asking.body(car)))
          << "step " << i << ", car " << car;
    }
    ASSERT_EQ(skipping.events, asking.events) << "step " << i;
    ASSERT_EQ(skipping.issues(), asking.issues()) << "step " << i;
    events += asking.events;
  }
  EXPECT_GT(events, static_cast<std::size_t>(steps / 500));
}

TEST(Skipping, ChangesNothingAtTheTestRail) {
  expectEqual(Arena(testRail()), extent(10'000, 300'000), 1);
}

TEST(Skipping, ChangesNothingOnTheCourse) {
  expectEqual(Arena(course()), extent(10'000, 400'000), 2);
}

TEST(Skipping, ChangesNothingFarFromTheOrigin) {
  Scene scene = testRail();
  for (Eigen::Vector3d& vertex : scene.vertices) vertex += Eigen::Vector3d(1e5, -1e5, 0.0);
  expectEqual(Arena(std::move(scene)), extent(5'000, 150'000), 3);
}

class SkippingOnTracks : public testing::TestWithParam<std::string> {};

TEST_P(SkippingOnTracks, ChangesNothing) {
  const std::filesystem::path file = std::filesystem::path(BUMPER_TRACKS_DIR) / GetParam();
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "not fetched: examples/fetch_tracks.sh";
  expectEqual(Arena(loadScene(file, {.up = UpAxis::y, .timeout = 120.0})), extent(2'000, 60'000),
              4);
}

INSTANTIATE_TEST_SUITE_P(Tracks, SkippingOnTracks,
                         testing::Values("road/aalborg/aalborg.acc",
                                         "oval/a-speedway/a-speedway.ac", "road/forza/forza.acc"),
                         [](const auto& each) {
                           const std::string path = each.param;
                           std::string name = std::filesystem::path(path).stem();
                           std::erase(name, '-');
                           return name;
                         });

}  // namespace
}  // namespace bumper::tests
