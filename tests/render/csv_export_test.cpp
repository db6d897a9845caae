#include "bumper/render/csv_export.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <locale>
#include <numbers>
#include <string>

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
  event.material = "W-beam; 12 ga";
  event.law = Law::energy;
  event.contact = {1.0 / 3.0, -2.0 / 7.0, 5.0};
  event.normal = {std::cos(1.0), std::sin(1.0), 0.0};
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
  const CsvRow header = {"time_s",
                         "phase",
                         "vehicle",
                         "barrier",
                         "triangle",
                         "material",
                         "law",
                         "contact_x_m",
                         "contact_y_m",
                         "normal_x",
                         "normal_y",
                         "arm_x_m",
                         "arm_y_m",
                         "angle_of_attack_deg",
                         "angle_centre_velocity_deg",
                         "angle_heading_deg",
                         "approach_speed_mps",
                         "restitution",
                         "friction",
                         "impulse_normal_Ns",
                         "impulse_tangent_Ns",
                         "impulse_ratio",
                         "critical_impulse_ratio",
                         "delta_v_mps",
                         "yaw_rate_before_rps",
                         "yaw_rate_after_rps",
                         "speed_before_mps",
                         "speed_after_mps",
                         "energy_asked",
                         "energy_ratio",
                         "regime"};
  EXPECT_EQ(rows[0], header);
  const CsvRow& row = rows[1];
  ASSERT_EQ(row.size(), header.size());
  EXPECT_EQ(number(row[0]), event.time);
  EXPECT_EQ(row[1], "impact");
  EXPECT_EQ(row[2], event.vehicle);
  EXPECT_EQ(row[3], event.barrier);
  EXPECT_EQ(row[4], "1837");
  EXPECT_EQ(row[5], event.material);
  EXPECT_EQ(row[6], "energy");
  EXPECT_EQ(number(row[7]), event.contact.x());
  EXPECT_EQ(number(row[8]), event.contact.y());
  EXPECT_EQ(number(row[9]), event.normal.x());
  EXPECT_EQ(number(row[10]), event.normal.y());
  EXPECT_EQ(number(row[11]), event.arm.x());
  EXPECT_EQ(number(row[12]), event.arm.y());
  EXPECT_DOUBLE_EQ(number(row[13]), 0.1 * 180.0 / std::numbers::pi);
  EXPECT_DOUBLE_EQ(number(row[14]), 0.2 * 180.0 / std::numbers::pi);
  EXPECT_DOUBLE_EQ(number(row[15]), 0.3 * 180.0 / std::numbers::pi);
  EXPECT_EQ(number(row[16]), event.approachSpeed);
  EXPECT_EQ(number(row[17]), event.restitution);
  EXPECT_EQ(number(row[18]), event.friction);
  EXPECT_EQ(number(row[19]), event.impulseNormal);
  EXPECT_EQ(number(row[20]), event.impulseTangent);
  EXPECT_EQ(number(row[21]), event.impulseRatio);
  EXPECT_EQ(number(row[22]), event.criticalImpulseRatio);
  EXPECT_EQ(number(row[23]), event.deltaV);
  EXPECT_EQ(number(row[24]), event.yawRateBefore);
  EXPECT_EQ(number(row[25]), event.yawRateAfter);
  EXPECT_EQ(number(row[26]), event.speedBefore);
  EXPECT_EQ(number(row[27]), event.speedAfter);
  EXPECT_EQ(number(row[28]), event.energyAsked);
  EXPECT_EQ(row[29], "");
  EXPECT_EQ(row[30], "reverse_slip");
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
    pose.position = {k / 7.0, -k / 11.0, 0.5};
    pose.orientation = Eigen::AngleAxisd(0.1 * k, Eigen::Vector3d::UnitZ());
    pose.velocity = {k / 13.0, 1.0 / (k + 1.0), 0.0};
    pose.yawRate = 3.0 + k / 17.0;
    run.addPose(1, pose);
  }
  writeCsv(run, folder.path(), 1);

  const auto rows = parseCsv(readText(folder.path() / "trajectory.csv"));
  ASSERT_EQ(rows.size(), count + 1U);
  EXPECT_EQ(rows[0],
            (CsvRow{"time_s", "x_m", "y_m", "yaw_rad", "vx_mps", "vy_mps", "yaw_rate_rps"}));
  for (int k = 0; k < count; ++k) {
    const CsvRow& row = rows[static_cast<std::size_t>(k) + 1];
    ASSERT_EQ(row.size(), 7U);
    EXPECT_EQ(number(row[0]), k / 30.0);
    EXPECT_EQ(number(row[1]), k / 7.0);
    EXPECT_EQ(number(row[2]), -k / 11.0);
    EXPECT_NEAR(number(row[3]), 0.1 * k, 1e-9);  // three turns
    EXPECT_EQ(number(row[4]), k / 13.0);
    EXPECT_EQ(number(row[5]), 1.0 / (k + 1.0));
    EXPECT_EQ(number(row[6]), 3.0 + k / 17.0);
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
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "events.csv.part"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "trajectory.csv.part"));
}

}  // namespace
}  // namespace bumper
