#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "bumper/response/restitution_law.h"
#include "csv_reader.h"
#include "published_pairs.h"

/// Published crash tests and their published planar-impact analyses (tests/data names the sources).
namespace bumper::tests {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

using Row = testing::CsvRecord;

std::vector<Row> table(const std::string& name) {
  return testing::readCsv(std::string(BUMPER_TEST_DATA) + "/" + name);
}

double number(const Row& row, const char* column) { return std::stod(row.at(column)); }

Vector2 polar(double distance, double angle) {
  return distance * Vector2(std::cos(angle), std::sin(angle));
}

// How to read two_vehicle_tests.csv: one plane frame; headings are counter-clockwise from its x
// axis; the contact's polar angle counts counter-clockwise from the vehicle's own heading; the
// normal axis stands at normal_angle_deg from the frame's x axis and points out of vehicle 2 into
// vehicle 1. The published critical impulse ratios (−0.51, −0.44) come out with tangent = z × n,
// and with no other reading.
TEST(PublishedRows, TwoVehicles) {
  const std::vector<Row> rows = table("two_vehicle_tests.csv");
  ASSERT_EQ(rows.size(), 4U);
  for (std::size_t i = 0; i < rows.size(); i += 2) {
    ContactBody bodies[2];
    for (std::size_t k = 0; k < 2; ++k) {
      const Row& row = rows[i + k];
      ASSERT_EQ(row.at("id"), rows[i].at("id"));
      const double heading = number(row, "heading_deg") * degree;
      bodies[k].inverseMass = 1.0 / number(row, "mass_kg");
      bodies[k].inverseYawInertia = 1.0 / number(row, "izz_kgm2");
      bodies[k].arm = polar(number(row, "contact_distance_m"),
                            heading + number(row, "contact_polar_angle_deg") * degree);
      bodies[k].velocity = polar(number(row, "speed_mps"), heading);
    }
    const Vector2 normal = polar(1.0, number(rows[i], "normal_angle_deg") * degree);
    const ContactSolution solution = solveRestitution(
        contactMobility(bodies[0], bodies[1], normal),
        contactVelocity(bodies[0], bodies[1], normal), number(rows[i], "restitution"),
        {.kind = Friction::Kind::fraction_of_critical,
         .value = number(rows[i], "impulse_ratio_fraction_of_critical")});
    EXPECT_NEAR(solution.criticalRatio, number(rows[i], "critical_impulse_ratio"), 0.005)
        << rows[i].at("id");
    EXPECT_FALSE(solution.restitutionLowered);
    for (std::size_t k = 0; k < 2; ++k) {
      const double sign = k == 0 ? 1.0 : -1.0;
      const PlanarImpulse impulse = onVehicle(
          {.normal = sign * solution.impulse.normal, .tangent = sign * solution.impulse.tangent},
          normal, bodies[k].arm);
      const Row& row = rows[i + k];
      const double deltaV = impulse.linear.norm() * bodies[k].inverseMass;
      const double yawRate = std::abs(impulse.angular * bodies[k].inverseYawInertia) / degree;
      EXPECT_NEAR(deltaV, number(row, "delta_v_mps"), 0.005 * number(row, "delta_v_mps"))
          << row.at("vehicle");
      EXPECT_NEAR(yawRate, number(row, "delta_yaw_rate_magnitude_deg_s"), 2.0) << row.at("vehicle");
    }
  }
}

// How to read small_overlap_tests.csv: the vehicle drives along its own x axis; the contact is
// front left, its polar angle counter-clockwise from x; the normal into the vehicle is (−cos
// normal_angle, −sin normal_angle): barrier and vehicle touch along a line that is almost the car's
// own side, and most of the impulse is tangential. delta_v_back is against the direction of travel,
// delta_v_away to the right, away from the barrier.
TEST(PublishedRows, SmallOverlap) {
  const std::vector<Row> rows = table("small_overlap_tests.csv");
  ASSERT_EQ(rows.size(), 6U);
  double squares = 0.0;
  for (const Row& row : rows) {
    ContactBody vehicle;
    vehicle.inverseMass = 1.0 / number(row, "mass_kg");
    vehicle.inverseYawInertia = 1.0 / number(row, "izz_kgm2");
    vehicle.arm =
        polar(number(row, "contact_distance_m"), number(row, "contact_polar_angle_deg") * degree);
    vehicle.velocity = {number(row, "impact_speed_mps"), 0.0};
    const Vector2 normal = -polar(1.0, number(row, "normal_angle_deg") * degree);
    const ContactSolution solution = solveRestitution(
        contactMobility(vehicle, ContactBody{}, normal),
        contactVelocity(vehicle, ContactBody{}, normal), number(row, "restitution_fitted"),
        {.kind = Friction::Kind::fraction_of_critical,
         .value = 0.01 * number(row, "impulse_ratio_percent_of_critical")});
    const PlanarImpulse impulse = onVehicle(solution.impulse, normal, vehicle.arm);
    const Vector2 deltaV = impulse.linear * vehicle.inverseMass;
    const Vector2 measured(-number(row, "delta_v_back_mps"), -number(row, "delta_v_away_mps"));
    EXPECT_NEAR(deltaV.norm(), measured.norm(), 0.03 * measured.norm()) << row.at("id");
    EXPECT_LT(deltaV.x(), 0.0) << row.at("id");
    EXPECT_LT(deltaV.y(), 0.0) << row.at("id");
    const double yawRate = impulse.angular * vehicle.inverseYawInertia / degree;
    const double error = yawRate / number(row, "delta_yaw_rate_deg_s") - 1.0;
    squares += error * error;
    EXPECT_FALSE(solution.restitutionLowered) << row.at("id");
  }
  EXPECT_LT(std::sqrt(squares / static_cast<double>(rows.size())), 0.08);
}

// The published ones of pair_tests.csv: ΔV within 0.5 %, yaw rate within 2 °/s at the published
// point. The outlines alone know neither crush nor stiffness: their ΔV is within 3 %, their yaw
// rate the measured one's within 50 °/s.
TEST(PublishedRows, PairsAtThePublishedPointAndFromOutlines) {
  const std::vector<PublishedPair> pairs = publishedPairs(BUMPER_TEST_DATA);
  ASSERT_EQ(pairs.size(), 2U);
  for (const PublishedPair& pair : pairs) {
    const PairChange newton = changeAtPublishedPoint(pair, RestitutionKind::newton);
    const PairChange outlines = changeFromOutlines(pair, 0.07);
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_NEAR(newton.deltaV[k], pair.deltaV[k], 0.005 * pair.deltaV[k]) << pair.id;
      EXPECT_NEAR(newton.yawRate[k], pair.yawRate[k], 2.0) << pair.id;
      EXPECT_NEAR(outlines.deltaV[k], pair.deltaV[k], 0.03 * pair.deltaV[k]) << pair.id;
      EXPECT_NEAR(outlines.yawRate[k], pair.yawRate[k], 50.0) << pair.id;
    }
  }
}

// What PC-Crash makes of a given case, with its point and plane and with those of the outlines.
TEST(PublishedRows, PcCrash) {
  const PublishedPair pair = pcCrashPair(BUMPER_TEST_DATA);
  for (const PairChange& change : {changeAtPublishedPoint(pair, RestitutionKind::kudlich_slibar),
                                   changeFromOutlines(pair, 0.055)}) {
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_NEAR(change.deltaV[k], pair.deltaV[k], 0.01 * pair.deltaV[k]);
      EXPECT_NEAR(change.yawRate[k], pair.yawRate[k], 2.0);
    }
    // Both planes are about a diagonal of the overlap.
    EXPECT_GT(change.normal.dot(pair.normal), std::cos(5.0 * degree));
  }
}

}  // namespace
}  // namespace bumper::tests
