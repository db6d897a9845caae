#include "bumper/response/presets.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "bumper/response/collision_step.h"
#include "bumper/response/impact_event.h"
#include "csv_reader.h"

/// Each preset against the data that it names as its source.
namespace bumper::tests {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double headOn = 0.5 * std::numbers::pi;
constexpr double kilometresPerHour = 1.0 / 3.6;
constexpr double sixtyMph = 26.8224;  // m/s

/// A piece of wall across the vehicle's way, x forward, that the front touches at x = 0.
Segment wallAcross(double right, double left) {
  return {.start = {0.0, right}, .end = {0.0, left}, .normal = {-1.0, 0.0}, .id = 0};
}

/// The vehicle heads along x, its front a hair before x = 0.
PlanarMotion approach(const VehicleParameters& vehicle, double speed) {
  PlanarMotion motion;
  motion.position = {-vehicle.massCentreToFront - 1e-4, 0.0};
  motion.velocity = {speed, 0.0};
  return motion;
}

constexpr double step = 1e-3;  // s

TEST(Presets, AreValidAndFoundByName) {
  const std::span<const std::string_view> names = presetNames();
  EXPECT_EQ(std::set<std::string_view>(names.begin(), names.end()).size(), 4U);
  for (const std::string_view name : names) {
    const std::optional<ResponseSettings> preset = findPreset(name);
    ASSERT_TRUE(preset.has_value()) << name;
    EXPECT_NO_THROW(validate(*preset)) << name;
  }
  EXPECT_FALSE(findPreset("").has_value());
  EXPECT_FALSE(findPreset("Paper").has_value());
  // The name leads to its own settings: each head-on restitution is another.
  EXPECT_DOUBLE_EQ(findPreset("paper")->restitution(headOn), 0.05);
  EXPECT_DOUBLE_EQ(findPreset("macmillan")->restitution(headOn), 0.15);
  EXPECT_DOUBLE_EQ(findPreset("modern_car")->restitution(headOn), 0.17);
  EXPECT_DOUBLE_EQ(findPreset("reconstruction")->restitution(headOn), 0.0);
}

constexpr VehicleParameters paperCar{.mass = 1500.0,
                                     .yawInertia = 2600.0,
                                     .massCentreToFront = 2.1,
                                     .massCentreToRear = 2.5,
                                     .width = 1.8,
                                     .massCentreHeight = 0.55};

/// A flush head-on hit.
ImpactResponse headOnResponse(const VehicleParameters& car, double speed,
                              const ResponseSettings& settings) {
  const Segment wall = wallAcross(-10.0, 10.0);
  const Surface surface{.settings = &settings};
  CollisionStep collision;
  const StepOutcome outcome =
      collision.resolve(car, approach(car, speed), {{&wall, 1}, {&surface, 1}}, step);
  EXPECT_EQ(outcome.impacts.size(), 1U);
  return outcome.impacts.empty() ? ImpactResponse{} : outcome.impacts[0].response;
}

TEST(PaperPreset, HasTheEndsOfThePapersCurves) {
  const ResponseSettings paper = paperSettings();
  EXPECT_DOUBLE_EQ(paper.restitution(0.0), 0.3);
  EXPECT_NEAR(paper.restitution(headOn), 0.05, 1e-15);
  EXPECT_DOUBLE_EQ(paper.friction(0.0), 0.3);
  EXPECT_NEAR(paper.friction(headOn), 0.0, 1e-15);
  EXPECT_DOUBLE_EQ(paper.energyRemaining(0.0), 0.92);
  EXPECT_NEAR(paper.energyRemaining(headOn), 0.04, 1e-15);
  EXPECT_DOUBLE_EQ(paper.restitution(60.0 * degree), 0.175);  // cos 60° = ½
}

// "For collisions near ninety degrees angle of attack, the coefficient of 0.05 leads to a loss of
// almost all of the kinetic energy." The energy law is asked for 0.04 there.
TEST(PaperPreset, LosesAlmostAllEnergyHeadOn) {
  ResponseSettings paper = paperSettings();
  EXPECT_NEAR(headOnResponse(paperCar, sixtyMph, paper).energyRatio, 0.05 * 0.05, 1e-9);
  paper.law = Law::energy;
  EXPECT_NEAR(headOnResponse(paperCar, sixtyMph, paper).energyRatio, 0.04, 1e-9);
}

// "Macmillan suggests values in the range of 0.0 to 0.3" for e, "0.0-0.3 for typical collisions"
// for μ: the preset is the middle, and what comes out of an impact stays within.
TEST(MacmillanPreset, IsTheMiddleOfHisRanges) {
  const ResponseSettings macmillan = macmillanSettings();
  const std::pair<double, double> middle(0.5 * (0.0 + 0.3), 0.5 * (0.0 + 0.3));
  EXPECT_EQ(macmillan.restitution.range(), middle);
  EXPECT_EQ(macmillan.friction.range(), middle);
  EXPECT_EQ(macmillan.frictionKind, Friction::Kind::coulomb);

  PlanarMotion motion;
  motion.velocity = {sixtyMph, 0.0};
  for (int i = 1; i <= 90; ++i) {
    Impact impact;
    impact.normal = {-std::sin(i * degree), -std::cos(i * degree)};
    impact.arm = {2.1, 0.9};
    const ImpactResponse response = respond(impact, freeBody(paperCar, motion), macmillan);
    EXPECT_NEAR(response.contact.restitution, 0.15, 1e-12) << i;
    EXPECT_LE(std::abs(response.contact.impulseRatio), 0.15 + 1e-12) << i;
  }
}

// NHTSA test 10146; mass, axles, length and width from its header. Yaw inertia by the rule k_z =
// half the wheelbase, which does not matter in a flush hit.
constexpr VehicleParameters camry{.mass = 1719.0,
                                  .yawInertia = 1719.0 * 1.4125 * 1.4125,
                                  .massCentreToFront = 2.28,
                                  .massCentreToRear = 2.616,
                                  .width = 1.837,
                                  .massCentreHeight = 0.55};

TEST(ModernCarPreset, ReboundsHeadOnAsMeasured) {
  constexpr double speed = 57.0 * kilometresPerHour;
  for (const Law law : {Law::restitution, Law::energy}) {
    ResponseSettings settings = modernCarSettings();
    settings.law = law;
    const ImpactResponse response = headOnResponse(camry, speed, settings);
    EXPECT_NEAR(-response.after.velocity.x(), 0.17 * speed, 1e-9) << toString(law);
    EXPECT_NEAR(response.after.velocity.y(), 0.0, 1e-9) << toString(law);
    EXPECT_NEAR(response.after.yawRate, 0.0, 1e-9) << toString(law);
  }
  // What the preset is for: the paper's figure is less than a third of it.
  EXPECT_LT(-headOnResponse(camry, speed, paperSettings()).after.velocity.x(), 0.17 * speed / 3.0);
}

/// A row of small_overlap_tests.csv; tests/response/published_rows_test.cpp says how to read it.
struct SmallOverlapTest {
  std::string id;
  VehicleParameters vehicle;
  double speed = 0.0;
  Vector2 normal;
  double restitution = 0.0;
  double fraction = 0.0;
  double deltaV = 0.0;
  double yawRate = 0.0;
};

std::vector<SmallOverlapTest> smallOverlapTests() {
  std::vector<SmallOverlapTest> tests;
  for (const testing::CsvRecord& row :
       testing::readCsv(std::string(BUMPER_TEST_DATA) + "/small_overlap_tests.csv")) {
    const auto number = [&row](const char* column) { return std::stod(row.at(column)); };
    SmallOverlapTest test;
    test.id = row.at("id");
    // Dimensions of the 2008 Ford Fusion, which five of the six cars are.
    test.vehicle = {.mass = number("mass_kg"),
                    .yawInertia = number("izz_kgm2"),
                    .massCentreToFront = 2.3749,
                    .massCentreToRear = 2.6086,
                    .width = 1.8288,
                    .massCentreHeight = 0.55};
    test.speed = number("impact_speed_mps");
    const double angle = number("normal_angle_deg") * degree;
    test.normal = {-std::cos(angle), -std::sin(angle)};
    test.restitution = number("restitution_fitted");
    test.fraction = 0.01 * number("impulse_ratio_percent_of_critical");
    test.deltaV = std::hypot(number("delta_v_back_mps"), number("delta_v_away_mps"));
    test.yawRate = number("delta_yaw_rate_deg_s");
    tests.push_back(test);
  }
  return tests;
}

/// A quarter of the front meets a barrier's flat face.
struct QuarterOverlap {
  Impact impact;            ///< the first
  ImpactResponse response;  ///< to it alone
  PlanarMotion after;       ///< of the whole step
};

QuarterOverlap quarterOverlap(const SmallOverlapTest& test, const ResponseSettings& settings) {
  const Segment wall = wallAcross(0.25 * test.vehicle.width, 3.0);
  const Surface surface{.settings = &settings};
  CollisionStep collision;
  const StepOutcome outcome = collision.resolve(test.vehicle, approach(test.vehicle, test.speed),
                                                {{&wall, 1}, {&surface, 1}}, step);
  EXPECT_GE(outcome.impacts.size(), 1U) << test.id;
  if (outcome.impacts.empty()) return {};
  return {.impact = outcome.impacts[0].impact,
          .response = outcome.impacts[0].response,
          .after = outcome.after};
}

/// Relative errors.
struct Errors {
  double deltaV = 0.0;
  double yawRate = 0.0;
};

Errors errorsOf(const SmallOverlapTest& test, const PlanarMotion& after) {
  const Vector2 change = after.velocity - Vector2(test.speed, 0.0);
  return {.deltaV = change.norm() / test.deltaV - 1.0,
          .yawRate = after.yawRate / degree / test.yawRate - 1.0};
}

/// The contact point is the collision step's, from the outline; the normal, and with `fitted`
/// restitution and fraction too, are those of the published analysis.
Errors errorsOfAnalysis(const SmallOverlapTest& test, ResponseSettings settings, bool fitted) {
  Impact impact = quarterOverlap(test, settings).impact;
  impact.normal = test.normal;
  if (fitted) {
    settings.restitution = AngleCurve::constant(test.restitution);
    settings.friction = AngleCurve::constant(test.fraction);
  }
  PlanarMotion motion;
  motion.velocity = {test.speed, 0.0};
  return errorsOf(test, respond(impact, freeBody(test.vehicle, motion), settings).after);
}

double rootMeanSquare(const std::vector<double>& values) {
  double squares = 0.0;
  for (const double value : values) squares += value * value;
  return std::sqrt(squares / static_cast<double>(values.size()));
}

std::string percent(const Errors& errors) {
  std::ostringstream text;
  text << "velocity change " << std::lround(100.0 * errors.deltaV) << " %, yaw rate "
       << std::lround(100.0 * errors.yawRate) << " %";
  return text.str();
}

// The preset's penetration time is what it stands for first: with each test's own e and fraction,
// and the contact point from the outline, its six results come out.
TEST(ReconstructionPreset, PenetrationTimeFindsTheContactPoint) {
  const std::vector<SmallOverlapTest> tests = smallOverlapTests();
  ASSERT_EQ(tests.size(), 6U);
  ResponseSettings shallow = reconstructionSettings();
  shallow.penetrationTime = ResponseSettings{}.penetrationTime;
  std::vector<double> deltaV, yawRate, shallowYawRate;
  for (const SmallOverlapTest& test : tests) {
    const Errors errors = errorsOfAnalysis(test, reconstructionSettings(), true);
    RecordProperty(test.id, percent(errors));
    EXPECT_LT(std::abs(errors.deltaV), 0.07) << test.id;
    EXPECT_LT(std::abs(errors.yawRate), 0.25) << test.id;
    deltaV.push_back(errors.deltaV);
    yawRate.push_back(errors.yawRate);

    const Errors before = errorsOfAnalysis(test, shallow, true);
    RecordProperty(test.id + " at 2.5 ms", percent(before));
    shallowYawRate.push_back(before.yawRate);
  }
  EXPECT_LT(rootMeanSquare(deltaV), 0.04);
  EXPECT_LT(rootMeanSquare(yawRate), 0.16);
  EXPECT_GT(rootMeanSquare(shallowYawRate), 0.9);
}

// As it stands, on a plain wall. The contact point comes to rest, whichever way the normal points:
// the barrier's own face and the analysis's normal give the same.
TEST(ReconstructionPreset, AnswersWhereTheCarHooks) {
  for (const SmallOverlapTest& test : smallOverlapTests()) {
    const Errors errors =
        errorsOf(test, quarterOverlap(test, reconstructionSettings()).response.after);
    RecordProperty(test.id, percent(errors));
    if (test.fraction > 0.95) {
      EXPECT_LT(std::abs(errors.deltaV), 0.13) << test.id;
      EXPECT_LT(std::abs(errors.yawRate), 0.22) << test.id;
    } else {
      EXPECT_GT(errors.deltaV, 0.2) << test.id << " slips past: its fraction has to be fitted";
    }
    const Errors analysis = errorsOfAnalysis(test, reconstructionSettings(), false);
    EXPECT_NEAR(analysis.deltaV, errors.deltaV, 1e-9) << test.id;
    EXPECT_NEAR(analysis.yawRate, errors.yawRate, 1e-9) << test.id;
  }
}

// The whole step, with the second impulse on the front that is not crushed: the figures that the
// header gives, and nearer the tests than at the default penetration time.
TEST(ReconstructionPreset, WholeStepWhereTheCarHooks) {
  ResponseSettings shallow = reconstructionSettings();
  shallow.penetrationTime = ResponseSettings{}.penetrationTime;
  for (const SmallOverlapTest& test : smallOverlapTests()) {
    if (test.fraction < 0.95) continue;
    const Errors errors = errorsOf(test, quarterOverlap(test, reconstructionSettings()).after);
    const Errors before = errorsOf(test, quarterOverlap(test, shallow).after);
    RecordProperty(test.id, percent(errors));
    RecordProperty(test.id + " at 2.5 ms", percent(before));
    EXPECT_LT(std::abs(errors.deltaV), 0.25) << test.id;
    EXPECT_LT(std::abs(errors.yawRate), 0.42) << test.id;
    EXPECT_GT(std::abs(before.yawRate), std::abs(errors.yawRate) + 0.1) << test.id;
  }
}

/// Redirective crash tests of a metal barrier: NASEM 2024, doi 10.17226/27896 (NCHRP, TTI 612541).
/// Outlines and mass centres are the nominal ones of the MASH test vehicles 1100C and 2270P; yaw
/// inertia by the rule k_z = half the wheelbase.
struct RedirectiveTest {
  std::string id;
  VehicleParameters vehicle;
  double speed = 0.0;      ///< m/s
  double angle = 0.0;      ///< rad
  double exitSpeed = 0.0;  ///< m/s
};

const std::array<RedirectiveTest, 2> redirectiveTests = {
    RedirectiveTest{.id = "612541-01-2, 2015 Nissan Versa",
                    .vehicle = {.mass = 1100.0,
                                .yawInertia = 1100.0 * 1.245 * 1.245,
                                .massCentreToFront = 1.88,
                                .massCentreToRear = 2.41,
                                .width = 1.65,
                                .massCentreHeight = 0.55},
                    .speed = 28.476,
                    .angle = 25.5 * degree,
                    .exitSpeed = 23.827},
    RedirectiveTest{.id = "612541-01-1, 2015 Ram 1500",
                    .vehicle = {.mass = 2280.2,
                                .yawInertia = 2280.2 * 1.88 * 1.88,
                                .massCentreToFront = 2.59,
                                .massCentreToRear = 3.43,
                                .width = 1.98,
                                .massCentreHeight = 0.711},
                    .speed = 26.957,
                    .angle = 25.1 * degree,
                    .exitSpeed = 22.799}};

/// The mass centre's velocity half a second after the front corner touches a long wall along x, on
/// its left: front and rear have hit by then. No tyres.
Vector2 exitVelocity(const RedirectiveTest& test, const ResponseSettings& settings) {
  const Segment wall{.start = {-100.0, 0.0}, .end = {100.0, 0.0}, .normal = {0.0, -1.0}, .id = 0};
  PlanarMotion motion;
  motion.yaw = test.angle;
  motion.velocity = test.speed * Vector2(std::cos(test.angle), std::sin(test.angle));
  const Vector2 corner =
      rotated({test.vehicle.massCentreToFront, 0.5 * test.vehicle.width}, test.angle);
  motion.position = {0.0, -corner.y() - 1e-4};
  const Surface surface{.settings = &settings};
  CollisionStep collision;
  for (int i = 0; i < 500; ++i) {
    motion = collision.resolve(test.vehicle, motion, {{&wall, 1}, {&surface, 1}}, step).after;
  }
  return motion.velocity;
}

/// Relative error of the exit speed. The exit angle is recorded, not judged: the model lets the
/// vehicle out too flat (measured trajectories: 11° and 6°).
double exitSpeedError(const RedirectiveTest& test, const ResponseSettings& settings,
                      const std::string& name) {
  const Vector2 velocity = exitVelocity(test, settings);
  const double error = velocity.norm() / test.exitSpeed - 1.0;
  std::ostringstream text;
  text << "exit speed " << 100.0 * error << " %, trajectory "
       << std::atan2(-velocity.y(), velocity.x()) / degree << " deg";
  ::testing::Test::RecordProperty(name + ", " + test.id, text.str());
  return error;
}

TEST(PaperPreset, ExitSpeedOfRedirectiveTestsWithinTenPercent) {
  for (const RedirectiveTest& test : redirectiveTests) {
    ResponseSettings settings = paperSettings();
    EXPECT_LT(std::abs(exitSpeedError(test, settings, "restitution")), 0.1) << test.id;
    settings.law = Law::energy;
    EXPECT_LT(std::abs(exitSpeedError(test, settings, "energy")), 0.1) << test.id;
  }
}

TEST(MacmillanPreset, ExitSpeedOfRedirectiveTests) {
  for (const RedirectiveTest& test : redirectiveTests) {
    EXPECT_LT(std::abs(exitSpeedError(test, macmillanSettings(), "middle")), 0.015) << test.id;
    for (const double restitution : {0.0, 0.3}) {
      for (const double friction : {0.0, 0.3}) {
        ResponseSettings settings = macmillanSettings();
        settings.restitution = AngleCurve::constant(restitution);
        settings.friction = AngleCurve::constant(friction);
        const std::string name =
            "e " + std::to_string(restitution) + ", mu " + std::to_string(friction);
        EXPECT_LT(std::abs(exitSpeedError(test, settings, name)), 0.1) << test.id << ' ' << name;
      }
    }
  }
}

}  // namespace
}  // namespace bumper::tests
