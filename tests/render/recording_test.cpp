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
      {"velocity before", [](ImpactEvent& event) { event.velocityBefore.x() = infinite; }},
      {"other vehicle is itself", [](ImpactEvent& event) { event.otherVehicle = "car"; }},
      {"other vehicle's arm", [](ImpactEvent& event) { event.otherArm.y() = -infinite; }},
      {"other vehicle's velocity before",
       [](ImpactEvent& event) { event.otherVelocityBefore.z() = infinite; }},
      {"other vehicle's velocity after",
       [](ImpactEvent& event) { event.otherVelocityAfter.x() = infinite; }},
      {"other vehicle's yaw rate", [](ImpactEvent& event) { event.otherYawRateAfter = infinite; }},
      {"goes back", [](ImpactEvent& event) { event.time = 1.0; }},
      {"not one of its vehicles", [](ImpactEvent& event) { event.vehicle = "bus"; }}};
  Recording run;
  run.addVehicle("car", saloon());
  run.addVehicle("van", saloon());
  ImpactEvent good = eventOf("car");
  good.time = 2.0;
  good.otherVehicle = "one that nobody recorded";
  good.otherArm.x() = good.otherYawRateBefore = notANumber;
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

TEST(Recording, theOtherVehicleSeesTheSameImpact) {
  ImpactEvent event = eventOf("car");
  event.otherVehicle = "van";
  event.contact = {1.0, 2.0, 0.5};
  event.arm = {2.0, 0.5};
  event.otherArm = {-1.0, 0.7};
  event.impulseNormal = 6000.0;
  event.impulseTangent = -1200.0;
  // Of 1500 kg and 2000 kg, along (−tangent, normal) = (1200, 6000) N s.
  event.velocityBefore = {10.0, -3.0, 0.0};
  event.velocityAfter = {10.8, 1.0, 0.0};
  event.otherVelocityBefore = {3.0, 4.0, 0.0};
  event.otherVelocityAfter = {2.4, 1.0, 0.0};
  event.deltaV = std::hypot(0.8, 4.0);
  event.speedBefore = std::hypot(10.0, 3.0);
  event.speedAfter = std::hypot(10.8, 1.0);
  event.yawRateAfter = 1.0;
  event.otherYawRateAfter = -2.0;
  EXPECT_EQ(asSeenBy("car", event)->vehicle, "car");
  EXPECT_FALSE(asSeenBy("bus", event));
  EXPECT_FALSE(asSeenBy("", eventOf("car"))) << "a barrier sees nothing";
  const ImpactEvent van = asSeenBy("van", event).value();
  EXPECT_EQ(van.vehicle, "van");
  EXPECT_EQ(van.otherVehicle, "car");
  EXPECT_EQ(van.contact, event.contact);
  EXPECT_EQ(van.arm, event.otherArm);
  EXPECT_EQ(van.otherArm, event.arm);
  EXPECT_DOUBLE_EQ(van.deltaV, std::hypot(0.6, 3.0));
  EXPECT_DOUBLE_EQ(van.speedBefore, 5.0);
  EXPECT_DOUBLE_EQ(van.speedAfter, std::hypot(2.4, 1.0));
  EXPECT_EQ(van.yawRateAfter, -2.0);
  EXPECT_EQ(van.otherYawRateAfter, 1.0);
  // The impulse in the world is the opposite one.
  const auto impulseOf = [](const ImpactEvent& e) {
    return Eigen::Vector3d(e.impulseNormal * e.normal +
                           e.impulseTangent * Eigen::Vector3d::UnitZ().cross(e.normal));
  };
  EXPECT_TRUE(impulseOf(van).isApprox(-impulseOf(event), 1e-15));
  EXPECT_TRUE(impulseOf(van).isApprox(2000.0 * (van.velocityAfter - van.velocityBefore), 1e-12));
  const ImpactEvent back = asSeenBy("car", van).value();
  EXPECT_EQ(back.arm, event.arm);
  EXPECT_EQ(back.normal, event.normal);
  EXPECT_EQ(back.deltaV, event.deltaV);
  EXPECT_EQ(back.velocityBefore, event.velocityBefore);
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
