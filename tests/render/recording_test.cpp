#include "bumper/render/recording.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "bumper/response/error.h"
#include "synthetic_run.h"

namespace bumper {
namespace {

using ::testing::HasSubstr;
using testing::saloon;

constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

ImpactEvent eventOf(std::string_view vehicle) {
  ImpactEvent event;
  event.vehicle = vehicle;
  event.normal = Eigen::Vector3d::UnitY();
  return event;
}

std::string messageOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(Recording, ownsTheNamesOfItsEvents) {
  Recording copy;
  {
    Recording original;
    std::string vehicle = "a car with a name too long to be kept inside a string object";
    std::string barrier = "a barrier with a name too long to be kept inside a string object";
    std::string material = "a material with a name too long to be kept inside a string object";
    original.addVehicle(vehicle, saloon());
    ImpactEvent event = eventOf(vehicle);
    event.barrier = barrier;
    event.material = material;
    std::string other = "another car with a name too long to be kept inside a string object";
    event.otherVehicle = other;
    original.addImpact(event);
    other.assign(other.size(), '-');
    vehicle.assign(vehicle.size(), '-');
    barrier.assign(barrier.size(), '-');
    material.assign(material.size(), '-');
    copy = original;
  }
  const ImpactEvent event = copy.impacts()[0].event();
  EXPECT_THAT(std::string(event.vehicle), HasSubstr("a car with a name"));
  EXPECT_THAT(std::string(event.barrier), HasSubstr("a barrier with a name"));
  EXPECT_THAT(std::string(event.material), HasSubstr("a material with a name"));
  EXPECT_THAT(std::string(event.otherVehicle), HasSubstr("another car with a name"));
}

TEST(Recording, keepsEventsAsTheyAre) {
  Recording run;
  run.addVehicle("car", saloon());
  ImpactEvent event = eventOf("car");
  event.time = 1.25;
  event.contact = {1.0, 2.0, 3.0};
  event.deltaV = 4.5;
  event.energyAsked = notANumber;
  event.regime = Regime::reverse_slip;
  run.addImpact(event);
  const ImpactEvent kept = run.impacts()[0].event();
  EXPECT_EQ(kept.time, 1.25);
  EXPECT_EQ(kept.contact, event.contact);
  EXPECT_EQ(kept.deltaV, 4.5);
  EXPECT_TRUE(std::isnan(kept.energyAsked));
  EXPECT_EQ(kept.regime, Regime::reverse_slip);
}

TEST(Recording, rejectsVehiclesThatCannotBe) {
  Recording run;
  run.addVehicle("car", saloon());
  EXPECT_THAT(messageOf([&] { run.addVehicle("car", saloon()); }), HasSubstr("\"car\" is taken"));
  VehicleParameters massless = saloon();
  massless.mass = 0.0;
  EXPECT_THAT(messageOf([&] { run.addVehicle("other", massless); }), HasSubstr("mass"));
  EXPECT_EQ(run.vehicles().size(), 1U);
}

TEST(Recording, rejectsPosesThatCannotBe) {
  const std::vector<std::pair<std::string, std::function<void(RecordedPose&)>>> defects = {
      {"time", [](RecordedPose& pose) { pose.time = notANumber; }},
      {"position", [](RecordedPose& pose) { pose.position.z() = infinite; }},
      {"orientation", [](RecordedPose& pose) { pose.orientation.x() = notANumber; }},
      {"unit length", [](RecordedPose& pose) { pose.orientation.w() = 1.01; }},
      {"velocity", [](RecordedPose& pose) { pose.velocity.y() = notANumber; }},
      {"yaw rate", [](RecordedPose& pose) { pose.yawRate = infinite; }},
      {"goes back", [](RecordedPose& pose) { pose.time = 1.999; }}};
  Recording run;
  run.addVehicle("car", saloon());
  RecordedPose good;
  good.time = 2.0;
  run.addPose(0, good);
  for (const auto& [word, spoil] : defects) {
    RecordedPose bad = good;
    spoil(bad);
    EXPECT_THAT(messageOf([&] { run.addPose(0, bad); }), HasSubstr(word));
  }
  EXPECT_THAT(messageOf([&] { run.addPose(1, good); }), HasSubstr("no vehicle 1"));
  EXPECT_EQ(run.vehicles()[0].poses.size(), 1U);
  run.addPose(0, good);  // the same time again is no step back
  EXPECT_EQ(run.vehicles()[0].poses.size(), 2U);
}

TEST(Recording, rejectsImpactsThatCannotBe) {
  const std::vector<std::pair<std::string, std::function<void(ImpactEvent&)>>> defects = {
      {"time", [](ImpactEvent& event) { event.time = notANumber; }},
      {"contact point", [](ImpactEvent& event) { event.contact.x() = infinite; }},
      {"normal", [](ImpactEvent& event) { event.normal.x() = notANumber; }},
      {"unit length", [](ImpactEvent& event) { event.normal *= 0.9; }},
      {"arm", [](ImpactEvent& event) { event.arm.y() = notANumber; }},
      {"impulse", [](ImpactEvent& event) { event.impulseTangent = notANumber; }},
      {"velocity change", [](ImpactEvent& event) { event.deltaV = notANumber; }},
      {"speed", [](ImpactEvent& event) { event.speedAfter = infinite; }},
      {"yaw rate", [](ImpactEvent& event) { event.yawRateBefore = notANumber; }},
      {"velocity after", [](ImpactEvent& event) { event.velocityAfter.z() = notANumber; }},
      {"goes back", [](ImpactEvent& event) { event.time = 1.0; }},
      {"not one of its vehicles", [](ImpactEvent& event) { event.vehicle = "bus"; }}};
  Recording run;
  run.addVehicle("car", saloon());
  run.addVehicle("van", saloon());
  ImpactEvent good = eventOf("car");
  good.time = 2.0;
  run.addImpact(good);
  for (const auto& [word, spoil] : defects) {
    ImpactEvent bad = good;
    spoil(bad);
    EXPECT_THAT(messageOf([&] { run.addImpact(bad); }), HasSubstr(word));
  }
  EXPECT_EQ(run.impacts().size(), 1U);
  // Another vehicle's time is its own.
  ImpactEvent other = eventOf("van");
  other.time = 1.0;
  run.addImpact(other);
  EXPECT_EQ(run.impacts().size(), 2U);
}

TEST(Recording, poseBetweenTwoPosesLiesOnTheWay) {
  Recording run;
  run.addVehicle("car", saloon());
  const auto poseAtYaw = [](double time, double yaw, double x, double speed) {
    RecordedPose pose;
    pose.time = time;
    pose.position = {x, 0.0, 0.5};
    pose.orientation = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ());
    pose.velocity = {speed, 0.0, 0.0};
    return pose;
  };
  // Across ±π: from 170° by 40° to the left.
  const double degree = std::numbers::pi / 180.0;
  run.addPose(0, poseAtYaw(1.0, 170.0 * degree, 3.0, 10.0));
  run.addPose(0, poseAtYaw(3.0, 210.0 * degree, 7.0, 20.0));
  const RecordedVehicle& car = run.vehicles()[0];
  const auto pose = poseAt(car, 1.5);
  ASSERT_TRUE(pose);
  EXPECT_NEAR(pose->position.x(), 4.0, 1e-12);
  EXPECT_NEAR(pose->velocity.x(), 12.5, 1e-12);
  EXPECT_NEAR(std::abs(heading(pose->orientation)), std::numbers::pi, 1e-9);
  EXPECT_EQ(poseAt(car, 3.0)->position.x(), 7.0);
  EXPECT_FALSE(poseAt(car, 0.999));
  EXPECT_FALSE(poseAt(car, 3.001));
  EXPECT_FALSE(poseAt(car, notANumber));
}

TEST(Recording, ofTwoPosesAtOneTimeTheLaterCounts) {
  Recording run;
  run.addVehicle("car", saloon());
  RecordedPose pose;
  pose.velocity.x() = 5.0;
  run.addPose(0, pose);
  pose.velocity.x() = -1.0;  // after an impact
  run.addPose(0, pose);
  EXPECT_EQ(poseAt(run.vehicles()[0], 0.0)->velocity.x(), -1.0);
}

TEST(Recording, headingIsThatOfTheForwardAxis) {
  const Eigen::Quaterniond yaw(Eigen::AngleAxisd(2.0, Eigen::Vector3d::UnitZ()));
  const Eigen::Quaterniond pitch(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY()));
  const Eigen::Quaterniond roll(Eigen::AngleAxisd(-0.4, Eigen::Vector3d::UnitX()));
  EXPECT_NEAR(heading(yaw * pitch * roll), 2.0, 1e-12);
}

}  // namespace
}  // namespace bumper
