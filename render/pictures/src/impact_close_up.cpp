#include "bumper/render/impact_close_up.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "impact_situation.h"
#include "ink.h"
#include "offscreen_context.h"
#include "pen.h"
#include "rasteriser.h"
#include "run_excerpt.h"
#include "snapshot_input.h"
#include "text.h"
#include "text_renderer.h"
#include "vehicle_shape.h"

namespace bumper {

namespace {

using drawing::Colour;
using drawing::ink;
using drawing::mark;
using drawing::Party;
using drawing::Pen;
using drawing::Situation;
using drawing::touching;
using Eigen::Vector2d;
using Box = Eigen::AlignedBox2d;

const Colour softInk(0.36F, 0.38F, 0.42F, 1.0F);
const Colour ground(0.955F, 0.955F, 0.945F, 1.0F);
const Colour paper(1.0F, 1.0F, 1.0F, 1.0F);
const Colour wallColour(0.55F, 0.42F, 0.30F, 1.0F);
const Colour normalColour(0.05F, 0.40F, 0.72F, 1.0F);
const Colour armColour(0.42F, 0.20F, 0.62F, 1.0F);
const Colour beforeColour(0.93F, 0.53F, 0.03F, 1.0F);
const Colour afterColour(0.02F, 0.52F, 0.32F, 1.0F);

/// A part of the picture that shows a part of the ground plan, and nothing beyond its frame.
class Plan {
 public:
  Plan(Pen& pen, const Box& frame, Vector2d centre, double pixelsPerMetre, double unit)
      : pen_(pen), frame_(frame), centre_(std::move(centre)), scale_(pixelsPerMetre), unit_(unit) {}

  [[nodiscard]] Vector2d at(const Vector2d& point) const {
    return frame_.center() + scale_ * onPicture(point - centre_);
  }

  void line(const Vector2d& from, const Vector2d& to, double width, const Colour& colour) const {
    if (const auto part = inside(at(from), at(to)))
      pen_.line(part->first, part->second, width * unit_, colour);
  }

  void dashes(const Vector2d& from, const Vector2d& to, double width, const Colour& colour) const {
    if (const auto part = inside(at(from), at(to)))
      pen_.dashes(part->first, part->second, width * unit_, 4.0 * unit_, colour);
  }

  /// From a point on, a way given in units of text, in the plan's directions.
  void arrow(const Vector2d& from, const Vector2d& way, double width, const Colour& colour) {
    const Vector2d start = at(from);
    const Vector2d end = start + unit_ * onPicture(way);
    pen_.arrow(start, end, width * unit_, colour);
    keepClear(start, end);
  }

  void disc(const Vector2d& point, double radius, const Colour& colour) {
    pen_.disc(at(point), radius * unit_, colour);
    keepClear(at(point), at(point));
  }

  /// Keeps labels off a line.
  void keepClear(const Vector2d& start, const Vector2d& end) {
    for (int k = 0; k <= 12; ++k) {
      const Vector2d point = start + k / 12.0 * (end - start);
      taken_.emplace_back(Vector2d(point.array() - 2.0 * unit_),
                          Vector2d(point.array() + 2.0 * unit_));
    }
  }

  /// Written by writeLabels(), with its middle some units of text from the tip of a way from a
  /// point, or where there is room near there.
  void label(const Vector2d& point, const Vector2d& way, const Vector2d& beside,
             const std::string& text, const Colour& colour) {
    labels_.push_back(
        {at(point) + unit_ * onPicture(way), unit_ * onPicture(beside), text, colour});
  }

  /// Over everything that was drawn.
  void writeLabels() {
    for (const Label& label : labels_) {
      const Box area = placeOf(label);
      taken_.push_back(area);
      pen_.panel(area, 2.0 * unit_, Colour(1.0F, 1.0F, 1.0F, 0.85F));
      pen_.text(area.min() + Vector2d::Constant(labelMargin * unit_), label.text, unit_,
                label.colour);
    }
  }

  void fill(const std::vector<Vector2d>& corners, const Colour& colour) const {
    // Cut by one side of the frame after the other.
    std::vector<Vector2d> shape;
    shape.reserve(corners.size());
    for (const Vector2d& corner : corners) shape.push_back(at(corner));
    for (const int axis : {0, 1}) {
      for (const double sign : {-1.0, 1.0}) {
        const double limit = sign > 0.0 ? frame_.max()[axis] : -frame_.min()[axis];
        std::vector<Vector2d> kept;
        for (std::size_t k = 0; k < shape.size(); ++k) {
          const Vector2d& from = shape[k];
          const Vector2d& to = shape[(k + 1) % shape.size()];
          const double beyondFrom = sign * from[axis] - limit;
          const double beyondTo = sign * to[axis] - limit;
          if (beyondFrom <= 0.0) kept.push_back(from);
          if ((beyondFrom < 0.0 && beyondTo > 0.0) || (beyondFrom > 0.0 && beyondTo < 0.0))
            kept.emplace_back(from + beyondFrom / (beyondFrom - beyondTo) * (to - from));
        }
        shape = std::move(kept);
      }
    }
    for (std::size_t k = 2; k < shape.size(); ++k)
      pen_.triangle(shape[0], shape[k - 1], shape[k], colour);
  }

 private:
  struct Label {
    Vector2d tip;
    Vector2d beside;
    std::string text;
    Colour colour;
  };

  static constexpr double labelMargin = 1.8;  ///< units of text

  [[nodiscard]] static Vector2d onPicture(const Vector2d& way) { return {way.x(), -way.y()}; }

  /// Near where it is wanted, over as little as possible of what was drawn.
  [[nodiscard]] Box placeOf(const Label& label) const {
    const Vector2d half = unit_ * Vector2d(0.5 * drawing::textWidth(label.text) + labelMargin,
                                           0.5 * drawing::capitalHeight + labelMargin);
    const Vector2d margin = half + Vector2d::Constant(2.0 * unit_);
    Box best;
    double least = std::numeric_limits<double>::infinity();
    for (const double farther : {1.0, 1.5, 2.2, 3.0}) {
      for (int k = 0; k < 16; ++k) {
        // Alternately to either side, farther and farther.
        const double turn = (k % 2 == 0 ? 1.0 : -1.0) * std::ceil(0.5 * k) * std::numbers::pi / 8.0;
        // Wide labels need more room beside than above.
        Vector2d way = farther * (Eigen::Rotation2Dd(turn) * label.beside);
        way.x() += std::copysign(0.5 * half.x(), way.x()) * std::abs(way.x()) / way.norm();
        const Vector2d centre =
            (label.tip + way).cwiseMax(frame_.min() + margin).cwiseMin(frame_.max() - margin);
        const Box area(Vector2d(centre - half), Vector2d(centre + half));
        double cost = (label.tip + way - centre).norm() + 6.0 * unit_ * (farther - 1.0) +
                      4.0 * unit_ * std::abs(turn);
        for (const Box& taken : taken_) {
          const Box common = area.intersection(taken);
          if (!common.isEmpty()) cost += 8.0 * common.volume() / unit_;
        }
        if (cost < least) {
          least = cost;
          best = area;
        }
      }
    }
    return best;
  }

  /// The part of a line within the frame.
  [[nodiscard]] std::optional<std::pair<Vector2d, Vector2d>> inside(const Vector2d& from,
                                                                    const Vector2d& to) const {
    double first = 0.0;
    double last = 1.0;
    const Vector2d way = to - from;
    for (const int axis : {0, 1}) {
      for (const double sign : {-1.0, 1.0}) {
        const double room =
            sign > 0.0 ? frame_.max()[axis] - from[axis] : from[axis] - frame_.min()[axis];
        const double step = sign * way[axis];
        if (step > 0.0) last = std::min(last, room / step);
        if (step < 0.0) first = std::max(first, room / step);
        if (step == 0.0 && room < 0.0) return {};
      }
    }
    if (first >= last) return {};
    return std::pair(Vector2d(from + first * way), Vector2d(from + last * way));
  }

  Pen& pen_;
  Box frame_;
  Vector2d centre_;
  double scale_;
  double unit_;
  std::vector<Box> taken_;
  std::vector<Label> labels_;
};

/// Where along the tangent from the contact the surface that was hit begins and ends, m: walls of
/// the scene that lie on its line. All of the line if the barrier is none of the scene's.
std::vector<std::pair<double, double>> surfaceOf(const Situation& s) {
  constexpr double onLine = 0.02;
  std::vector<std::pair<double, double>> stretches;
  bool sceneHasIt = false;
  for (const auto& [from, to] : s.walls) {
    const Vector2d a = from - s.contact;
    const Vector2d b = to - s.contact;
    const Vector2d way = b - a;
    const double nearest = std::clamp(-a.dot(way) / std::max(way.squaredNorm(), 1e-12), 0.0, 1.0);
    sceneHasIt = sceneHasIt || (a + nearest * way).norm() < 5.0 * onLine;
    if (std::abs(a.dot(s.normal)) > onLine || std::abs(b.dot(s.normal)) > onLine) continue;
    const double begin = a.dot(s.tangent);
    const double end = b.dot(s.tangent);
    stretches.emplace_back(std::min(begin, end), std::max(begin, end));
  }
  if (!sceneHasIt) return {{-40.0, 40.0}};
  std::ranges::sort(stretches);
  std::vector<std::pair<double, double>> joined;
  for (const auto& [from, to] : stretches) {
    if (joined.empty() || from > joined.back().second + onLine)
      joined.emplace_back(from, to);
    else
      joined.back().second = std::max(joined.back().second, to);
  }
  return joined;
}

void addWalls(const Plan& plan, const Situation& s) {
  // Which side of the surface is the wall's.
  const Vector2d back = -0.3 * s.normal;
  const bool isWall = s.vehicle.event.otherVehicle.empty();
  for (const auto& [from, to] : isWall ? surfaceOf(s) : std::vector<std::pair<double, double>>()) {
    const Vector2d begin = s.contact + from * s.tangent;
    const Vector2d end = s.contact + to * s.tangent;
    plan.fill({begin, end, end + back, begin + back},
              Colour(wallColour.x(), wallColour.y(), wallColour.z(), 0.22F));
  }
  for (const auto& [from, to] : s.walls) plan.line(from, to, 1.6, wallColour);
}

/// The vehicle's own paint, darker for a line.
Colour lineColour(const Party& party) {
  const Eigen::Vector3f paint = 0.86F * drawing::paintOf(party.index);
  return {paint.x(), paint.y(), paint.z(), 1.0F};
}

void addOutline(const Plan& plan, const Party& p) {
  const Eigen::Vector3f paint =
      0.75F * drawing::paintOf(p.index) + Eigen::Vector3f::Constant(0.25F);
  plan.fill(p.corners, Colour(paint.x(), paint.y(), paint.z(), 0.28F));
  for (std::size_t k = 0; k < p.corners.size(); ++k)
    plan.line(p.corners[k], p.corners[(k + 1) % p.corners.size()], 1.1, lineColour(p));
  // The front, as a pointer to it.
  const Vector2d nose = p.centre + p.vehicle.massCentreToFront * p.forward;
  const double step = 0.22 * p.vehicle.width;
  plan.line(nose - step * p.forward + 1.6 * step * p.left, nose, 0.8, lineColour(p));
  plan.line(nose - step * p.forward - 1.6 * step * p.left, nose, 0.8, lineColour(p));
}

void addOutlines(const Plan& plan, const Situation& s) {
  addOutline(plan, s.vehicle);
  if (s.other) addOutline(plan, *s.other);
  plan.fill(s.overlap, Colour(mark.x(), mark.y(), mark.z(), 0.45F));
}

/// Whose outline is whose.
void addNames(Plan& plan, const Situation& s) {
  if (!s.other) return;
  for (const Party* p : {&s.vehicle, &*s.other}) {
    const Vector2d rear = p->centre - 0.8 * p->vehicle.massCentreToRear * p->forward;
    plan.label(rear, Vector2d::Zero(), -12.0 * p->forward, std::string(p->event.vehicle),
               lineColour(*p));
  }
}

void addArms(Plan& plan, const Situation& s) {
  const Vector2d none = Vector2d::Zero();
  const Vector2d centre = s.vehicle.centre;
  const Vector2d arm = s.contact - centre;
  const double x = arm.dot(s.normal);
  const double y = arm.dot(s.tangent);
  const Vector2d foot = centre + y * s.tangent;
  plan.dashes(s.contact, s.contact + (std::abs(x) + 0.8) * s.normal, 0.7, normalColour);
  plan.line(centre, foot, 1.2, armColour);
  plan.line(foot, s.contact, 1.2, armColour);
  plan.keepClear(plan.at(centre), plan.at(foot));
  plan.keepClear(plan.at(foot), plan.at(s.contact));
  plan.label(0.5 * (centre + foot), none, 10.0 * s.normal, "y = " + drawing::fixed(y, 2) + " m",
             armColour);
  plan.label(0.5 * (foot + s.contact), none, (y < 0.0 ? -10.0 : 10.0) * s.tangent,
             "x = " + drawing::fixed(x, 2) + " m", armColour);
  if (s.other) plan.dashes(s.other->centre, s.contact, 1.0, armColour);
}

/// `fastest` has an arrow of full length.
void addMotion(Plan& plan, const Party& s, double fastest) {
  constexpr double longest = 62.0;
  for (const auto& [velocity, colour, name] :
       {std::tuple{s.before, beforeColour, "before"}, {s.after, afterColour, "after"}}) {
    const Vector2d way = longest / fastest * velocity;
    if (!(way.norm() >= 1.0)) continue;
    plan.arrow(s.centre, way, 1.9, colour);
    plan.label(s.centre, way, 11.0 * way.normalized(),
               std::string(name) + " " + drawing::fixed(velocity.norm(), 1) + " m/s", colour);
  }
  constexpr double axis = 22.0;
  plan.arrow(s.centre, axis * s.forward, 0.9, ink);
  plan.label(s.centre, axis * s.forward, 5.0 * s.forward, "i", ink);
  plan.arrow(s.centre, axis * s.left, 0.9, ink);
  plan.label(s.centre, axis * s.left, 5.0 * s.left, "j", ink);
  plan.disc(s.centre, 3.0, ink);
  plan.disc(s.centre, 1.8, paper);
}

void addContact(Plan& plan, const Situation& s, bool magnified) {
  const Vector2d none = Vector2d::Zero();
  constexpr double axis = 30.0;
  plan.arrow(s.contact, axis * s.normal, 1.2, normalColour);
  plan.label(s.contact, axis * s.normal, 6.0 * s.normal, "N", normalColour);
  if (magnified) {
    plan.arrow(s.contact, axis * s.tangent, 1.2, normalColour);
    plan.label(s.contact, axis * s.tangent, 6.0 * s.tangent, "T", normalColour);
    const bool apart = (s.a - s.b).norm() > touching;
    for (const auto& [point, name, side] :
         {std::tuple{s.a, apart ? "a" : "a = b", -1.0}, {s.b, "b", 1.0}}) {
      if (!s.vehicle.event.otherVehicle.empty() || (!apart && side > 0.0)) continue;
      plan.disc(point, 2.6, ink);
      plan.label(point, none, 9.0 * (side * s.tangent - s.normal), name, ink);
    }
    plan.disc(s.contact, 2.4, paper);
    plan.disc(s.contact, 1.9, mark);
    const Vector2d beside = s.other ? Vector2d(-16.0 * (s.normal + s.tangent)) : -22.0 * s.normal;
    plan.label(s.contact, none, beside, apart ? "midpoint" : "contact", mark);
  } else {
    if (s.impulse.norm() > 1e-9) {
      const Vector2d push = 44.0 * s.impulse.normalized();
      plan.arrow(s.contact, push, 2.2, mark);
      const std::string_view name = s.vehicle.event.vehicle;
      plan.label(s.contact, push, 14.0 * (s.tangent + 0.3 * s.normal),
                 s.other ? "impulse on " + std::string(name) : "impulse", mark);
      if (s.other) {
        plan.arrow(s.contact, -push, 2.2, mark);
        plan.label(s.contact, -push, -14.0 * (s.tangent + 0.3 * s.normal),
                   "on " + std::string(s.other->event.vehicle), mark);
      }
    }
    plan.disc(s.contact, 3.2, paper);
    plan.disc(s.contact, 2.4, mark);
  }
}

struct Row {
  std::string name;
  std::string value;
};

std::vector<Row> rowsOf(const Situation& s) {
  using drawing::fixed;
  constexpr double degree = std::numbers::pi / 180.0;
  const ImpactEvent& e = s.vehicle.event;
  const auto known = [](double value, int decimals, const char* unit) {
    return std::isfinite(value) ? fixed(value, decimals) + unit : std::string("–");
  };
  // Of both vehicles, if there are two.
  const auto both = [&](double ImpactEvent::*value, double factor, int decimals, const char* unit) {
    if (!s.other) return known(factor * (e.*value), decimals, unit);
    return known(factor * (e.*value), decimals, "") + " | " +
           known(factor * (s.other->event.*value), decimals, unit);
  };
  return {
      {"time", known(e.time, 3, " s")},
      {"Δv", both(&ImpactEvent::deltaV, 1.0, 2, " m/s")},
      {"approach speed", known(e.approachSpeed, 2, " m/s")},
      {"angle of attack", known(e.angles.contactVelocity / degree, 1, "°")},
      {"speed before", both(&ImpactEvent::speedBefore, 1.0, s.other ? 1 : 2, " m/s")},
      {"speed after", both(&ImpactEvent::speedAfter, 1.0, s.other ? 1 : 2, " m/s")},
      {"yaw rate before", both(&ImpactEvent::yawRateBefore, 1.0 / degree, s.other ? 0 : 1, " °/s")},
      {"yaw rate after", both(&ImpactEvent::yawRateAfter, 1.0 / degree, s.other ? 0 : 1, " °/s")},
      {"impulse along N", known(0.001 * e.impulseNormal, 2, " kN s")},
      {"impulse along T", known(0.001 * e.impulseTangent, 2, " kN s")},
      {"restitution e", known(e.restitution, 2, "")},
      {"friction μ", known(e.friction, 2, "")},
      {"energy kept", known(100.0 * e.energyRatio, 0, " %")},
      {"law", std::string(toString(e.law))},
      {"regime", std::string(toString(e.regime))}};
}

double lengthOf(const Party& party) {
  return party.vehicle.massCentreToFront + party.vehicle.massCentreToRear;
}

/// What the detail has to show, m.
double extentOfContact(const Situation& s) {
  Box box(s.a);
  box.extend(s.b);
  for (const Vector2d& corner : s.overlap) box.extend(corner);
  return box.diagonal().norm();
}

/// The middle of the plan and its pixels per metre: the outlines, with room for arrows around them.
std::pair<Vector2d, double> framing(const Situation& s, const Box& frame) {
  if (!s.other) {
    const Vector2d middle = 0.5 * (s.vehicle.corners[0] + s.vehicle.corners[2]);
    return {0.6 * middle + 0.4 * s.contact,
            frame.sizes().minCoeff() / (1.75 * lengthOf(s.vehicle))};
  }
  Box box;
  for (const Party* party : {&s.vehicle, &*s.other}) {
    for (const Vector2d& corner : party->corners) box.extend(corner);
  }
  const double margin = 0.35 * std::max(lengthOf(s.vehicle), lengthOf(*s.other));
  const Vector2d needed = box.sizes().array() + 2.0 * margin;
  return {box.center(), frame.sizes().cwiseQuotient(needed).minCoeff()};
}

void paint(const Situation& s, std::size_t number, const CloseUpOptions& options, Pen& pen) {
  const double unit = std::max(0.8, options.height / 360.0);
  const double margin = 8.0 * unit;
  const double column = 150.0 * unit;
  const Box all(Vector2d::Zero(), Vector2d(options.width, options.height));
  const Box main(Vector2d::Zero(), Vector2d(options.width - column, options.height));
  pen.box(all, ground, ground);

  const auto [centre, scale] = framing(s, main);
  Plan plan(pen, main, centre, scale, unit);
  addWalls(plan, s);
  addOutlines(plan, s);
  addArms(plan, s);
  addContact(plan, s, false);
  double fastest = std::max({s.vehicle.before.norm(), s.vehicle.after.norm(), 1e-6});
  // Whatever is not known is not the larger one.
  if (s.other) {
    for (const Vector2d& velocity : {s.other->before, s.other->after})
      if (velocity.norm() > fastest) fastest = velocity.norm();
    addMotion(plan, *s.other, fastest);
  }
  addMotion(plan, s.vehicle, fastest);
  addNames(plan, s);
  plan.writeLabels();

  // The column beside: the magnified contact, and numbers below.
  pen.box(Box(Vector2d(main.max().x(), 0.0), all.max()), paper, paper);
  const double side = column - 2.0 * margin;
  const Vector2d corner(main.max().x() + margin, margin);
  const Box frame(corner, Vector2d(corner + Vector2d(side, 0.86 * side)));
  pen.panel(frame, 0.0, ground);
  const double span = std::clamp(2.2 * extentOfContact(s), 0.25, 1.5 * lengthOf(s.vehicle));
  Plan detail(pen, frame, s.contact, frame.sizes().minCoeff() / span, unit);
  addWalls(detail, s);
  addOutlines(detail, s);
  addContact(detail, s, true);
  detail.writeLabels();

  const std::string magnification = drawing::fixed(span, 2) + " m from edge to edge";
  double top = frame.max().y() + 4.0 * unit;
  pen.text({corner.x(), top}, magnification, 0.85 * unit, softInk);
  top += 15.0 * unit;
  const std::vector<Row> rows = rowsOf(s);
  const double step =
      std::min(13.0 * unit, (options.height - margin - top) / static_cast<double>(rows.size()));
  for (const Row& row : rows) {
    pen.text({corner.x(), top}, row.name, unit, softInk);
    pen.text({corner.x() + side - unit * drawing::textWidth(row.value), top}, row.value, unit, ink);
    top += step;
  }

  const ImpactEvent& event = s.vehicle.event;
  const std::string_view against = event.otherVehicle.empty() ? event.barrier : event.otherVehicle;
  const std::string title = "Impact " + std::to_string(number) + ": " + std::string(event.vehicle) +
                            " against " + std::string(against);
  const std::string second = drawing::fixed(event.time, 3) + " s · Δv " +
                             drawing::deltaVText(event) +
                             (event.material.empty() ? "" : " · " + std::string(event.material));
  const double wide = std::max(1.5 * drawing::textWidth(title), drawing::textWidth(second));
  pen.panel(
      Box(Vector2d(margin, margin), Vector2d(2.0 * margin + unit * wide, margin + 34.0 * unit)),
      3.0 * unit, paper);
  pen.text({1.5 * margin, margin + 5.0 * unit}, title, 1.5 * unit, ink);
  pen.text({1.5 * margin, margin + 21.0 * unit}, second, unit, softInk);

  // A metre.
  const Vector2d bar(2.0 * margin, options.height - 2.0 * margin);
  pen.line(bar, bar + Vector2d(scale, 0.0), 1.5 * unit, ink);
  for (const double end : {0.0, scale})
    pen.line(bar + Vector2d(end, -3.0 * unit), bar + Vector2d(end, 3.0 * unit), 1.5 * unit, ink);
  pen.text(bar + Vector2d(0.5 * (scale - unit * drawing::textWidth("1 m")), -12.0 * unit), "1 m",
           unit, ink);
}

}  // namespace

Image impactCloseUp(const Scene& scene, const Recording& recording, std::size_t impact,
                    const CloseUpOptions& options, OffscreenBackend backend) {
  drawing::checkPixels(options.width, 640, "CloseUpOptions::width");
  drawing::checkPixels(options.height, 360, "CloseUpOptions::height");
  const Situation situation = drawing::situationOf(scene, recording, impact);
  drawing::Picture picture;
  picture.width = options.width;
  picture.height = options.height;
  Pen pen(picture);
  paint(situation, impact + 1, options, pen);

  const auto context = drawing::makeOffscreenContext(backend);
  const drawing::ContextInUse use(*context);
  Image image = drawing::Rasteriser(*context, {}).draw(picture);
  drawing::TextRenderer().write(picture.textLines, image);
  return image;
}

}  // namespace bumper
