#include "engaged_contact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "../engagement.h"
#include "../tolerances.h"

namespace bumper {

namespace {

// From this weight of a wall that goes on, a contact is that of the chain and no longer in part
// that of the touched wall alone.
constexpr double wholeWeight = 0.25;

constexpr std::size_t longestChain = 64;
constexpr double sameVertex = 2e-4;  // m

// A way along walls, which have the vehicle on one side.
struct Way {
  Vector2 place;
  Vector2 along;                      // unit
  double side = 0.0;                  // 1: the vehicle is to the left, −1: to the right
  double turned = 0.0;                // away from the vehicle since the start, rad
  const Manifold* last = nullptr;     // the wall that leads here
  const Manifold* touched = nullptr;  // … or the one whose end the vehicle touches
};

class Chain {
 public:
  Chain(const ContactSet& contacts, const Engaged& engaged, double yielding)
      : contacts_(contacts), engaged_(engaged), yielding_(yielding) {}

  void include(const Manifold& wall, double weight) {
    if (count_ == walls_.size()) return;
    walls_[count_++] = &wall;
    sum_.add(engagement(engaged_.outline, engaged_.pose, wall.segment), weight);
  }

  void follow(Way way) {
    double weight = 1.0;
    while (count_ < walls_.size()) {
      const Next next = nextFrom(way);
      if (next.wall == nullptr || includes(*next.wall)) return;
      const double inwards = std::sin(std::max(next.turn, 0.0));
      if (next.turn > 0.5 * std::numbers::pi || inwards >= nearlyInLine) return;
      weight *= 1.0 - inwards / nearlyInLine;
      way.turned -= next.turn;
      const double depth = depthInside(engaged_.outline, engaged_.pose, way.place);
      if (way.last != nullptr && depth <= 0.0 && std::abs(way.turned) > nearlyInLine) return;
      const double facing = std::max(std::cos(way.turned), yielding_);
      if (facing <= 0.0 || way.turned > std::numbers::pi) return;
      include(*next.wall, weight * facing);
      if (next.wall != way.touched) {
        share_ = std::max(share_, std::min(weight * facing / wholeWeight, 1.0));
      }
      way.last = next.wall;
      way.place = next.end;
      way.along = next.along;
    }
  }

  [[nodiscard]] double share() const { return share_; }
  [[nodiscard]] const Engagement& sum() const { return sum_; }

 private:
  struct Next {
    const Manifold* wall = nullptr;
    Vector2 end = Vector2::Zero();
    Vector2 along = Vector2::Zero();
    double turn = -4.0;  // towards the vehicle, rad
  };

  [[nodiscard]] bool includes(const Manifold& wall) const {
    return std::find(walls_.begin(), walls_.begin() + count_, &wall) != walls_.begin() + count_;
  }

  // The wall that the vehicle sees first of those that begin here; ends that coincide come before
  // ends that are near.
  [[nodiscard]] Next nextFrom(const Way& way) const {
    double nearest = jointWidth;
    forEachEnd(way, [&](const Manifold& wall, double distance, const Vector2&, const Vector2&) {
      if (&wall != way.touched) nearest = std::min(nearest, std::max(distance, sameVertex));
    });
    // Not one that lies on the last one again; of a vertex that is touched, not one of the other
    // way.
    const double most = way.touched == nullptr ? std::numbers::pi - inLine : 0.5 * std::numbers::pi;
    const double least = way.last != nullptr ? -std::numbers::pi : -0.5 * std::numbers::pi;
    Next next;
    forEachEnd(
        way, [&](const Manifold& wall, double distance, const Vector2& from, const Vector2& to) {
          if (distance > nearest && &wall != way.touched) return;
          const Vector2 along = (to - from).normalized();
          const double turn = std::atan2(way.side * cross(way.along, along), way.along.dot(along));
          if (turn > next.turn && turn >= least && turn <= most) next = {&wall, to, along, turn};
        });
    return next;
  }

  // Calls with each wall that has an end within jointWidth of the way's place, the nearer one if
  // both are, that end, and the other one.
  template <typename Call>
  void forEachEnd(const Way& way, const Call& call) const {
    for (const Manifold& wall : contacts_.all()) {
      if (&wall == way.last || wall.passed || wall.segment.isPost()) continue;
      const Segment& segment = wall.segment;
      const double toStart = (segment.start - way.place).norm();
      const double toEnd = (segment.end - way.place).norm();
      if (std::min(toStart, toEnd) > jointWidth) continue;
      if (toStart < toEnd) {
        call(wall, toStart, segment.start, segment.end);
      } else {
        call(wall, toEnd, segment.end, segment.start);
      }
    }
  }

  const ContactSet& contacts_;
  const Engaged& engaged_;
  double yielding_;
  std::array<const Manifold*, longestChain> walls_{};
  std::size_t count_ = 0;
  Engagement sum_;
  double share_ = 0.0;  // the largest weight of a wall that goes on
};

}  // namespace

EngagedContact engagedContact(const ContactSet& contacts, const Manifold& struck,
                              const Engaged& engaged, double yielding) {
  const Overlap& touch = struck.overlap;
  const Segment& wall = struck.segment;
  const Vector2 tangent = turnedLeft(touch.normal);
  const Vector2 touched = touch.deepest * tangent + touch.offset * touch.normal;
  Chain chain(contacts, engaged, yielding);
  const std::optional<Vector2> end = touch.byEnd ? endAt(wall, touched) : std::nullopt;
  if (end) {
    chain.follow({.place = *end, .along = tangent, .side = -1.0, .touched = &struck});
    chain.follow({.place = *end, .along = -tangent, .side = 1.0, .touched = &struck});
  } else {
    const bool forward = tangent.dot(wall.end - wall.start) > 0.0;
    const Vector2 along = (wall.end - wall.start).normalized();
    chain.include(struck, 1.0);
    chain.follow(
        {.place = wall.end, .along = along, .side = forward ? -1.0 : 1.0, .last = &struck});
    chain.follow(
        {.place = wall.start, .along = -along, .side = forward ? 1.0 : -1.0, .last = &struck});
  }
  EngagedContact result{.share = std::max(chain.share(), yielding)};
  const Engagement& sum = chain.sum();
  const double push = sum.push.norm();
  if (!(push > 0.0) || sum.depth <= touchTolerance) return result;
  const Vector2 middle = sum.moment / sum.length;
  result.meets = true;
  result.contact = {.point = middle, .arm = middle - engaged.pose.position};
  result.normal = sum.push / push;
  return result;
}

}  // namespace bumper
