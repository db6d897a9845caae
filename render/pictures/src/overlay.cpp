#include "overlay.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "ink.h"
#include "pen.h"
#include "speed_colours.h"
#include "text.h"
#include "vehicle_shape.h"

namespace bumper::drawing {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Box = Eigen::AlignedBox2d;

const Colour softInk(0.09F, 0.10F, 0.14F, 0.72F);
const Colour paper(1.0F, 1.0F, 1.0F, 0.86F);
const Colour white(1.0F, 1.0F, 1.0F, 1.0F);

constexpr double fullArrow = 34.0;  ///< in the small text's units

constexpr const char* markLegend = "arrow: push of the wall · Δv: change of velocity";
constexpr const char* pairLegend =
    "arrows: push of the wall or of each other · Δv: change of velocity";

double overlapArea(const Box& a, const Box& b) {
  const Box common = a.intersection(b);
  return common.isEmpty() ? 0.0 : common.volume();
}

Box grown(const Box& box, double by) {
  return {Vector2d(box.min().array() - by), Vector2d(box.max().array() + by)};
}

/// A mark whose place on the picture is known.
struct PlacedMark {
  const DrawnImpact* impact = nullptr;
  Vector2d point;
  Vector2d tail;  ///< of the arrow, on the mark's rim
  Vector2d tip;
  std::optional<std::pair<Vector2d, Vector2d>> opposite;  ///< the other vehicle's arrow
};

/// What a label may cover if it must, at a price per area.
struct Disliked {
  Box area;
  double weight = 0.0;
};

class Overlay {
 public:
  Overlay(const Camera& camera, const RunExcerpt& run, const SnapshotOptions& options,
          Picture& picture)
      : camera_(camera),
        run_(run),
        options_(options),
        pen_(picture),
        // The em is nine units: 18 pixels of 720.
        small_(std::max(1.0, std::round(options.height / 180.0) / 2.0)),
        large_(std::max(1.0, std::round(options.height / 120.0) / 2.0)),
        margin_(std::round(0.022 * options.height)),
        padding_(4.0 * small_),
        markRadius_(3.6 * small_) {}

  void addTitle(const std::string& title) {
    std::string second;
    if (!run_.poses.empty()) {
      const bool instant = run_.start == run_.end || options_.moment.has_value();
      second = instant ? fixed(run_.now, 2) + " s"
                       : fixed(run_.start, 2) + " s to " + fixed(run_.end, 2) + " s";
      if (options_.moment) second += speedNow();
      second += impactsSoFar();
    }
    struct Line {
      std::string text;
      double scale;
      double top;
      const Colour& colour;
    };
    const double room = options_.width - 2.0 * (margin_ + padding_);
    std::vector<Line> lines;
    Vector2d size = Vector2d::Zero();
    const auto addLine = [&](const std::string& text, double wanted, const Colour& colour) {
      if (text.empty()) return;
      const double scale = scaleFor(text, wanted, room);
      if (!lines.empty()) size.y() += 5.0 * scale;
      lines.push_back({text, scale, size.y(), colour});
      size.x() = std::max(size.x(), scale * textWidth(text));
      size.y() += scale * capitalHeight;
    };
    addLine(title, large_, ink);
    addLine(second, small_, softInk);
    if (options_.showImpacts && !run_.impacts.empty())
      addLine(hasPairs(run_) ? pairLegend : markLegend, small_, softInk);
    const std::vector<Named> names = namesFor(room);
    const double namesTop = size.y() + 5.0 * small_;
    if (!names.empty()) {
      size.y() = namesTop + small_ * capitalHeight;
      size.x() = std::max(size.x(), names.back().end);
    }
    const Vector2d corner(margin_, margin_);
    addPanel(Box(corner, Vector2d((corner + size).array() + 2.0 * padding_)));
    for (const Line& line : lines)
      pen_.text(corner + Vector2d(padding_, padding_ + line.top), line.text, line.scale,
                line.colour);
    for (const Named& named : names) {
      Vector2d place = corner + Vector2d(padding_ + named.start, padding_ + namesTop);
      if (named.paint) {
        const double side = small_ * capitalHeight;
        pen_.box(Box(place, Vector2d(place.array() + side)), *named.paint, *named.paint);
        place.x() += side + nameGap * small_;
      }
      pen_.text(place, named.name, small_, softInk);
    }
  }

  void addLegend() {
    const double end = legendEnd(run_);
    const double barWidth = std::round(0.17 * options_.width);
    const double barHeight = 6.0 * small_;
    const std::string name = "speed, m/s";
    const double line = small_ * capitalHeight;
    const Vector2d size(barWidth + 2.0 * padding_ + 4.0 * small_,
                        2.0 * line + barHeight + 2.0 * padding_ + 6.0 * small_);
    const Vector2d corner(options_.width - margin_ - size.x(),
                          options_.height - margin_ - size.y());
    addPanel(Box(corner, Vector2d(corner + size)));
    const Vector2d start = (corner + Vector2d(padding_ + 2.0 * small_, padding_)).array().round();
    pen_.text(start, name, small_, ink);
    const double top = start.y() + line + 2.0 * small_;
    constexpr int steps = 48;
    for (int k = 0; k < steps; ++k) {
      const double from = static_cast<double>(k) / steps;
      const double to = static_cast<double>(k + 1) / steps;
      pen_.box(Box(Vector2d(start.x() + barWidth * from, top),
                   Vector2d(start.x() + barWidth * to, top + barHeight)),
               legendColour(from), legendColour(to));
    }
    for (const double share : {0.0, 0.5, 1.0}) {
      const double value = share * end;
      const bool whole = std::abs(value - std::round(value)) < 1e-9;
      const std::string number = fixed(value, whole ? 0 : (end < 1.0 ? 2 : 1));
      const double x = start.x() + share * barWidth;
      const double width = small_ * textWidth(number);
      pen_.line({x, top + barHeight}, {x, top + barHeight + 2.0 * small_}, small_, ink);
      pen_.text({std::clamp(x - 0.5 * width, start.x() - small_,
                            start.x() + barWidth + 2.0 * small_ - width),
                 top + barHeight + 4.0 * small_},
                number, small_, ink);
    }
  }

  /// A bar of round length, and which way x and y point.
  void addScaleBar() {
    const double pixelsPerMetre = camera_.pixelsPerMetre(camera_.focus);
    const double length = roundedDown(0.17 * options_.width / pixelsPerMetre);
    const double pixels = length * pixelsPerMetre;
    const int decimals = length < 1.0 ? static_cast<int>(std::ceil(-std::log10(length))) : 0;
    const std::string label = fixed(length, decimals) + " m";
    const double line = small_ * capitalHeight;
    const double compass = 13.0 * small_;
    const double barArea = std::max(pixels, small_ * textWidth(label));
    const Vector2d size(2.0 * padding_ + barArea + compass + 19.0 * small_,
                        2.0 * padding_ + 2.0 * line + 6.0 * small_);
    const Vector2d corner(margin_, options_.height - margin_ - size.y());
    addPanel(Box(corner, Vector2d(corner + size)));

    const double left = corner.x() + padding_ + 2.0 * small_;
    const double bar = corner.y() + size.y() - padding_ - 3.0 * small_;
    const double tick = 3.0 * small_;
    pen_.text({left + 0.5 * (pixels - small_ * textWidth(label)), bar - tick - line - small_},
              label, small_, ink);
    pen_.line({left, bar}, {left + pixels, bar}, 1.5 * small_, ink);
    for (const double x : {left, left + pixels})
      pen_.line({x, bar - tick}, {x, bar + tick}, 1.5 * small_, ink);

    addAxes(Vector2d(left + barArea + 9.0 * small_ + 0.5 * compass,
                     corner.y() + 0.5 * size.y() + 1.5 * small_),
            compass);
  }

  /// Which way x, y and z point where the picture is about, and how far apart the grid's lines are.
  void addCompass(double gridSpacing) {
    const std::string label = "grid " + fixed(gridSpacing, 0) + " m";
    const double line = small_ * capitalHeight;
    const double compass = 17.0 * small_;
    const Vector2d size(2.0 * padding_ + small_ * textWidth(label) + 2.6 * compass + 8.0 * small_,
                        2.0 * padding_ + 2.0 * compass);
    const Vector2d corner(margin_, options_.height - margin_ - size.y());
    addPanel(Box(corner, Vector2d(corner + size)));
    pen_.text(corner + Vector2d(padding_ + 2.0 * small_, 0.5 * (size.y() - line)), label, small_,
              ink);
    addAxes(Vector2d(corner.x() + size.x() - padding_ - 1.3 * compass, corner.y() + 0.5 * size.y()),
            compass);
  }

  void addImpacts() {
    std::vector<PlacedMark> marks;
    const DrawnImpact* worst = hardest(run_);
    for (const DrawnImpact& impact : run_.impacts) {
      const auto point = camera_.pixel(impact.event.contact);
      if (!point || !impact.shown) continue;
      marks.push_back(placeMark(impact, *point, std::max(hardness(worst->event), fullArrowDeltaV)));
    }
    for (const PlacedMark& placed : marks) {
      avoided_.push_back(grown(Box(placed.point), markRadius_ + small_));
      if (placed.impact->labelled) {
        Box arrow(placed.point);
        if (placed.opposite) arrow.extend(placed.opposite->second);
        avoided_.push_back(grown(Box(arrow.extend(placed.tip)), 1.5 * small_));
      }
    }
    for (const auto& [colour, rim] : {std::pair{white, 0.9 * small_}, {ink, 0.0}}) {
      for (const PlacedMark& placed : marks) {
        if (!placed.impact->labelled) continue;
        pen_.arrow(placed.tail, placed.tip, 1.8 * small_, colour, rim);
        if (placed.opposite)
          pen_.arrow(placed.opposite->first, placed.opposite->second, 1.8 * small_, colour, rim);
      }
    }
    std::vector<std::optional<Box>> labels;
    for (const PlacedMark& placed : marks) {
      labels.push_back(placed.impact->labelled ? placeLabel(placed, marks) : std::nullopt);
      if (labels.back()) keepClear(placed.point, *labels.back());
    }
    for (std::size_t k = 0; k < marks.size(); ++k) {
      if (labels[k]) pen_.line(marks[k].point, labels[k]->center(), small_, ink);
    }
    // Small ones first: they may lie at the same place.
    for (const bool labelled : {false, true}) {
      const double size = labelled ? markRadius_ : 0.6 * markRadius_;
      for (const PlacedMark& placed : marks) {
        if (placed.impact->labelled != labelled) continue;
        pen_.disc(placed.point, size + small_, white);
        pen_.disc(placed.point, size, mark);
      }
    }
    for (std::size_t k = 0; k < marks.size(); ++k) {
      if (labels[k]) drawLabel(*marks[k].impact, *labels[k]);
    }
  }

  /// When each drawn vehicle was there, where nothing else is.
  void addTimes() {
    for (const DrawnPose& drawn : run_.poses) {
      const auto point = camera_.pixel(drawn.pose.position);
      if (!point) continue;
      const std::string time = fixed(drawn.pose.time, 2) + " s";
      const Vector2d size(small_ * (textWidth(time) + 5.0), small_ * (capitalHeight + 4.0));
      // Beside the vehicle, on the left of its way if there is no reason for another side.
      const Vector3d left = drawn.pose.orientation * Vector3d::UnitY();
      const double half =
          std::min(60.0, 1.2 * camera_.pixelsPerMetre(drawn.pose.position) / small_);
      const auto area = bestPlace(*point, half + 3.0, size, onPicture(left).stableNormalized());
      if (!area || (area->center() - *point).norm() > (half + 85.0) * small_) continue;
      const bool free = std::ranges::none_of(avoided_, [&](const Box& taken) {
        return overlapArea(*area, taken) > 0.02 * area->volume();
      });
      if (!free) continue;
      pen_.panel(*area, 2.5 * small_, paper);
      pen_.text(area->min() + small_ * Vector2d(2.5, 2.0), time, small_, ink);
      avoided_.push_back(grown(*area, small_));
    }
  }

  /// Keeps labels away from vehicles and paths where that is possible.
  void avoidRun() {
    for (const DrawnPose& drawn : run_.poses)
      avoid(drawn.pose.position, 2.2, drawn.last ? 4.0 : 1.2);
    for (const auto& path : run_.paths) {
      for (std::size_t k = 0; k < path.size(); k += std::max<std::size_t>(1, path.size() / 100))
        avoid(path[k].position, 0.5, 0.8);
    }
  }

 private:
  /// Arrows as they look from here; what points away from the viewer is short. All of them lie
  /// around a centre, whichever way they point.
  void addAxes(const Vector2d& centre, double length) {
    Box reached(Vector2d::Zero());
    std::vector<std::pair<Vector2d, std::string>> axes;
    for (const auto& [axis, name] : {std::pair{Vector3d(Vector3d::UnitX()), "x"},
                                     {Vector3d(Vector3d::UnitY()), "y"},
                                     {Vector3d(Vector3d::UnitZ()), "z"}}) {
      const Vector2d way = length * onPicture(axis);
      if (way.norm() < 0.15 * length) continue;
      axes.emplace_back(way, name);
      reached.extend(way);
    }
    const Vector2d origin = centre - reached.center();
    for (const auto& [way, name] : axes) {
      pen_.arrow(origin, origin + way, 1.1 * small_, ink);
      // Beyond the tip.
      const Vector2d beside = origin + way + 5.0 * small_ * way.normalized();
      pen_.text(beside - 0.5 * Vector2d(small_ * textWidth(name), small_ * capitalHeight), name,
                small_, ink);
    }
  }

  /// The speed of a vehicle that is alone.
  [[nodiscard]] std::string speedNow() const {
    if (run_.trails.size() != 1 || run_.trails[0].empty()) return "";
    return " · " + fixed(run_.trails[0].back().velocity.norm(), 1) + " m/s";
  }

  [[nodiscard]] std::string impactsSoFar() const {
    const auto count = std::ranges::count(run_.impacts, true, &DrawnImpact::shown);
    if (count == 0) return "";
    double most = 0.0;
    for (const DrawnImpact& impact : run_.impacts)
      most = impact.shown ? std::max(most, hardness(impact.event)) : most;
    return (count == 1 ? " · 1 impact: Δv "
                       : " · " + std::to_string(count) + " impacts, hardest: Δv ") +
           fixed(most, 1) + " m/s";
  }

  /// A vehicle's name in the legend, pixels from the legend's left end.
  struct Named {
    std::string name;
    std::optional<Colour> paint;
    double start = 0.0;
    double end = 0.0;
  };
  static constexpr double nameGap = 3.0;  ///< units of text

  /// Whose paint is whose, if there are several: as many as have their own and there is room for.
  [[nodiscard]] std::vector<Named> namesFor(double room) const {
    if (run_.names.size() < 2) return {};
    std::vector<Named> names;
    double start = 0.0;
    for (std::size_t v = 0; v < run_.names.size(); ++v) {
      Named next;
      next.name = run_.names[v];
      next.start = start;
      const bool last = v + 1 == run_.names.size();
      const auto own = options_.vehicleMeshes.find(next.name);
      const bool isOwn = own != options_.vehicleMeshes.end() && !own->second->meshes.empty();
      const Eigen::Vector3f paint = isOwn ? own->second->meshes.front().colour : paintOf(v);
      next.paint = Colour(paint.x(), paint.y(), paint.z(), 1.0F);
      next.end = start + small_ * (capitalHeight + nameGap + textWidth(next.name));
      const std::string rest = "and " + std::to_string(run_.names.size() - v) + " more";
      const double reserved = last ? 0.0 : small_ * (4.0 * nameGap + textWidth(rest));
      if (v >= paintCount || next.end + reserved > room) {
        names.push_back({rest, std::nullopt, start, start + small_ * textWidth(rest)});
        return names;
      }
      start = next.end + 3.0 * nameGap * small_;
      names.push_back(std::move(next));
    }
    return names;
  }

  [[nodiscard]] static double scaleFor(const std::string& line, double wanted, double room) {
    double scale = wanted;
    while (scale > 1.0 && scale * textWidth(line) > room) scale -= 0.5;
    return scale;
  }

  [[nodiscard]] static Colour legendColour(double share) {
    const Eigen::Vector3f colour = speedColour(share);
    return {colour.x(), colour.y(), colour.z(), 1.0F};
  }

  [[nodiscard]] Vector2d onPicture(const Vector3d& direction) const {
    return {camera_.right().dot(direction), -camera_.up().dot(direction)};
  }

  /// A Δv of `full` has an arrow of full length.
  [[nodiscard]] PlacedMark placeMark(const DrawnImpact& impact, const Vector2d& point,
                                     double full) const {
    const ImpactEvent& event = impact.event;
    PlacedMark placed;
    placed.impact = &impact;
    placed.point = point;
    std::tie(placed.tail, placed.tip) =
        arrowAlong(event.contact, event.normal, point, event.deltaV / full);
    const auto other = asSeenBy(event.otherVehicle, event);
    if (other && other->deltaV > 0.0)
      placed.opposite = arrowAlong(event.contact, other->normal, point, other->deltaV / full);
    return placed;
  }

  /// From a mark's rim, of a share of the full length.
  [[nodiscard]] std::pair<Vector2d, Vector2d> arrowAlong(const Vector3d& place,
                                                         const Vector3d& direction,
                                                         const Vector2d& point,
                                                         double share) const {
    const Vector3d ahead = place + 0.5 * direction;
    const Vector2d way = camera_.pixel(ahead).value_or(point) - point;
    if (way.norm() < 1e-9) return {point, point};
    // As long as the direction allows: one that points at the camera is short.
    const double foreshortening = std::min(1.0, way.norm() / (0.5 * camera_.pixelsPerMetre(place)));
    const double length = fullArrow * small_ * share * std::max(0.4, foreshortening);
    const Vector2d tail = point + markRadius_ * way.normalized();
    return {tail, tail + length * way.normalized()};
  }

  /// A square around a point of the world, half a side in m, that a label should not cover.
  void avoid(const Vector3d& point, double half, double weight) {
    const auto centre = camera_.pixel(point);
    if (!centre) return;
    disliked_.push_back({grown(Box(*centre), half * camera_.pixelsPerMetre(point)), weight});
  }

  void addPanel(const Box& area) {
    pen_.panel(area, 3.0 * small_, paper);
    avoided_.push_back(grown(area, 2.0 * small_));
  }

  [[nodiscard]] static std::string numberOf(const DrawnImpact& impact) {
    return std::to_string(impact.number);
  }

  [[nodiscard]] static std::string valueOf(const DrawnImpact& impact) {
    return "Δv " + deltaVText(impact.event);
  }

  [[nodiscard]] Vector2d labelSize(const DrawnImpact& impact) const {
    return {small_ * (textWidth(numberOf(impact)) + textWidth(valueOf(impact)) + 17.0),
            small_ * (capitalHeight + 8.0)};
  }

  /// Where a label hides least: away from the arrow and from other marks if it can, over no other
  /// label, mark or panel. Nothing for a mark that lies outside the picture, or so near to its edge
  /// that no label beside it lies inside.
  [[nodiscard]] std::optional<Box> placeLabel(const PlacedMark& placed,
                                              const std::vector<PlacedMark>& marks) const {
    const Vector2d size = labelSize(*placed.impact);
    Vector2d away = placed.point - placed.tip;
    away = away.norm() > 1e-9 ? Vector2d(away.normalized()) : Vector2d(0.0, 1.0);
    for (const PlacedMark& other : marks) {
      const Vector2d apart = placed.point - other.point;
      if (other.impact->labelled && apart.norm() > 1e-9 && apart.norm() < size.x())
        away += 2.0 * (1.0 - apart.norm() / size.x()) * apart.normalized();
    }
    return bestPlace(placed.point, 10.0, size, away.stableNormalized());
  }

  /// For a label of a size beside a point, at least some units of text away from it.
  [[nodiscard]] std::optional<Box> bestPlace(const Vector2d& point, double least,
                                             const Vector2d& size, const Vector2d& away) const {
    const Box picture(Vector2d(margin_, margin_),
                      Vector2d(options_.width - margin_, options_.height - margin_));
    if (!Box(Vector2d::Zero(), Vector2d(options_.width, options_.height)).contains(point))
      return {};
    std::optional<Box> best;
    double lowest = std::numeric_limits<double>::infinity();
    for (const double farther : {0.0, 8.0, 18.0, 30.0, 45.0, 62.0}) {
      const double distance = least + farther;
      for (int k = 0; k < 24; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / 24.0;
        const Vector2d way(std::cos(angle), std::sin(angle));
        // The nearest point of the label is at the distance.
        const double half = std::min(std::abs(0.5 * size.x() / (std::abs(way.x()) + 1e-9)),
                                     std::abs(0.5 * size.y() / (std::abs(way.y()) + 1e-9)));
        const Vector2d centre = point + (distance * small_ + half) * way;
        const Box area(Vector2d(centre - 0.5 * size), Vector2d(centre + 0.5 * size));
        if (!picture.contains(area)) continue;
        double cost = 3.0 * distance + 70.0 * (1.0 - way.dot(away));
        const double unit = small_ * small_;
        for (const Box& taken : avoided_) cost += 16.0 * overlapArea(area, taken) / unit;
        for (const auto& [taken, weight] : disliked_)
          cost += weight * overlapArea(area, taken) / unit;
        for (const Box& dot : leader(point, centre)) {
          for (const Box& other : labels_) cost += 40.0 * overlapArea(dot, other) / dot.volume();
        }
        if (cost < lowest) {
          lowest = cost;
          best = area;
        }
      }
    }
    return best;
  }

  /// Of later labels: a label and the line to it from its mark.
  void keepClear(const Vector2d& point, const Box& label) {
    avoided_.push_back(grown(label, 2.0 * small_));
    labels_.push_back(grown(label, 2.0 * small_));
    for (const Box& dot : leader(point, label.center())) avoided_.push_back(dot);
  }

  /// Small boxes along the line from a mark to its label.
  [[nodiscard]] std::vector<Box> leader(const Vector2d& from, const Vector2d& to) const {
    std::vector<Box> dots;
    constexpr int count = 10;
    for (int k = 2; k < count; ++k) {
      const double share = static_cast<double>(k) / count;
      dots.push_back(grown(Box(Vector2d(from + share * (to - from))), 2.0 * small_));
    }
    return dots;
  }

  void drawLabel(const DrawnImpact& impact, const Box& area) {
    const std::string number = numberOf(impact);
    const double numberWidth = small_ * (textWidth(number) + 7.0);
    pen_.panel(grown(area, 0.75 * small_), 4.0 * small_, white);
    pen_.panel(area, 3.5 * small_, ink);
    const double baseline = area.center().y() - 0.5 * small_ * capitalHeight;
    pen_.panel(Box(area.min(), Vector2d(area.min().x() + numberWidth, area.max().y())),
               3.5 * small_, mark);
    pen_.text({area.min().x() + 4.0 * small_, baseline}, number, small_, white);
    pen_.text({area.min().x() + numberWidth + 4.0 * small_, baseline}, valueOf(impact), small_,
              white);
  }

  const Camera& camera_;
  const RunExcerpt& run_;
  const SnapshotOptions& options_;
  Pen pen_;
  double small_;
  double large_;
  double margin_;
  double padding_;
  double markRadius_;
  std::vector<Box> avoided_;
  std::vector<Box> labels_;
  std::vector<Disliked> disliked_;
};

}  // namespace

double legendEnd(const RunExcerpt& run) { return roundedUp(topSpeed(run)); }

void addOverlay(const Camera& camera, const RunExcerpt& run, const SnapshotOptions& options,
                const std::string& title, Picture& picture) {
  Overlay overlay(camera, run, options, picture);
  if (options.showTitle) overlay.addTitle(title);
  if (options.showPath && !run.poses.empty()) overlay.addLegend();
  if (options.showScaleBar) {
    if (options.view == SnapshotView::top)
      overlay.addScaleBar();
    else
      overlay.addCompass(picture.gridSpacing);
  }
  overlay.avoidRun();
  if (options.showImpacts) overlay.addImpacts();
  const bool isCrowd = run.names.size() > paintCount;
  if (options.showTimes && options.showVehicles && !options.moment && !isCrowd) overlay.addTimes();
}

}  // namespace bumper::drawing
