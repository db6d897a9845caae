#include "published_pairs.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "bumper/response/restitution_law.h"
#include "csv_reader.h"

namespace bumper::tests {
namespace {

constexpr double radian = 180.0 / std::numbers::pi;  // °

double field(const testing::CsvRecord& row, const std::string& column) {
  return std::stod(row.at(column));
}

Friction frictionOf(const PublishedPair& pair) {
  return pair.friction > 0.0 ? Friction{.kind = Friction::Kind::coulomb, .value = pair.friction}
                             : Friction{.kind = Friction::Kind::fraction_of_critical, .value = 1.0};
}

}  // namespace

std::vector<PublishedPair> publishedPairs(const std::filesystem::path& data) {
  const std::vector<testing::CsvRecord> rows = testing::readCsv(data / "pair_tests.csv");
  std::vector<PublishedPair> pairs;
  for (std::size_t i = 0; i + 1 < rows.size(); i += 2) {
    PublishedPair pair;
    pair.id = rows[i].at("id");
    pair.normal = direction(field(rows[i], "normal_angle_deg") / radian);
    pair.restitution = field(rows[i], "restitution");
    for (std::size_t k = 0; k < 2; ++k) {
      const testing::CsvRecord& row = rows[i + k];
      if (row.at("id") != pair.id) throw std::runtime_error("pair_tests.csv: a row alone");
      PairState& state = k == 0 ? pair.atContact.first : pair.atContact.second;
      state.vehicle = {.mass = field(row, "mass_kg"),
                       .yawInertia = field(row, "izz_kgm2"),
                       .massCentreToFront = field(row, "front_m"),
                       .massCentreToRear = field(row, "rear_m"),
                       .width = field(row, "width_m"),
                       .massCentreHeight = 0.6};
      const double heading = field(row, "heading_deg") / radian;
      state.motion.yaw = heading;
      state.motion.velocity = field(row, "speed_mps") * direction(heading);
      state.motion.position = -field(row, "contact_distance_m") *
                              direction(heading + field(row, "contact_polar_deg") / radian);
      pair.deltaV[k] = field(row, "delta_v_meas_mps");
      pair.yawRate[k] = field(row, "delta_yaw_meas_dps_magnitude");
    }
    pairs.push_back(pair);
  }
  return pairs;
}

PublishedPair pcCrashPair(const std::filesystem::path& data) {
  const testing::CsvRecord row = testing::readCsv(data / "pccrash_t.csv").at(0);
  PublishedPair pair;
  pair.id = row.at("id");
  const VehicleParameters vehicle{.mass = field(row, "mass_kg_each"),
                                  .yawInertia = field(row, "izz_kgm2_each"),
                                  .massCentreToFront = field(row, "front_m"),
                                  .massCentreToRear = field(row, "rear_m"),
                                  .width = field(row, "width_m"),
                                  .massCentreHeight = 0.6};
  for (const std::string number : {"1", "2"}) {
    PairState& state = number == "1" ? pair.atContact.first : pair.atContact.second;
    const std::size_t k = number == "1" ? 0 : 1;
    state.vehicle = vehicle;
    state.motion.yaw = field(row, "heading" + number + "_deg") / radian;
    state.motion.velocity = field(row, "v" + number + "_mps") * direction(state.motion.yaw);
    state.motion.position = {field(row, "x" + number + "_m"), field(row, "y" + number + "_m")};
    pair.deltaV[k] = field(row, "dv_mps_each");
    pair.yawRate[k] = field(row, "yaw" + number + "_dps");
  }
  pair.point = {field(row, "poi_x_m"), field(row, "poi_y_m")};
  pair.normal = direction(field(row, "contact_plane_deg") / radian + 0.5 * std::numbers::pi);
  pair.restitution = field(row, "restitution");
  pair.friction = field(row, "friction");
  return pair;
}

PairChange changeAtPublishedPoint(const PublishedPair& pair, RestitutionKind kind) {
  const PairState* states[] = {&pair.atContact.first, &pair.atContact.second};
  ContactBody bodies[2];
  for (std::size_t k = 0; k < 2; ++k) {
    const PlanarMotion& motion = states[k]->motion;
    bodies[k] = contactBody(freeBody(states[k]->vehicle, motion), pair.point - motion.position);
  }
  const ContactMobility mobility = contactMobility(bodies[0], bodies[1], pair.normal);
  const ContactVelocity before = contactVelocity(bodies[0], bodies[1], pair.normal);
  const auto solve = kind == RestitutionKind::newton ? solveRestitution : solveKudlichSlibar;
  const ContactImpulse impulse =
      solve(mobility, before, pair.restitution, frictionOf(pair)).impulse;
  PairChange change{.normal = pair.normal};
  for (std::size_t k = 0; k < 2; ++k) {
    const PlanarImpulse whole = onVehicle(impulse, pair.normal, bodies[k].arm);
    change.deltaV[k] = whole.linear.norm() * bodies[k].inverseMass;
    change.yawRate[k] = std::abs(whole.angular) * bodies[k].inverseYawInertia * radian;
  }
  return change;
}

PairChange changeFromOutlines(const PublishedPair& pair, double penetrationTime) {
  constexpr double back = 0.5;  // s
  ResponseSettings settings;
  settings.restitutionKind = RestitutionKind::kudlich_slibar;
  settings.restitution = AngleCurve::constant(pair.restitution);
  settings.friction = AngleCurve::constant(frictionOf(pair).value);
  settings.frictionKind = frictionOf(pair).kind;
  settings.penetrationTime = penetrationTime;
  PairState first = pair.atContact.first;
  PairState second = pair.atContact.second;
  for (PairState* state : {&first, &second}) state->motion = advanced(state->motion, -back);
  const std::optional<PairHit> hit = respondPair(first, second, settings, 2.0 * back);
  if (!hit) throw std::runtime_error(pair.id + ": no hit");
  const ImpactResponse& r = hit->response;
  PairChange change{.normal = hit->impact.normal};
  change.deltaV[0] = (r.after.velocity - r.before.velocity).norm();
  change.deltaV[1] = (r.otherAfter.velocity - r.otherBefore.velocity).norm();
  change.yawRate[0] = std::abs(r.after.yawRate - r.before.yawRate) * radian;
  change.yawRate[1] = std::abs(r.otherAfter.yawRate - r.otherBefore.yawRate) * radian;
  return change;
}

}  // namespace bumper::tests
