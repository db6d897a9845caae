#include "places.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>

#include "bumper/engine_adapter/vehicle.h"
#include "bumper/response/outline.h"

namespace bumper::doctor {

namespace {

class Chooser {
 public:
  Chooser(const Subject& subject, const WallSections& sections, const Ground& ground)
      : subject_(subject),
        sections_(sections),
        ground_(ground),
        band_(defaultBand(subject.vehicle)) {}

  /// The place at the point of a wall that is nearest to `target`, on either side.
  [[nodiscard]] std::optional<Place> at(std::size_t wall, const Eigen::Vector3d& target,
                                        bool isOtherSide) const {
    const Eigen::Vector3d normal = sections_.walls()[wall].normal;
    const Eigen::Vector2d flat = normal.head<2>().normalized() * (isOtherSide ? -1.0 : 1.0);
    std::optional<Place> place = onGround(wall, target, flat);
    if (!place || !hasRoom(*place)) return std::nullopt;
    return place;
  }

 private:
  /// Heights of the ground for which the wall stands in the band, the highest one.
  [[nodiscard]] std::optional<double> groundBeside(const Wall& wall,
                                                   const Eigen::Vector2d& point) const {
    const auto [low, high] =
        std::minmax({wall.corners[0].z(), wall.corners[1].z(), wall.corners[2].z()});
    std::vector<double> heights = ground_.heightsAt(point, low - 2.0 * band_.top, high);
    std::erase_if(heights, [&, low = low, high = high](double height) {
      return high < height + band_.bottom || low > height + band_.top;
    });
    if (!heights.empty()) return heights.back();
    const bool isGroundNear = !ground_.heightsAt(point, low - 20.0, high + 20.0).empty();
    if (isGroundNear) return std::nullopt;
    return std::max(low - band_.bottom, wall.foot);
  }

  [[nodiscard]] std::optional<Place> onGround(std::size_t index, const Eigen::Vector3d& target,
                                              const Eigen::Vector2d& out) const {
    const Wall& wall = sections_.walls()[index];
    const double aside = 0.5 * subject_.vehicle.width;
    const Eigen::Vector2d beside = target.head<2>() + aside * out;
    const std::optional<double> height = groundBeside(wall, beside);
    if (!height) return std::nullopt;

    // The slope along the wall.
    const Eigen::Vector2d along(out.y(), -out.x());
    const double apart = 0.25 * subject_.length();
    const double steepest = 0.3 * 2.0 * apart;
    std::array<double, 2> ends{*height, *height};
    for (std::size_t k = 0; k < 2; ++k) {
      const Eigen::Vector2d there = beside + (k == 0 ? -apart : apart) * along;
      const auto heights =
          ground_.heightsAt(there, *height - 0.5 * steepest, *height + 0.5 * steepest);
      if (!heights.empty()) ends.at(k) = heights.back();
    }
    Place place{.wall = index};
    DrivingPlane& plane = place.plane;
    const Eigen::Vector3d forward(along.x(), along.y(), (ends[1] - ends[0]) / (2.0 * apart));
    plane.axes.col(0) = forward.normalized();
    plane.axes.col(1) << out, 0.0;
    plane.axes.col(2) = plane.axes.col(0).cross(plane.axes.col(1));
    plane.origin << target.head<2>(), *height + subject_.vehicle.massCentreHeight;

    // Onto the wall, at the height of the band in which it stands.
    WallLine line;
    const std::array<double, 9> heights = this->heights();
    std::vector<double> inBand;
    std::ranges::copy_if(heights, std::back_inserter(inBand), [&](double offset) {
      const double above = offset + subject_.vehicle.massCentreHeight;
      return above >= band_.bottom && above <= band_.top;
    });
    const bool isCut = std::ranges::any_of(
        inBand, [&](double offset) { return cutWall(wall, plane, offset, line); });
    if (!isCut) return std::nullopt;
    const Vector2 direction = (line.to - line.from).normalized();
    const double share = std::clamp(-line.from.dot(direction), 0.0, line.length());
    plane.origin = plane.world(line.from + share * direction);
    const double reach = 5.0 * subject_.length();
    const double radius = reach + subject_.length();
    place.lines = sections_.around(plane, radius, heights);
    place.path = pathAlong(sections_.around(plane, radius, inBand), place.lines,
                           {.reach = reach,
                            .feature = subject_.smallestFeature(),
                            .gap = 15.0 * subject_.smallestFeature(),
                            .width = subject_.roomBeside()});
    return place;
  }

  /// The mass centre's first, then others over all that the box takes up, or the band if that is
  /// more: what is in the way at one of them is in the way.
  [[nodiscard]] std::array<double, 9> heights() const {
    const double centre = subject_.vehicle.massCentreHeight;
    const double reach = 0.5 * boxHeight(subject_.vehicle);
    const double low = std::min(band_.bottom - centre, -reach);
    const double high = std::max(band_.top - centre, reach);
    std::array<double, 9> all{};
    for (std::size_t k = 1; k < all.size(); ++k) {
      const double share = (static_cast<double>(k) - 0.9) / (static_cast<double>(all.size()) - 1.8);
      all.at(k) = low + share * (high - low);
    }
    return all;
  }

  /// Whether a vehicle can stand beside the wall, along it or across.
  [[nodiscard]] bool hasRoom(const Place& place) const {
    const VehicleParameters& vehicle = subject_.vehicle;
    const double little = 0.01 * subject_.length();
    return place.isFree(vehicle, {.position = {0.0, 0.5 * vehicle.width + little}}) ||
           place.isFree(vehicle, {.position = {0.0, vehicle.massCentreToFront + little},
                                  .yaw = -90.0 * degree});
  }

  const Subject& subject_;
  const WallSections& sections_;
  const Ground& ground_;
  Band band_;
};

}  // namespace

bool Place::isFree(const VehicleParameters& vehicle, const PlanarMotion& motion) const {
  const PlanRectangle outline = Outline(vehicle).enlarged(0.0);
  const Placement placement = motion.placement();
  return std::ranges::all_of(lines, [&](const WallLine& line) {
    return outline.misses(placement.local(line.from), placement.local(line.to));
  });
}

std::vector<Place> choosePlaces(const Subject& subject, const WallSections& sections,
                                const Ground& ground, std::span<const SmallFeature> features,
                                std::size_t count) {
  const Chooser chooser(subject, sections, ground);
  std::vector<Place> places;
  const auto addBothSides = [&](std::size_t wall, const Eigen::Vector3d& target, std::size_t most) {
    for (const bool isOtherSide : {false, true}) {
      if (places.size() >= most) return;
      if (std::optional<Place> place = chooser.at(wall, target, isOtherSide))
        places.push_back(std::move(*place));
    }
  };
  for (const SmallFeature& feature : features) addBothSides(feature.wall, feature.place, count / 2);

  // Walls one after the other, each as long as it is as seen from above.
  const std::vector<Wall>& walls = sections.walls();
  std::vector<double> ends;
  double sum = 0.0;
  for (const Wall& wall : walls) {
    const auto& c = wall.corners;
    sum += std::max({(c[1] - c[0]).head<2>().norm(), (c[2] - c[1]).head<2>().norm(),
                     (c[0] - c[2]).head<2>().norm()});
    ends.push_back(sum);
  }
  double at = 0.5;
  for (std::size_t i = 0; i < 8 * count && places.size() < count && sum > 0.0; ++i) {
    at = std::fmod(at + golden, 1.0);
    const auto found = std::ranges::upper_bound(ends, at * sum);
    const auto index = static_cast<std::size_t>(
        std::min(found - ends.begin(), static_cast<std::ptrdiff_t>(ends.size()) - 1));
    const auto& c = walls[index].corners;
    const double before = index == 0 ? 0.0 : ends[index - 1];
    const double share = (at * sum - before) / std::max(ends[index] - before, 1e-12);
    // Along the longest side; the place is then on the wall's line through that point.
    std::size_t k = 0;
    for (std::size_t j = 1; j < 3; ++j) {
      if ((c[(j + 1) % 3] - c[j]).head<2>().norm() > (c[(k + 1) % 3] - c[k]).head<2>().norm())
        k = j;
    }
    addBothSides(index, c[k] + share * (c[(k + 1) % 3] - c[k]), count);
  }
  return places;
}

}  // namespace bumper::doctor
