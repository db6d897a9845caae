// Published impacts of two vehicles, and of vehicles with a barrier's edge taken for a very heavy
// one, beside what the library makes of them; as Markdown tables:
//
//     crash_pairs

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <string>

#include "csv_reader.h"
#include "published_pairs.h"

namespace {

using namespace bumper;
using namespace bumper::tests;

constexpr double degree = std::numbers::pi / 180.0;

void printPairs(const std::filesystem::path& data) {
  std::printf(
      "| test | vehicle | measured ΔV, m/s | yaw, °/s | published point, Newton: ΔV | yaw | "
      "Kudlich–Slibar: ΔV | yaw | outlines alone: ΔV | yaw |\n"
      "|---|---|---|---|---|---|---|---|---|---|\n");
  double squaresV = 0.0;
  double squaresYaw = 0.0;
  int rows = 0;
  for (const PublishedPair& pair : publishedPairs(data)) {
    const PairChange newton = changeAtPublishedPoint(pair, RestitutionKind::newton);
    const PairChange whole = changeAtPublishedPoint(pair, RestitutionKind::kudlich_slibar);
    const PairChange outlines = changeFromOutlines(pair, 0.07);
    for (int k = 0; k < 2; ++k) {
      const auto off = [&](const PairChange& c) {
        return 100.0 * (c.deltaV[k] / pair.deltaV[k] - 1.0);
      };
      std::printf(
          "| %s | %d | %.2f | %.0f | %+.2f %% | %.1f | %+.2f %% | %.1f | %+.1f %% | %.0f |\n",
          pair.id.c_str(), k + 1, pair.deltaV[k], pair.yawRate[k], off(newton), newton.yawRate[k],
          off(whole), whole.yawRate[k], off(outlines), outlines.yawRate[k]);
      squaresV += off(outlines) * off(outlines);
      squaresYaw += std::pow(outlines.yawRate[k] - pair.yawRate[k], 2);
      ++rows;
    }
  }
  std::printf("\noutlines alone, rms: ΔV %.1f %%, yaw %.0f °/s\n\n", std::sqrt(squaresV / rows),
              std::sqrt(squaresYaw / rows));
}

void printPcCrash(const std::filesystem::path& data) {
  const PublishedPair pair = pcCrashPair(data);
  std::printf("| %s | ΔV, m/s | yaw 1, °/s | yaw 2, °/s | normal, ° |\n|---|---|---|---|---|\n",
              pair.id.c_str());
  const auto row = [](const char* name, const PairChange& c) {
    std::printf("| %s | %.4f | %.2f | %.2f | %.1f |\n", name, c.deltaV[0], c.yawRate[0],
                c.yawRate[1], std::atan2(c.normal.y(), c.normal.x()) / degree);
  };
  row("PC-Crash", {.deltaV = {pair.deltaV[0], pair.deltaV[1]},
                   .yawRate = {pair.yawRate[0], pair.yawRate[1]},
                   .normal = pair.normal});
  row("its point and plane, Kudlich–Slibar",
      changeAtPublishedPoint(pair, RestitutionKind::kudlich_slibar));
  row("its point and plane, Newton", changeAtPublishedPoint(pair, RestitutionKind::newton));
  row("outlines alone, 55 ms, μ 0.6", changeFromOutlines(pair, 0.055));
  PublishedPair critical = pair;
  critical.friction = 0.0;
  row("outlines alone, 55 ms, critical", changeFromOutlines(critical, 0.055));
  std::printf("\n");
}

// The barrier stands still and is 10⁹ kg, a block of 3 × 3 m, of which the vehicle covers the
// fraction. The vehicle's outline is the Ford Fusion's for all.
void printSmallOverlap(const std::filesystem::path& data) {
  const auto fractions = testing::readCsv(data / "small_overlap_fraction.csv");
  const auto tests = testing::readCsv(data / "small_overlap_tests.csv");
  std::printf(
      "| test | overlap | plane published, ° | 60 ms | 70 ms: ΔV off by | yaw off by |\n"
      "|---|---|---|---|---|---|\n");
  double squares = 0.0;
  for (std::size_t i = 0; i < tests.size(); ++i) {
    const auto number = [&](const char* column) { return std::stod(tests[i].at(column)); };
    const double overlap = std::stod(fractions[i].at("overlap_fraction_of_width"));
    const double published = std::stod(fractions[i].at("plane_angle_published_deg"));
    Pair pair;
    pair.first.vehicle = {.mass = number("mass_kg"),
                          .yawInertia = number("izz_kgm2"),
                          .massCentreToFront = 2.3749,
                          .massCentreToRear = 2.6086,
                          .width = 1.8288,
                          .massCentreHeight = 0.6};
    pair.first.motion.velocity = {number("impact_speed_mps"), 0.0};
    pair.second.vehicle = {.mass = 1e9,
                           .yawInertia = 1e9,
                           .massCentreToFront = 1.5,
                           .massCentreToRear = 1.5,
                           .width = 3.0,
                           .massCentreHeight = 0.6};
    pair.second.motion.position = {5.0, (0.5 - overlap) * 1.8288 + 1.5};
    ResponseSettings settings;
    settings.restitution = AngleCurve::constant(number("restitution_fitted"));
    settings.frictionKind = Friction::Kind::fraction_of_critical;
    settings.friction = AngleCurve::constant(0.01 * number("impulse_ratio_percent_of_critical"));
    settings.penetrationTime = 0.06;
    const auto early = respondPair(pair.first, pair.second, settings, 1.0);
    settings.penetrationTime = 0.07;
    const auto hit = respondPair(pair.first, pair.second, settings, 1.0);
    if (!early || !hit) continue;
    const Vector2 n = -early->impact.normal;
    const double plane = std::atan2(n.y(), n.x()) / degree;
    const double deltaV = (hit->response.after.velocity - hit->response.before.velocity).norm();
    const double measured = std::hypot(number("delta_v_back_mps"), number("delta_v_away_mps"));
    const double yawRate = std::abs(hit->response.after.yawRate) / degree;
    squares += std::pow(plane - published, 2);
    std::printf("| %s | %.0f %% | %.1f | %.1f | %+.0f %% | %+.0f %% |\n", tests[i].at("id").c_str(),
                100.0 * overlap, published, plane, 100.0 * (deltaV / measured - 1.0),
                100.0 * (yawRate / number("delta_yaw_rate_deg_s") - 1.0));
  }
  std::printf("\nplane, rms: %.1f°\n", std::sqrt(squares / static_cast<double>(tests.size())));
}

}  // namespace

int main() {
  const std::filesystem::path data = BUMPER_TEST_DATA;
  printPairs(data);
  printPcCrash(data);
  printSmallOverlap(data);
}
