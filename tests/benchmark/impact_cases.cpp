#include "impact_cases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>

#include "bumper/response/error.h"
#include "bumper/scenes/paper_scenes.h"
#include "csv_reader.h"

namespace bumper::benchmark {

namespace {

using examples::YawPlaneCarDesign;

constexpr double degree = std::numbers::pi / 180.0;
constexpr double wallLength = 60.0;
constexpr double wallHeight = 1.5;  // above every car's box

/// The same numbers with every compiler.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11U) * 0x1p-53;
  }
  std::size_t below(std::size_t count) { return engine_() % count; }
  bool chance(double share) { return between(0.0, 1.0) < share; }
  double sign() { return chance(0.5) ? 1.0 : -1.0; }

 private:
  std::mt19937_64 engine_;
};

std::array<Vector2, 4> cornersOf(const VehicleParameters& car) {
  const double half = 0.5 * car.width;
  return {Vector2(car.massCentreToFront, half), Vector2(-car.massCentreToRear, half),
          Vector2(-car.massCentreToRear, -half), Vector2(car.massCentreToFront, -half)};
}

/// Whether the outline is clear of the wall.
bool isClear(const VehicleParameters& car, const PlanarMotion& motion) {
  const StraightWall wall = theWall();
  const Vector2 a = rotated(wall.start - motion.position, -motion.yaw);
  const Vector2 b = rotated(wall.end - motion.position, -motion.yaw);
  double from = 0.0;
  double to = 1.0;
  const std::array<Vector2, 4> outward = {Vector2::UnitX(), Vector2(-Vector2::UnitX()),
                                          Vector2::UnitY(), Vector2(-Vector2::UnitY())};
  const std::array<double, 4> reach = {car.massCentreToFront, car.massCentreToRear, 0.5 * car.width,
                                       0.5 * car.width};
  for (std::size_t k = 0; k < 4; ++k) {
    const double atA = outward[k].dot(a) - reach[k];
    const double atB = outward[k].dot(b) - reach[k];
    if (atA > 0.0 && atB > 0.0) return true;
    if (atA > 0.0) from = std::max(from, atA / (atA - atB));
    if (atB > 0.0) to = std::min(to, atA / (atA - atB));
  }
  return from > to;
}

class CaseMaker {
 public:
  CaseMaker(const std::vector<YawPlaneCarDesign>& cars, std::uint64_t seed)
      : cars_(cars),
        random_(seed),
        wall_(theWall()),
        along_((wall_.end - wall_.start) / wallLength) {}

  CaseLaw plainLaw(int id) {
    return fixedLaw(id, random_.between(0.05, 0.4), random_.between(0.1, 0.6), 0.0);
  }

  CaseLaw anyLaw(int id) {
    constexpr std::array<double, 4> times = {0.0, 0.001, 0.0025, 0.01};
    return fixedLaw(id, random_.between(0.0, 0.8), random_.between(0.0, 1.2),
                    times[random_.below(times.size())]);
  }

  ImpactCase make(CaseKind kind, const CaseLaw& law) {
    while (true) {
      ImpactCase result = draw(kind);
      result.law = law;
      if (isClear(result.car.body, result.start) && meetsTheWall(result)) return result;
    }
  }

 private:
  /// Not so where a corner was to pass the wall's end.
  [[nodiscard]] bool meetsTheWall(const ImpactCase& made) const {
    constexpr double within = 0.2;  // s
    return !freeFlight(made.car.body, made.start, wall_, made.law.settings, within).impacts.empty();
  }

  ImpactCase draw(CaseKind kind) {
    ImpactCase result;
    result.kind = kind;
    result.car = cars_[random_.chance(0.5) ? 0 : random_.below(cars_.size())];
    if (kind != CaseKind::plain) result.steering = random_.between(-0.05, 0.05);
    switch (kind) {
      case CaseKind::plain:
        // Away from the ends for the whole of the run.
        driveAt(result, random_.between(0.3, 0.7) * wallLength, 0.0, 0.0);
        break;
      case CaseKind::driven:
        driveAt(result, random_.between(0.0, 1.0) * wallLength, 0.0, 0.0);
        break;
      case CaseKind::varied:
        driveAt(result, random_.between(0.0, 1.0) * wallLength, random_.between(-0.3, 0.3),
                random_.between(-1.5, 1.5));
        break;
      case CaseKind::flush:
        slideAt(result, 0.0);
        break;
      case CaseKind::near_flush:
        slideAt(result, random_.sign() * std::pow(10.0, random_.between(-12.0, -2.0)));
        break;
      case CaseKind::wall_end: {
        const double off = random_.sign() * std::pow(10.0, random_.between(-6.0, 0.0));
        driveAt(result, random_.chance(0.5) ? off : wallLength - off, 0.0, 0.0);
        break;
      }
      case CaseKind::bare_end:
        meetEnd(result);
        break;
    }
    return result;
  }

  static CaseLaw fixedLaw(int id, double restitution, double friction, double penetrationTime) {
    CaseLaw law{.id = id, .settings = {}, .restitution = restitution, .friction = friction};
    law.settings.restitution = AngleCurve::constant(restitution);
    law.settings.friction = AngleCurve::constant(friction);
    law.settings.penetrationTime = penetrationTime;
    return law;
  }

  double speed() { return random_.between(10.0, 35.0); }

  /// The car moves along its x axis but for `slip`, at 3° to 90° to the wall, from either side and
  /// either way, so that its first corner is `place` along the wall when it touches.
  void driveAt(ImpactCase& result, double place, double slip, double yawRate) {
    const double side = random_.sign();
    const double angle = random_.between(3.0 * degree, 90.0 * degree);
    const Vector2 velocity = speed() * (random_.sign() * std::cos(angle) * along_ -
                                        side * std::sin(angle) * turnedLeft(along_));
    approach(result, side, place, std::atan2(velocity.y(), velocity.x()) + slip, velocity, yawRate);
  }

  /// A side is parallel to the wall but for `off`, and the car slides into it at 3° to 90°.
  void slideAt(ImpactCase& result, double off) {
    const double side = random_.sign();
    const double angle = random_.between(3.0 * degree, 90.0 * degree);
    const Vector2 velocity = speed() * (random_.sign() * std::cos(angle) * along_ -
                                        side * std::sin(angle) * turnedLeft(along_));
    const double turn = 90.0 * degree * static_cast<double>(random_.below(4));
    const double place = random_.chance(0.8) ? random_.between(5.0, wallLength - 5.0)
                                             : random_.between(-1.0, wallLength + 1.0);
    approach(result, side, place, std::atan2(along_.y(), along_.x()) + turn + off, velocity, 0.0);
  }

  void approach(ImpactCase& result, double side, double place, double yaw, const Vector2& velocity,
                double yawRate) {
    const Vector2 normal = side * turnedLeft(along_);
    Vector2 lowest = rotated(cornersOf(result.car.body)[0], yaw);
    for (const Vector2& corner : cornersOf(result.car.body)) {
      const Vector2 arm = rotated(corner, yaw);
      if (normal.dot(arm) < normal.dot(lowest)) lowest = arm;
    }
    startAt(result, wall_.start + place * along_ - lowest, yaw, velocity, yawRate);
  }

  /// The wall's end meets a point of a side, away from the corners.
  void meetEnd(ImpactCase& result) {
    const bool first = random_.chance(0.5);
    const Vector2 into = first ? along_ : Vector2(-along_);  // along the wall, from its end
    const std::array<Vector2, 4> corners = cornersOf(result.car.body);
    const std::size_t side = random_.below(4);
    const Vector2 point =
        corners[side] + random_.between(0.02, 0.98) * (corners[(side + 1) % 4] - corners[side]);
    const double outward = 90.0 * degree * (1.0 + static_cast<double>(side));
    const double facing =
        std::atan2(into.y(), into.x()) + random_.between(-85.0 * degree, 85.0 * degree);
    const double way = facing + random_.between(-87.0 * degree, 87.0 * degree);
    const double yaw = facing - outward;
    startAt(result, (first ? wall_.start : wall_.end) - rotated(point, yaw), yaw,
            rotated(Vector2(speed(), 0.0), way),
            random_.chance(0.3) ? random_.between(-1.5, 1.5) : 0.0);
  }

  /// At `position` and `yaw` after a random time.
  void startAt(ImpactCase& result, const Vector2& position, double yaw, const Vector2& velocity,
               double yawRate) {
    const double time = random_.between(0.0, 0.1);
    result.start = {.position = position - velocity * time,
                    .yaw = yaw - yawRate * time,
                    .velocity = velocity,
                    .yawRate = yawRate};
  }

  const std::vector<YawPlaneCarDesign>& cars_;
  Random random_;
  StraightWall wall_;
  Vector2 along_;
};

double numberIn(const testing::CsvRecord& row, const char* column) {
  return std::stod(row.at(column));
}

/// The same, or `otherwise` if the field is empty.
double numberIn(const testing::CsvRecord& row, const char* column, double otherwise) {
  return row.at(column).empty() ? otherwise : numberIn(row, column);
}

}  // namespace

StraightWall theWall() {
  const Vector2 start(3.1, -2.3);
  return {.start = start, .end = start + rotated(Vector2(wallLength, 0.0), 0.37)};
}

Scene wallScene(int triangles) {
  const StraightWall wall = theWall();
  if (triangles == 2) return straightWall(wall.start, wall.end, wallHeight);
  if (triangles == 1224) return straightWall(wall.start, wall.end, wallHeight, 153, 4);
  throw Error("a wall of " + std::to_string(triangles) + " triangles: 2 or 1224 are allowed");
}

const char* nameOf(CaseKind kind) {
  constexpr std::array<const char*, caseKinds> names = {
      "plain", "driven", "varied", "flush", "near_flush", "wall_end", "bare_end"};
  return names[static_cast<std::size_t>(kind)];
}

std::vector<YawPlaneCarDesign> readCars(const std::filesystem::path& csv) {
  std::vector<YawPlaneCarDesign> cars(1);
  cars[0].body.yawInertia = 2500.0;
  for (const testing::CsvRecord& row : testing::readCsv(csv)) {
    if (row.at("mass_kg").empty() || row.at("izz_kgm2").empty()) continue;
    try {
      YawPlaneCarDesign car;
      car.massCentreToFrontAxle = numberIn(row, "cg_to_front_axle_m");
      car.massCentreToRearAxle = numberIn(row, "cg_to_rear_axle_m");
      // Unknown overhangs: what the length leaves, shared equally.
      const double overhang =
          0.5 * (numberIn(row, "length_m") - car.massCentreToFrontAxle - car.massCentreToRearAxle);
      const double front = car.massCentreToFrontAxle + overhang;
      const double rear = car.massCentreToRearAxle + overhang;
      car.body = {.mass = numberIn(row, "mass_kg"),
                  .yawInertia = numberIn(row, "izz_kgm2"),
                  .massCentreToFront = numberIn(row, "cg_to_front_bumper_m", front),
                  .massCentreToRear = numberIn(row, "cg_to_rear_bumper_m", rear),
                  .width = numberIn(row, "width_m"),
                  .massCentreHeight = numberIn(row, "cg_height_m", 0.55)};
      cars.push_back(car);
    } catch (const std::logic_error&) {
      throw Error(csv.string() + ": no numbers for \"" + row.at("vehicle") + '"');
    }
  }
  return cars;
}

std::vector<ImpactCase> makeCases(const std::vector<YawPlaneCarDesign>& cars, std::size_t plain,
                                  std::size_t count, std::uint64_t seed) {
  // In what shares the other kinds come.
  constexpr std::array<CaseKind, 10> others = {
      CaseKind::driven,   CaseKind::driven,  CaseKind::driven,     CaseKind::varied,
      CaseKind::varied,   CaseKind::flush,   CaseKind::near_flush, CaseKind::near_flush,
      CaseKind::wall_end, CaseKind::bare_end};
  constexpr std::size_t casesOfALaw = 10;
  constexpr std::size_t otherLaws = 40;
  CaseMaker maker(cars, seed);
  std::vector<ImpactCase> cases;
  cases.reserve(count);
  CaseLaw law;
  int id = 0;
  for (std::size_t k = 0; k < plain; ++k) {
    if (k % casesOfALaw == 0) law = maker.plainLaw(++id);
    cases.push_back(maker.make(CaseKind::plain, law));
  }
  const std::size_t ofALaw = (count - plain + otherLaws - 1) / otherLaws;
  for (std::size_t k = 0; k + plain < count; ++k) {
    if (k % ofALaw == 0) {
      ++id;
      law = k / ofALaw % 2 == 0 ? CaseLaw{.id = id} : maker.anyLaw(id);
    }
    cases.push_back(maker.make(others[k % others.size()], law));
  }
  return cases;
}

}  // namespace bumper::benchmark
