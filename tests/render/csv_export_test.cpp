#include "bumper/render/csv_export.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <locale>
#include <numbers>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "bumper/response/error.h"
#include "csv_reader.h"
#include "synthetic_run.h"
#include "temporary_folder.h"
#include "text_file.h"

namespace bumper {
namespace {

using testing::CsvRow;
using ::testing::HasSubstr;
using testing::parseCsv;
using testing::readText;
using testing::TemporaryFolder;

constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();

double number(const std::string& field) { return std::strtod(field.c_str(), nullptr); }

/// Every number of the event is its own and takes all digits.
ImpactEvent awkwardEvent() {
  ImpactEvent event;
  event.time = 0.1 + 0.2;
  event.vehicle = "car, \"red\"";
  event.barrier = "north\nrail";
  event.triangle = 1837;
  event.phase = EventPhase::contact_end;
  event.material = "W-beam; 12 ga";
  event.law = Law::energy;
  event.contact = {1.0 / 3.0, -2.0 / 7.0, 5.0};
  event.normal = Eigen::Vector3d(std::cos(1.0), std::sin(1.0), 0.1).normalized();
  event.arm = {2.0 / 3.0, -0.7};
  event.angles = {0.1, 0.2, 0.3};
  event.approachSpeed = 1e-300;
  event.restitution = 0.15;
  event.friction = 0.25;
  event.impulseNormal = 12345.678901234567;
  event.impulseTangent = -1e22 / 3.0;
  event.impulseRatio = std::nextafter(0.3, 1.0);
  event.criticalImpulseRatio = -std::numeric_limits<double>::denorm_min();
  event.deltaV = 10.0 / 3.0;
  event.yawRateBefore = -0.5;
  event.yawRateAfter = std::numeric_limits<double>::max();
  event.speedBefore = 26.8224;
  event.speedAfter = 25.1;
  event.energyAsked = 0.9;
  event.energyRatio = notANumber;
  event.velocityBefore = {1.0 / 11.0, -2.0 / 11.0, 4.0 / 11.0};
  event.velocityAfter = {1.0 / 9.0, -2.0 / 9.0, 4.0 / 9.0};
  event.otherVehicle = "lorry, \"blue\"";
  event.otherArm = {-2.0 / 13.0, 0.9};
  event.otherVelocityBefore = {1.0 / 17.0, -2.0 / 17.0, 4.0 / 17.0};
  event.otherVelocityAfter = {1.0 / 19.0, -2.0 / 19.0, 4.0 / 19.0};
  event.otherYawRateBefore = -1.0 / 23.0;
  event.otherYawRateAfter = notANumber;
  event.energyLost = 1e5 / 7.0;
  event.duration = 0.7 / 3.0;
  event.outcome = EnergyOutcome::limited_by_friction;
  event.regime = Regime::reverse_slip;
  return event;
}

TEST(CsvExport, eventsReadBackExactly) {
  const TemporaryFolder folder;
  Recording run;
  const ImpactEvent event = awkwardEvent();
  run.addVehicle(std::string(event.vehicle), testing::saloon());
  run.addImpact(event);
  writeCsv(run, folder.path());

  const auto rows = parseCsv(readText(folder.path() / "events.csv"));
  ASSERT_EQ(rows.size(), 2U);
  constexpr double degree = std::numbers::pi / 180.0;
  const std::vector<std::pair<std::string, std::variant<double, std::string>>> columns = {
      {"time_s", event.time},
      {"phase", "contact_end"},
      {"duration_s", event.duration},
      {"vehicle", std::string(event.vehicle)},
      {"barrier", std::string(event.barrier)},
      {"triangle", "1837"},
      {"material", std::string(event.material)},
      {"law", "energy"},
      {"contact_x_m", event.contact.x()},
      {"contact_y_m", event.contact.y()},
      {"contact_z_m", event.contact.z()},
      {"normal_x", event.normal.x()},
      {"normal_y", event.normal.y()},
      {"normal_z", event.normal.z()},
      {"arm_x_m", event.arm.x()},
      {"arm_y_m", event.arm.y()},
      {"angle_of_attack_deg", 0.1 / degree},
      {"angle_centre_velocity_deg", 0.2 / degree},
      {"angle_heading_deg", 0.3 / degree},
      {"approach_speed_mps", event.approachSpeed},
      {"restitution", event.restitution},
      {"friction", event.friction},
      {"impulse_normal_Ns", event.impulseNormal},
      {"impulse_tangent_Ns", event.impulseTangent},
      {"impulse_ratio", event.impulseRatio},
      {"critical_impulse_ratio", event.criticalImpulseRatio},
      {"delta_v_mps", event.deltaV},
      {"yaw_rate_before_rps", event.yawRateBefore},
      {"yaw_rate_after_rps", event.yawRateAfter},
      {"speed_before_mps", event.speedBefore},
      {"speed_after_mps", event.speedAfter},
      {"velocity_after_x_mps", event.velocityAfter.x()},
      {"velocity_after_y_mps", event.velocityAfter.y()},
      {"velocity_after_z_mps", event.velocityAfter.z()},
      {"energy_asked", event.energyAsked},
      {"energy_ratio", ""},  // NaN
      {"energy_lost_J", event.energyLost},
      {"outcome", "limited_by_friction"},
      {"regime", "reverse_slip"},
      {"velocity_before_x_mps", event.velocityBefore.x()},
      {"velocity_before_y_mps", event.velocityBefore.y()},
      {"velocity_before_z_mps", event.velocityBefore.z()},
      {"other_vehicle", std::string(event.otherVehicle)},
      {"other_arm_x_m", event.otherArm.x()},
      {"other_arm_y_m", event.otherArm.y()},
      {"other_velocity_before_x_mps", event.otherVelocityBefore.x()},
      {"other_velocity_before_y_mps", event.otherVelocityBefore.y()},
      {"other_velocity_before_z_mps", event.otherVelocityBefore.z()},
      {"other_velocity_after_x_mps", event.otherVelocityAfter.x()},
      {"other_velocity_after_y_mps", event.otherVelocityAfter.y()},
      {"other_velocity_after_z_mps", event.otherVelocityAfter.z()},
      {"other_yaw_rate_before_rps", event.otherYawRateBefore},
      {"other_yaw_rate_after_rps", ""}};  // NaN
  ASSERT_EQ(rows[0].size(), columns.size());
  ASSERT_EQ(rows[1].size(), columns.size());
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const auto& [name, value] = columns[k];
    EXPECT_EQ(rows[0][k], name);
    if (const double* expected = std::get_if<double>(&value)) {
      if (name.ends_with("_deg")) {
        EXPECT_DOUBLE_EQ(number(rows[1][k]), *expected) << name;
      } else {
        EXPECT_EQ(number(rows[1][k]), *expected) << name;
      }
    } else {
      EXPECT_EQ(rows[1][k], std::get<std::string>(value)) << name;
    }
  }
}

TEST(CsvExport, thereIsNoOtherVehicleInAWallsImpact) {
  const TemporaryFolder folder;
  Recording run;
  ImpactEvent event = awkwardEvent();
  event.otherVehicle = "";
  run.addVehicle(std::string(event.vehicle), testing::saloon());
  run.addImpact(event);
  writeCsv(run, folder.path());
  const auto rows = parseCsv(readText(folder.path() / "events.csv"));
  const auto first = std::find(rows[0].begin(), rows[0].end(), "other_vehicle") - rows[0].begin();
  ASSERT_EQ(rows[1].size(), static_cast<std::size_t>(first) + 11U);
  for (auto k = static_cast<std::size_t>(first); k < rows[1].size(); ++k) {
    EXPECT_EQ(rows[1][k], "") << rows[0][k];
  }
}

TEST(CsvExport, trajectoryReadsBackExactlyAndItsYawDoesNotJump) {
  const TemporaryFolder folder;
  Recording run;
  run.addVehicle("other", testing::saloon());
  run.addVehicle("spinning", testing::saloon());
  constexpr int count = 200;
  for (int k = 0; k < count; ++k) {
    RecordedPose pose;
    pose.time = k / 30.0;
    pose.position = {k / 7.0, -k / 11.0, k / 19.0};
    pose.orientation = Eigen::AngleAxisd(0.1 * k, Eigen::Vector3d::UnitZ());
    pose.velocity = {k / 13.0, 1.0 / (k + 1.0), k / 23.0};
    pose.yawRate = 3.0 + k / 17.0;
    run.addPose(1, pose);
  }
  writeCsv(run, folder.path(), 1);

  const auto rows = parseCsv(readText(folder.path() / "trajectory.csv"));
  ASSERT_EQ(rows.size(), count + 1U);
  EXPECT_EQ(rows[0], (CsvRow{"time_s", "x_m", "y_m", "z_m", "yaw_rad", "vx_mps", "vy_mps", "vz_mps",
                             "yaw_rate_rps"}));
  for (int k = 0; k < count; ++k) {
    const CsvRow& row = rows[static_cast<std::size_t>(k) + 1];
    ASSERT_EQ(row.size(), 9U);
    EXPECT_EQ(number(row[0]), k / 30.0);
    EXPECT_EQ(number(row[1]), k / 7.0);
    EXPECT_EQ(number(row[2]), -k / 11.0);
    EXPECT_EQ(number(row[3]), k / 19.0);
    EXPECT_NEAR(number(row[4]), 0.1 * k, 1e-9);  // three turns
    EXPECT_EQ(number(row[5]), k / 13.0);
    EXPECT_EQ(number(row[6]), 1.0 / (k + 1.0));
    EXPECT_EQ(number(row[7]), k / 23.0);
    EXPECT_EQ(number(row[8]), 3.0 + k / 17.0);
  }
}

TEST(CsvExport, numbersDoNotDependOnTheLocale) {
  struct Comma : std::numpunct<char> {
    [[nodiscard]] char do_decimal_point() const override { return ','; }
    [[nodiscard]] char do_thousands_sep() const override { return '.'; }
    [[nodiscard]] std::string do_grouping() const override { return "\3"; }
  };
  const TemporaryFolder folder;
  const Recording run = testing::testRailRun();
  writeCsv(run, folder.path() / "plain");
  const std::locale before = std::locale::global(std::locale(std::locale(), new Comma));
  writeCsv(run, folder.path() / "foreign");
  std::locale::global(before);
  for (const char* name : {"events.csv", "trajectory.csv"}) {
    EXPECT_EQ(readText(folder.path() / "plain" / name), readText(folder.path() / "foreign" / name));
  }
}

TEST(CsvExport, makesTheFolderAndReplacesFiles) {
  const TemporaryFolder folder;
  const auto deeper = folder.path() / "runs" / "first";
  writeCsv(testing::testRailRun(), deeper);
  writeCsv(Recording(), deeper);
  EXPECT_EQ(parseCsv(readText(deeper / "events.csv")).size(), 1U);
  EXPECT_EQ(parseCsv(readText(deeper / "trajectory.csv")).size(), 1U);
}

TEST(CsvExport, refusesAVehicleThatIsNotThere) {
  const TemporaryFolder folder;
  EXPECT_THROW(writeCsv(testing::testRailRun(), folder.path(), 1), Error);
  EXPECT_THROW(writeCsv(Recording(), folder.path(), 1), Error);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(CsvExport, namesAFolderThatCannotBe) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "a file";
  std::ofstream(file) << "here";
  for (const auto& place : {file, file / "inside"}) {
    try {
      writeCsv(testing::testRailRun(), place);
      ADD_FAILURE() << "no error";
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr(place.string()));
    }
  }
  EXPECT_EQ(readText(file), "here");
}

TEST(CsvExport, leavesNothingHalfWrittenIfAFileCannotBeReplaced) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "events.csv" / "in the way");
  EXPECT_THROW(writeCsv(testing::testRailRun(), folder.path()), Error);
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    EXPECT_EQ(entry.path().filename(), "events.csv");
}

TEST(CsvExport, keepsTheOldFilesIfThereIsNoRoom) {
  const TemporaryFolder folder;
  writeCsv(Recording(), folder.path());
  const std::string events = readText(folder.path() / "events.csv");
  const std::string trajectory = readText(folder.path() / "trajectory.csv");

  // A full disk, as far as a program can tell.
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  rlimit small = before;
  small.rlim_cur = 2000;
  setrlimit(RLIMIT_FSIZE, &small);
  std::string message;
  try {
    writeCsv(testing::testRailRun(), folder.path());
  } catch (const Error& error) {
    message = error.what();
  }
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);

  EXPECT_THAT(message, HasSubstr((folder.path() / "trajectory.csv").string()));
  EXPECT_EQ(readText(folder.path() / "events.csv"), events);
  EXPECT_EQ(readText(folder.path() / "trajectory.csv"), trajectory);
}

}  // namespace
}  // namespace bumper
