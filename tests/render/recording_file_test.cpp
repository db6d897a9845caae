#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "bumper/render/recording_reader.h"
#include "bumper/render/recording_writer.h"
#include "bumper/response/error.h"
#include "bumper/scenes/paper_scenes.h"
#include "long_run.h"
#include "synthetic_run.h"
#include "temporary_folder.h"
#include "text_file.h"

namespace bumper {
namespace {

using testing::addLongRun;
using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::peakMemory;
using testing::readText;
using testing::saloon;
using testing::TemporaryFolder;
using testing::writeText;

constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();

std::string messageOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

/// The same double, −0 and NaN included.
void expectSame(double actual, double expected, const char* what) {
  if (std::isnan(expected)) {
    EXPECT_TRUE(std::isnan(actual)) << what;
  } else {
    EXPECT_EQ(std::bit_cast<std::uint64_t>(actual), std::bit_cast<std::uint64_t>(expected))
        << what << ": " << actual << " instead of " << expected;
  }
}

template <typename Vector>
void expectSameVector(const Vector& actual, const Vector& expected, const char* what) {
  for (Eigen::Index k = 0; k < expected.size(); ++k) expectSame(actual[k], expected[k], what);
}

void expectSame(const RecordedPose& actual, const RecordedPose& expected) {
  expectSame(actual.time, expected.time, "time");
  expectSameVector(actual.position, expected.position, "position");
  expectSameVector(actual.orientation.coeffs(), expected.orientation.coeffs(), "orientation");
  expectSameVector(actual.velocity, expected.velocity, "velocity");
  expectSame(actual.yawRate, expected.yawRate, "yaw rate");
}

void expectSame(const ImpactEvent& actual, const ImpactEvent& expected) {
  expectSame(actual.time, expected.time, "time");
  EXPECT_EQ(actual.phase, expected.phase);
  EXPECT_EQ(actual.vehicle, expected.vehicle);
  EXPECT_EQ(actual.barrier, expected.barrier);
  EXPECT_EQ(actual.otherVehicle, expected.otherVehicle);
  EXPECT_EQ(actual.triangle, expected.triangle);
  EXPECT_EQ(actual.material, expected.material);
  expectSameVector(actual.contact, expected.contact, "contact");
  expectSameVector(actual.normal, expected.normal, "normal");
  expectSameVector(actual.arm, expected.arm, "arm");
  EXPECT_EQ(actual.law, expected.law);
  expectSame(actual.angles.contactVelocity, expected.angles.contactVelocity, "angle 1");
  expectSame(actual.angles.centreVelocity, expected.angles.centreVelocity, "angle 2");
  expectSame(actual.angles.heading, expected.angles.heading, "angle 3");
  expectSame(actual.approachSpeed, expected.approachSpeed, "approach speed");
  expectSame(actual.restitution, expected.restitution, "restitution");
  expectSame(actual.friction, expected.friction, "friction");
  expectSame(actual.impulseNormal, expected.impulseNormal, "normal impulse");
  expectSame(actual.impulseTangent, expected.impulseTangent, "tangential impulse");
  expectSame(actual.impulseRatio, expected.impulseRatio, "impulse ratio");
  expectSame(actual.criticalImpulseRatio, expected.criticalImpulseRatio, "critical ratio");
  expectSame(actual.deltaV, expected.deltaV, "delta v");
  expectSame(actual.yawRateBefore, expected.yawRateBefore, "yaw rate before");
  expectSame(actual.yawRateAfter, expected.yawRateAfter, "yaw rate after");
  expectSame(actual.speedBefore, expected.speedBefore, "speed before");
  expectSame(actual.speedAfter, expected.speedAfter, "speed after");
  expectSameVector(actual.velocityBefore, expected.velocityBefore, "velocity before");
  expectSameVector(actual.otherArm, expected.otherArm, "other arm");
  expectSameVector(actual.otherVelocityBefore, expected.otherVelocityBefore, "other before");
  expectSameVector(actual.otherVelocityAfter, expected.otherVelocityAfter, "other after");
  expectSame(actual.otherYawRateBefore, expected.otherYawRateBefore, "other yaw rate before");
  expectSame(actual.otherYawRateAfter, expected.otherYawRateAfter, "other yaw rate after");
  expectSameVector(actual.velocityAfter, expected.velocityAfter, "velocity after");
  expectSame(actual.energyAsked, expected.energyAsked, "energy asked");
  expectSame(actual.energyRatio, expected.energyRatio, "energy ratio");
  expectSame(actual.energyLost, expected.energyLost, "energy lost");
  expectSame(actual.duration, expected.duration, "duration");
  EXPECT_EQ(actual.outcome, expected.outcome);
  EXPECT_EQ(actual.regime, expected.regime);
}

void expectSame(const Recording& actual, const Recording& expected) {
  ASSERT_EQ(actual.vehicles().size(), expected.vehicles().size());
  for (std::size_t k = 0; k < expected.vehicles().size(); ++k) {
    const RecordedVehicle& a = actual.vehicles()[k];
    const RecordedVehicle& b = expected.vehicles()[k];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.settings, b.settings);
    expectSame(a.parameters.mass, b.parameters.mass, "mass");
    expectSame(a.parameters.yawInertia, b.parameters.yawInertia, "yaw inertia");
    expectSame(a.parameters.massCentreToFront, b.parameters.massCentreToFront, "front");
    expectSame(a.parameters.massCentreToRear, b.parameters.massCentreToRear, "rear");
    expectSame(a.parameters.width, b.parameters.width, "width");
    expectSame(a.parameters.massCentreHeight, b.parameters.massCentreHeight, "height");
    ASSERT_EQ(a.poses.size(), b.poses.size());
    for (std::size_t i = 0; i < b.poses.size(); ++i) expectSame(a.poses[i], b.poses[i]);
  }
  ASSERT_EQ(actual.impacts().size(), expected.impacts().size());
  for (std::size_t k = 0; k < expected.impacts().size(); ++k) {
    expectSame(actual.impacts()[k].event(), expected.impacts()[k].event());
  }
}

/// Numbers of every size and sign.
class AnyNumbers {
 public:
  double operator()() {
    std::uniform_real_distribution<double> mantissa(-1.0, 1.0);
    std::uniform_int_distribution<int> exponent(-300, 300);
    switch (exponent(engine_) % 10) {
      case 0:
        return -0.0;
      case 1:
        return static_cast<double>(exponent(engine_));
      default:
        return std::ldexp(mantissa(engine_), exponent(engine_));
    }
  }

  double any() { return engine_() % 8 == 0 ? notANumber : (*this)(); }

  template <typename Value>
  Value of(std::initializer_list<Value> values) {
    return values.begin()[engine_() % values.size()];
  }

 private:
  std::mt19937_64 engine_{20031001};
};

RecordedPose anyPose(double time, AnyNumbers& numbers) {
  RecordedPose pose;
  pose.time = time;
  pose.position = {numbers(), numbers(), numbers()};
  pose.orientation =
      Eigen::Quaterniond(0.3 + std::abs(std::sin(time)), std::cos(time), -0.0, std::cos(3.0 * time))
          .normalized();
  pose.velocity = {numbers(), numbers(), numbers()};
  pose.yawRate = numbers();
  return pose;
}

ImpactEvent anyImpact(double time, std::string_view vehicle, AnyNumbers& numbers) {
  ImpactEvent event;
  event.time = time;
  event.phase =
      numbers.of({EventPhase::impact, EventPhase::contact_begin, EventPhase::contact_end});
  event.vehicle = vehicle;
  event.barrier = "rail, \"north\"\n\t\\ \u00e4";
  event.triangle = numbers.of({-1, 0, 2147483647});
  if (numbers.of({true, false})) {
    event.otherVehicle = "lorry, \"south\"";
    event.otherArm = {numbers.any(), numbers.any()};
    event.otherVelocityBefore = {numbers.any(), numbers.any(), numbers.any()};
    event.otherVelocityAfter = {numbers.any(), numbers.any(), numbers.any()};
    event.otherYawRateBefore = numbers.any();
    event.otherYawRateAfter = numbers.any();
  }
  event.material = "";
  event.contact = {numbers(), numbers(), numbers()};
  event.normal = Eigen::Vector3d(std::sin(time), std::cos(time), 0.1).normalized();
  event.arm = {numbers(), numbers()};
  event.law = numbers.of({Law::restitution, Law::energy});
  event.angles = {
      .contactVelocity = numbers.any(), .centreVelocity = numbers.any(), .heading = numbers.any()};
  event.impulseNormal = numbers();
  event.impulseTangent = numbers();
  event.deltaV = numbers();
  event.yawRateBefore = numbers();
  event.yawRateAfter = numbers();
  event.speedBefore = numbers();
  event.speedAfter = numbers();
  event.velocityBefore = {numbers.any(), numbers.any(), numbers.any()};
  event.velocityAfter = {numbers(), numbers(), numbers()};
  for (double* number : {&event.approachSpeed, &event.restitution, &event.friction,
                         &event.impulseRatio, &event.criticalImpulseRatio, &event.energyAsked,
                         &event.energyRatio, &event.energyLost, &event.duration}) {
    *number = numbers.any();
  }
  event.outcome =
      numbers.of({EnergyOutcome::not_asked, EnergyOutcome::met,
                  EnergyOutcome::limited_by_restitution, EnergyOutcome::limited_by_friction,
                  EnergyOutcome::below_reach, EnergyOutcome::no_break_through});
  event.regime =
      numbers.of({Regime::separating, Regime::sliding, Regime::sticking, Regime::reverse_slip});
  return event;
}

/// Three vehicles: two with the same times, one that comes later, with others, and goes earlier.
Recording anyRun() {
  AnyNumbers numbers;
  Recording run;
  run.addVehicle("first", saloon(), {{"model", "saloon"}, {"drag", 0.31}});
  run.addVehicle("second \u8eca", saloon());
  run.addVehicle("odd", saloon());
  for (int k = 0; k < 200; ++k) {
    const double time = k / 30.0;
    run.addPose(0, anyPose(time, numbers));
    run.addPose(1, anyPose(time, numbers));
    if (k == 77) run.addPose(1, anyPose(time, numbers));  // before and after an impact
    if (k > 20 && k < 150) run.addPose(2, anyPose(time + 0.011, numbers));
    if (k % 7 == 3) run.addImpact(anyImpact(time, "first", numbers));
    if (k % 50 == 3) run.addImpact(anyImpact(time - 0.01, "second \u8eca", numbers));
  }
  return run;
}

RunDescription description() {
  RunDescription run;
  run.scene = referenceTo(testRail());
  run.scene.builtIn = "test_rail";
  run.parameters = {{"law", "energy"}, {"step", 0.005}, {"a \"b\"", notANumber}};
  return run;
}

TEST(RecordingFile, readsBackBitForBit) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "run.jsonl";
  const Recording run = anyRun();
  writeRecording(run, file, description());
  RunDescription read;
  expectSame(readRecording(file, &read), run);
  EXPECT_EQ(read.scene.name, testRail().name);
  EXPECT_EQ(read.scene.builtIn, "test_rail");
  EXPECT_EQ(read.scene.file, "");
  EXPECT_EQ(read.scene.triangles, testRail().triangles.size());
  EXPECT_EQ(read.scene.hash, description().scene.hash);
  EXPECT_EQ(std::get<std::string>(read.parameters.at("law")), "energy");
  EXPECT_EQ(std::get<double>(read.parameters.at("step")), 0.005);
  EXPECT_TRUE(std::isnan(std::get<double>(read.parameters.at("a \"b\""))));
  // Written again it is the same file.
  const auto again = folder.path() / "again.jsonl";
  writeRecording(readRecording(file), again, read);
  EXPECT_EQ(readText(file), readText(again));
}

TEST(RecordingFile, everyLineIsJsonInOrderOfTime) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "run.jsonl";
  writeRecording(anyRun(), file, description());
  std::ifstream lines(file);
  std::vector<nlohmann::json> objects;
  for (std::string line; std::getline(lines, line);) objects.push_back(nlohmann::json::parse(line));
  ASSERT_GT(objects.size(), 300U);
  EXPECT_EQ(objects.front()["format"], "bumper-recording");
  EXPECT_EQ(objects.front()["vehicles"][0]["name"], "first");
  EXPECT_EQ(objects.front()["vehicles"][0]["mass"], saloon().mass);
  EXPECT_EQ(objects.front()["vehicles"][0]["settings"]["model"], "saloon");
  EXPECT_EQ(objects.back()["kind"], "end");
  double last = 0.0;
  int poseLines = 0;
  for (const auto& object : objects) {
    if (object["kind"] != "poses") continue;
    EXPECT_GE(object["time"].get<double>(), last);
    last = object["time"];
    ++poseLines;
    EXPECT_EQ(object["poses"][0].size(), objects.front()["poseColumns"].size());
  }
  EXPECT_EQ(poseLines, 200 + 129);  // vehicles of one time share a line
}

TEST(RecordingFile, aStreamIsTheSameAsTheWhole) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "run.jsonl";
  Recording run;
  AnyNumbers numbers;
  {
    RecordingWriter writer(file);
    run.addVehicle("car", saloon());
    EXPECT_EQ(writer.addVehicle("car", saloon()), 0U);
    for (int k = 0; k < 100; ++k) {
      const RecordedPose pose = anyPose(k, numbers);
      run.addPose(0, pose);
      writer.addPose(0, pose);
      const ImpactEvent impact = anyImpact(k - 0.5, "car", numbers);
      run.addImpact(impact);
      writer.addImpact(impact);
    }
  }  // closed by its end
  EXPECT_TRUE(RecordingReader(file).isComplete());
  expectSame(readRecording(file), run);
}

TEST(RecordingFile, recordingsWithoutPosesOrImpacts) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "run.jsonl";
  writeRecording({}, file);
  RecordingReader empty(file);
  EXPECT_FALSE(empty.firstTime());
  EXPECT_FALSE(empty.lastTime());
  EXPECT_TRUE(empty.isComplete());
  EXPECT_TRUE(empty.vehicles().empty());
  EXPECT_TRUE(empty.read().impacts().empty());

  AnyNumbers numbers;
  Recording impacts;
  impacts.addVehicle("car", saloon());
  for (int k = 0; k < 2500; ++k) impacts.addImpact(anyImpact(k, "car", numbers));
  writeRecording(impacts, file);
  expectSame(readRecording(file), impacts);
  EXPECT_FALSE(RecordingReader(file).firstTime());
}

TEST(RecordingFile, rejectsWhatARecordingRejects) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "run.jsonl";
  RecordingWriter writer(file);
  VehicleParameters massless = saloon();
  massless.mass = 0.0;
  const auto named = [](const std::string& words) {
    return AllOf(HasSubstr("run.jsonl"), HasSubstr(words));
  };
  EXPECT_THAT(messageOf([&] { writer.addVehicle("car", massless); }), named("mass"));
  EXPECT_THAT(messageOf([&] { writer.addVehicle("c\xFFr", saloon()); }), named("UTF-8"));
  writer.addVehicle("car", saloon());
  writer.addVehicle("van", saloon());
  EXPECT_THAT(messageOf([&] { writer.addVehicle("car", saloon()); }), named("is taken"));
  RecordedPose pose;
  pose.time = 1.0;
  writer.addPose(0, pose);
  EXPECT_THAT(messageOf([&] { writer.addVehicle("bus", saloon()); }), named("too late"));
  EXPECT_THAT(messageOf([&] { writer.addPose(2, pose); }), named("no vehicle 2"));
  pose.time = 0.5;
  EXPECT_THAT(messageOf([&] { writer.addPose(0, pose); }), named("goes back"));
  EXPECT_THAT(messageOf([&] { writer.addPose(1, pose); }), named("in order of time"));
  pose.time = notANumber;
  EXPECT_THAT(messageOf([&] { writer.addPose(0, pose); }), named("time is not finite"));
  ImpactEvent event;
  event.vehicle = "bus";
  event.normal = Eigen::Vector3d::UnitY();
  EXPECT_THAT(messageOf([&] { writer.addImpact(event); }), named("not one of its vehicles"));
  event.vehicle = "van";
  event.time = 2.0;
  writer.addImpact(event);
  event.time = 1.0;
  EXPECT_THAT(messageOf([&] { writer.addImpact(event); }), named("goes back"));
  event.normal *= 2.0;
  EXPECT_THAT(messageOf([&] { writer.addImpact(event); }), named("unit length"));
  writer.close();
  writer.close();
  EXPECT_THAT(messageOf([&] { writer.addPose(0, pose); }), named("closed already"));
  const Recording read = readRecording(file);
  EXPECT_EQ(read.vehicles()[0].poses.size(), 1U);
  EXPECT_EQ(read.impacts().size(), 1U);
}

TEST(RecordingFile, tellsWhatCannotBeWritten) {
  const TemporaryFolder folder;
  EXPECT_THAT(messageOf([&] { const RecordingWriter writer(folder.path() / "no" / "run.jsonl"); }),
              HasSubstr("no/run.jsonl"));
  RunDescription run;
  run.scene.up = "up";
  EXPECT_THAT(messageOf([&] { const RecordingWriter writer(folder.path() / "a", run); }),
              HasSubstr("SceneReference::up"));
  run.scene.up = "";
  run.scene.scale = 0.0;
  EXPECT_THAT(messageOf([&] { const RecordingWriter writer(folder.path() / "a", run); }),
              HasSubstr("SceneReference::scale"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "a"));

  const std::filesystem::path full = "/dev/full";
  if (!std::filesystem::exists(full)) GTEST_SKIP() << "there is no /dev/full";
  RecordingWriter writer(full);
  writer.addVehicle("car", saloon());
  EXPECT_THAT(messageOf([&] { writer.flush(); }),
              AllOf(HasSubstr("/dev/full"), HasSubstr("the disk must have room")));
  EXPECT_THAT(messageOf([&] { writer.addPose(0, {}); }), HasSubstr("failed before"));
}

TEST(RecordingFile, aFailedWritingLeavesTheOldFile) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "run.jsonl";
  writeText(file, "old");
  RunDescription run;
  run.scene.scale = -1.0;
  EXPECT_THROW(writeRecording(anyRun(), file, run), Error);
  EXPECT_EQ(readText(file), "old");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(RecordingFile, whatWasFlushedIsThere) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "run.jsonl";
  RecordingWriter writer(file);
  writer.addVehicle("car", saloon());
  RecordedPose pose;
  for (int k = 0; k < 10; ++k) {
    pose.time = k;
    writer.addPose(0, pose);
  }
  writer.flush();
  RecordingReader reader(file);
  EXPECT_FALSE(reader.isComplete());
  EXPECT_EQ(reader.lastTime(), 9.0);
  pose.time = 10.0;
  writer.addPose(0, pose);
  writer.close();
  EXPECT_EQ(reader.read().vehicles()[0].poses.size(), 10U);  // as it was when opened
  EXPECT_EQ(RecordingReader(file).lastTime(), 10.0);
}

// Whatever byte a file is cut at behind its first line, what stands in whole lines is read.
TEST(RecordingFile, aCutFileIsReadUpToTheCut) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "run.jsonl";
  {
    RecordingWriter writer(file);
    addLongRun(writer, 1, 1, 1);
  }
  const std::string whole = readText(file);
  const auto cut = folder.path() / "cut.jsonl";
  const std::size_t header = whole.find('\n') + 1;
  for (std::size_t size = header; size < whole.size() - 1; ++size) {
    writeText(cut, whole.substr(0, size));
    RecordingReader reader(cut);
    EXPECT_FALSE(reader.isComplete());
    const Recording read = reader.read();
    // A line counts once its last brace is there.
    std::size_t poses = 0;
    std::size_t impacts = 0;
    for (std::size_t at = 0; (at = whole.find("}\n", at)) < size; ++at) {
      const std::size_t begin = at == 0 ? 0 : whole.rfind('\n', at) + 1;
      poses += whole.compare(begin, 15, R"({"kind":"poses")") == 0 ? 1U : 0U;
      impacts += whole.compare(begin, 16, R"({"kind":"impact")") == 0 ? 1U : 0U;
    }
    ASSERT_EQ(read.vehicles()[0].poses.size(), poses) << size;
    ASSERT_EQ(read.impacts().size(), impacts) << size;
  }
  for (std::size_t size = 0; size < header - 1; ++size) {
    writeText(cut, whole.substr(0, size));
    EXPECT_THAT(messageOf([&] { const RecordingReader reader(cut); }), HasSubstr("line 1"));
  }
}

TEST(RecordingFile, tellsFileAndLineOfADefect) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "run.jsonl";
  {
    RecordingWriter writer(file);
    addLongRun(writer, 2, 3, 2);
  }
  std::vector<std::string> lines;
  std::istringstream text(readText(file));
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  const std::vector<std::pair<std::string, std::string>> defects = {
      {"nonsense", "no JSON"},
      {"", "no JSON"},
      {"[1, 2]", ""},
      {R"({"time":1})", "kind"},
      {R"({"kind":"pozes","time":1})", "pozes"},
      {R"({"kind":"header"})", "header"},
      {R"({"kind":"poses","time":"1","poses":[]})", "number"},
      {R"({"kind":"poses","time":0.5,"poses":[[0,1,2]]})", "3 numbers"},
      {R"({"kind":"poses","time":0.5,"poses":[[0,1,2,3,0,0,0,0,8,9,10,11]]})", "unit length"},
      {R"({"kind":"poses","time":0.5,"poses":[[2,1,2,3,1,0,0,0,8,9,10,11]]})", "no vehicle 2"},
      {R"({"kind":"poses","time":0.5,"poses":[[0,1,2,3,1,0,0,0,null,9,10,11]]})", "number"},
      {R"({"kind":"poses","time":-5,"poses":[[0,1,2,3,1,0,0,0,8,9,10,11]]})", "goes back"}};
  for (const auto& [line, words] : defects) {
    std::string damaged;
    for (std::size_t k = 0; k < lines.size(); ++k) {
      damaged += (k == 3 ? line : lines[k]) + '\n';  // the second line of poses
    }
    writeText(file, damaged);
    EXPECT_THAT(messageOf([&] { readRecording(file); }),
                AllOf(HasSubstr("run.jsonl, line 4: "), HasSubstr(words)));
  }
}

/// An impact as it was written before recordings had two parties, and a day later, when they named
/// the other vehicle.
std::string oldImpact(const std::string& other) {
  return R"({"kind":"impact","time":0.25,"phase":"impact","vehicle":"car","barrier":"rail",)"
         R"("material":"steel","law":"restitution","regime":"sliding","outcome":"not_asked",)" +
         other +
         R"("triangle":7,"contact":[1,2,0.5],"normal":[0,1,0],"arm":[2,-0.8],)"
         R"("velocityAfter":[20,1,0],"angles":{"contactVelocity":0.1,"centreVelocity":0.2,)"
         R"("heading":0.3},"approachSpeed":4,"restitution":0.1,"friction":0.3,)"
         R"("impulseNormal":5000,"impulseTangent":-1500,"impulseRatio":-0.3,)"
         R"("criticalImpulseRatio":0.6,"deltaV":4.2,"yawRateBefore":0,"yawRateAfter":1,)"
         R"("speedBefore":21,"speedAfter":20.02,"energyAsked":null,"energyRatio":0.9,)"
         R"("energyLost":1000,"duration":0})";
}

/// A recording with a car and these lines.
std::string textWith(const std::string& lines) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "run.jsonl";
  RecordingWriter writer(file);
  writer.addVehicle("car", saloon());
  writer.flush();
  return readText(file) + lines;
}

TEST(RecordingFile, impactsOfEarlierFilesAreRead) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "run.jsonl";
  writeText(file, textWith(oldImpact("") + '\n' + oldImpact(R"("otherVehicle":"van",)") + '\n'));
  const Recording run = readRecording(file);
  ASSERT_EQ(run.impacts().size(), 2U);
  const ImpactEvent wall = run.impacts()[0].event();
  EXPECT_EQ(wall.barrier, "rail");
  EXPECT_EQ(wall.impulseTangent, -1500.0);
  EXPECT_EQ(wall.velocityAfter.x(), 20.0);
  EXPECT_TRUE(wall.velocityBefore.array().isNaN().all()) << "not known";
  EXPECT_EQ(wall.otherVehicle, "");
  EXPECT_TRUE(wall.otherArm.isZero()) << "there is none";
  const ImpactEvent pair = run.impacts()[1].event();
  EXPECT_EQ(pair.otherVehicle, "van");
  EXPECT_TRUE(pair.otherArm.array().isNaN().all());
  EXPECT_TRUE(pair.otherVelocityBefore.array().isNaN().all());
  EXPECT_TRUE(pair.otherVelocityAfter.array().isNaN().all());
  EXPECT_TRUE(std::isnan(pair.otherYawRateBefore) && std::isnan(pair.otherYawRateAfter));
  // It is written on as it is known.
  writeRecording(run, file, {});
  expectSame(readRecording(file), run);
}

TEST(RecordingFile, tellsWhatIsWrongWithTheOtherVehicle) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "run.jsonl";
  const std::vector<std::pair<std::string, std::string>> defects = {
      {R"("otherVehicle":7,)", "otherVehicle is no name"},
      {R"("otherVehicle":"car",)", "itself"},
      {R"("otherVehicle":"van","otherArm":[1],)", "otherArm is no list of 2 numbers"},
      {R"("otherVehicle":"van","otherArm":{"x":1,"y":2},)", "otherArm is no list of 2 numbers"},
      {R"("otherVehicle":"van","otherVelocityBefore":[1,2],)",
       "otherVelocityBefore is no list of 3 numbers"},
      {R"("otherVehicle":"van","otherVelocityAfter":"fast",)",
       "otherVelocityAfter is no list of 3 numbers"},
      {R"("otherVehicle":"van","otherYawRateAfter":"fast",)", "number"},
      {R"("otherVehicle":"van","otherYawRateBefore":1e999,)", "overflow"},
      {R"("velocityBefore":[1,2,3,4],)", "velocityBefore is no list of 3 numbers"}};
  for (const auto& [part, words] : defects) {
    writeText(file, textWith(oldImpact(part) + '\n'));
    EXPECT_THAT(messageOf([&] { readRecording(file); }),
                AllOf(HasSubstr("run.jsonl, line 2: "), HasSubstr(words)));
  }
}

TEST(RecordingFile, tellsForeignFiles) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "run.jsonl";
  const std::vector<std::pair<std::string, std::string>> foreign = {
      {"", "empty"},
      {"time,x,y\n1,2,3\n", "no JSON"},
      {"{}\n", "no recording"},
      {"[]\n", "no recording"},
      {"{\"format\":\"something\"}\n", "no recording"},
      {"{\"format\":\"bumper-recording\",\"version\":2}\n", "version 2, known is 1"},
      {"{\"format\":\"bumper-recording\",\"version\":1}\n", "poseColumns"},
      {std::string(100, '\0'), "line 1"}};
  for (const auto& [text, words] : foreign) {
    writeText(file, text);
    EXPECT_THAT(messageOf([&] { const RecordingReader reader(file); }),
                AllOf(HasSubstr("run.jsonl, line 1: "), HasSubstr(words)));
  }
  EXPECT_THAT(messageOf([&] { const RecordingReader reader(folder.path() / "none"); }),
              AllOf(HasSubstr("none"), HasSubstr("no such file")));
  EXPECT_THAT(messageOf([&] { const RecordingReader reader(folder.path()); }),
              HasSubstr("no such file"));
}

TEST(RecordingFile, anEditedFileIsToldOrReadWithoutItsIndex) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "run.jsonl";
  {
    RecordingWriter writer(file);
    addLongRun(writer, 1, 20, 5);
  }
  // A line of poses is taken out: all offsets behind it are wrong.
  std::string text = readText(file);
  const std::size_t begin = text.find('\n', 2000) + 1;
  text.erase(begin, text.find('\n', begin) + 1 - begin);
  writeText(file, text);
  RecordingReader edited(file);
  EXPECT_THAT(messageOf([&] { edited.impacts(); }),
              AllOf(HasSubstr("run.jsonl"), HasSubstr("kind index and end")));
  text.erase(text.find(R"({"kind":"index")"));
  writeText(file, text);
  RecordingReader plain(file);
  EXPECT_EQ(plain.impacts().size(), 21U);
  EXPECT_EQ(plain.read().vehicles()[0].poses.size(), 100U);
}

// Any span of a file of some megabytes, beside what a search through all of it finds.
TEST(RecordingFile, readsAnySpan) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "run.jsonl";
  {
    RecordingWriter writer(file);
    addLongRun(writer, 3, 120, 50);
  }
  const Recording whole = readRecording(file);
  const auto& poses = whole.vehicles()[1].poses;
  ASSERT_EQ(poses.size(), 6001U);
  RecordingReader reader(file);
  EXPECT_EQ(reader.firstTime(), 0.0);
  EXPECT_EQ(reader.lastTime(), 120.0);
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> anyTime(-1.0, 121.0);
  for (int k = 0; k < 60; ++k) {
    RecordingSpan span{.from = anyTime(engine)};
    span.to = span.from + (k % 3 == 0 ? 0.0 : 0.1 * (anyTime(engine) + 1.0));
    if (k % 5 == 0) span.from = span.to = std::round(span.from);  // at a pose, at an impact
    const Recording part = reader.read(span);
    // The nearest before and after it belong to it.
    std::vector<RecordedPose> expected;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const bool isBefore = i + 1 < poses.size() && poses[i + 1].time < span.from;
      const bool isAfter = i > 0 && poses[i - 1].time > span.to;
      if (!isBefore && !isAfter) expected.push_back(poses[i]);
    }
    const auto& actual = part.vehicles()[1].poses;
    ASSERT_EQ(actual.size(), expected.size()) << span.from << " to " << span.to;
    for (std::size_t i = 0; i < actual.size(); ++i) expectSame(actual[i], expected[i]);
    std::size_t impacts = 0;
    for (const RecordedImpact& impact : whole.impacts()) {
      const double time = impact.event().time;
      if (time >= span.from && time <= span.to) ++impacts;
    }
    EXPECT_EQ(part.impacts().size(), impacts);
    const bool isInside = span.from >= 0.0 && span.from <= 120.0;
    EXPECT_EQ(poseAt(part.vehicles()[2], span.from).has_value(), isInside) << span.from;
  }
  EXPECT_THROW(reader.read({.from = 2.0, .to = 1.0}), Error);
  EXPECT_THROW(reader.read({.from = notANumber}), Error);
  EXPECT_THROW(reader.read({.poseSpacing = -1.0}), Error);
}

TEST(RecordingFile, keepsPosesApartAsAsked) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "run.jsonl";
  {
    RecordingWriter writer(file);
    addLongRun(writer, 2, 10, 200);
  }
  RecordingReader reader(file);
  const Recording part = reader.read({.from = 1.0, .to = 3.0, .poseSpacing = 0.1});
  const auto& poses = part.vehicles()[1].poses;
  EXPECT_NEAR(poses.front().time, 0.995, 1e-12);
  EXPECT_NEAR(poses.back().time, 3.005, 1e-12);
  for (std::size_t k = 1; k + 1 < poses.size(); ++k) {
    EXPECT_NEAR(poses[k].time - poses[k - 1].time, 0.1, 1e-9);
  }
  EXPECT_EQ(poses.size(), 22U);
  EXPECT_EQ(part.impacts().size(), 3U);  // all of them
  const Recording all = reader.read({.poseSpacing = 4.0});
  ASSERT_EQ(all.vehicles()[0].poses.size(), 4U);
  EXPECT_EQ(all.vehicles()[0].poses.back().time, 10.0);
}

TEST(RecordingFile, aVehicleThatIsSeldomThereIsNotLost) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "run.jsonl";
  const Recording run = anyRun();
  writeRecording(run, file);
  const Recording part = RecordingReader(file).read({.poseSpacing = 0.5});
  EXPECT_NEAR(static_cast<double>(part.vehicles()[0].poses.size()), 14.0, 1.0);
  EXPECT_NEAR(static_cast<double>(part.vehicles()[2].poses.size()), 9.0, 1.0);
}

TEST(RecordingFile, impactsOfAFileWithoutEnd) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "run.jsonl";
  AnyNumbers numbers;
  RecordingWriter writer(file);
  writer.addVehicle("car", saloon());
  for (int k = 0; k < 5000; ++k) writer.addImpact(anyImpact(k, "car", numbers));
  writer.flush();  // four lines of index, and some impacts behind the last
  RecordingReader reader(file);
  EXPECT_FALSE(reader.isComplete());
  EXPECT_EQ(reader.impacts().size(), 5000U);
  const auto some = reader.impacts({.from = 1000.5, .to = 4999.0});
  ASSERT_EQ(some.size(), 3999U);
  for (std::size_t k = 0; k < some.size(); ++k) {
    EXPECT_EQ(some[k].event().time, 1001.0 + static_cast<double>(k));
  }
}

// Four minutes of ten cars: neither writing nor opening takes memory in proportion to the file.
TEST(RecordingFile, memoryIsBounded) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "run.jsonl";
  const std::uint64_t before = peakMemory();
  {
    RecordingWriter writer(file);
    addLongRun(writer, 10, 240, 50);
  }
  RecordingReader reader(file);
  EXPECT_EQ(reader.impacts().size(), 241U);
  EXPECT_EQ(reader.read({.from = 123.0, .to = 123.1}).vehicles()[9].poses.size(), 8U);
  constexpr std::uint64_t bound = std::uint64_t{4} << 20U;
  EXPECT_GT(std::filesystem::file_size(file), 5 * bound);
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer's allocator keeps what was freed";
#endif
  EXPECT_LT(peakMemory() - before, bound);
}

TEST(SceneReference, tellsAnotherScene) {
  const Scene rail = testRail();
  const SceneReference reference = referenceTo(rail);
  EXPECT_TRUE(isSameScene(reference, rail));
  EXPECT_FALSE(isSameScene(reference, course()));
  Scene moved = rail;
  moved.vertices[5].z() = std::nextafter(moved.vertices[5].z(), 9.0);
  EXPECT_FALSE(isSameScene(reference, moved));
  Scene renamed = rail;
  renamed.name = "another";
  renamed.meshes[0].name = "another";
  EXPECT_TRUE(isSameScene(reference, renamed));
  EXPECT_TRUE(isSameScene({}, rail));
}

}  // namespace
}  // namespace bumper
