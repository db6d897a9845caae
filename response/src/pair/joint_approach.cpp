#include "joint_approach.h"

#include <algorithm>
#include <cmath>

namespace bumper {

namespace {

// Fraction of the fastest approach that counts as rounding.
constexpr double jointRounding = 1e-12;

// A contact whose direction lies so nearly in the span of the active ones adds nothing.
constexpr double dependent = 1e-11;

double separatingSpeed(std::span<const PlanarBody> bodies, const JointContact& contact) {
  double speed = contact.normal.dot(velocityAt(bodies[contact.body].motion, contact.arm));
  if (contact.otherBody != JointContact::none) {
    speed +=
        contact.otherNormal.dot(velocityAt(bodies[contact.otherBody].motion, contact.otherArm));
  }
  return speed - contact.wallSpeed;
}

double share(const PlanarBody& body, const Vector2& normal, const Vector2& arm,
             const Vector2& otherNormal, const Vector2& otherArm) {
  return normal.dot(otherNormal) / body.mass +
         cross(arm, normal) * cross(otherArm, otherNormal) / body.yawInertia;
}

// By how much an impulse at one contact changes the separating speed at another, 1/kg.
double coupling(std::span<const PlanarBody> bodies, const JointContact& a, const JointContact& b) {
  double sum = 0.0;
  const auto add = [&](std::size_t body, const Vector2& normal, const Vector2& arm) {
    if (body == JointContact::none) return;
    if (b.body == body) sum += share(bodies[body], normal, arm, b.normal, b.arm);
    if (b.otherBody == body) sum += share(bodies[body], normal, arm, b.otherNormal, b.otherArm);
  };
  add(a.body, a.normal, a.arm);
  add(a.otherBody, a.otherNormal, a.otherArm);
  return sum;
}

void act(std::span<PlanarBody> bodies, const JointContact& contact, double impulse) {
  const auto on = [&](std::size_t body, const Vector2& normal, const Vector2& arm) {
    const Vector2 linear = impulse * normal;
    bodies[body].apply({.linear = linear, .angular = cross(arm, linear)});
  };
  on(contact.body, contact.normal, contact.arm);
  if (contact.otherBody != JointContact::none) {
    on(contact.otherBody, contact.otherNormal, contact.otherArm);
  }
}

}  // namespace

// Of the active contacts; false if the last one depends on the others.
bool JointApproach::factorise(std::span<const PlanarBody> bodies,
                              std::span<const JointContact> contacts) {
  const std::size_t count = active_.size();
  factor_.resize(count * count);
  for (std::size_t row = 0; row < count; ++row) {
    for (std::size_t column = 0; column <= row; ++column) {
      double sum = coupling(bodies, contacts[active_[row]], contacts[active_[column]]);
      const double whole = sum;
      for (std::size_t k = 0; k < column; ++k) {
        sum -= factor_[row * count + k] * factor_[column * count + k];
      }
      if (row != column) {
        factor_[row * count + column] = sum / factor_[column * count + column];
      } else if (sum > dependent * whole) {
        factor_[row * count + row] = std::sqrt(sum);
      } else {
        return false;
      }
    }
  }
  return true;
}

// Solves for no approach at all active contacts, and drops those that would have to pull; false if
// the contact added last depends on the others.
bool JointApproach::balance(std::span<const PlanarBody> bodies,
                            std::span<const JointContact> contacts) {
  while (!active_.empty()) {
    if (!factorise(bodies, contacts)) return false;
    const std::size_t count = active_.size();
    wanted_.resize(count);
    for (std::size_t row = 0; row < count; ++row) {
      double sum = -speeds_[active_[row]];
      for (std::size_t k = 0; k < row; ++k) sum -= factor_[row * count + k] * wanted_[k];
      wanted_[row] = sum / factor_[row * count + row];
    }
    for (std::size_t row = count; row-- > 0;) {
      double sum = wanted_[row];
      for (std::size_t k = row + 1; k < count; ++k) sum -= factor_[k * count + row] * wanted_[k];
      wanted_[row] = sum / factor_[row * count + row];
    }
    double way = 1.0;
    std::size_t first = count;
    for (std::size_t i = 0; i < count; ++i) {
      if (wanted_[i] > 0.0) continue;
      const double now = impulses_[active_[i]];
      const double until = now > 0.0 ? now / (now - wanted_[i]) : 0.0;
      if (first == count || until < way) {
        way = until;
        first = i;
      }
    }
    for (std::size_t i = 0; i < count; ++i) {
      double& impulse = impulses_[active_[i]];
      impulse += way * (wanted_[i] - impulse);
    }
    if (first == count) return true;
    impulses_[active_[first]] = 0.0;
    active_.erase(active_.begin() + static_cast<std::ptrdiff_t>(first));
  }
  return true;
}

JointApproach::Result JointApproach::solve(std::span<const PlanarBody> bodies,
                                           std::span<const JointContact> contacts) {
  impulses_.assign(contacts.size(), 0.0);
  isUseless_.assign(contacts.size(), false);
  speeds_.clear();
  active_.clear();
  double fastest = 0.0;
  for (const JointContact& contact : contacts) {
    speeds_.push_back(separatingSpeed(bodies, contact));
    fastest = std::max(fastest, std::abs(speeds_.back()));
  }
  const std::size_t mostRounds = 4 * std::min(contacts.size(), mostActive) + 4;
  for (std::size_t round = 0; round < mostRounds && active_.size() < mostActive; ++round) {
    bodies_.assign(bodies.begin(), bodies.end());
    for (const std::size_t i : active_) act(bodies_, contacts[i], impulses_[i]);
    std::size_t next = contacts.size();
    double least = -jointRounding * fastest;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      if (isUseless_[i] || impulses_[i] > 0.0) continue;
      const double speed = separatingSpeed(bodies_, contacts[i]);
      if (speed < least) {
        least = speed;
        next = i;
      }
    }
    if (next == contacts.size()) break;
    active_.push_back(next);
    if (!balance(bodies, contacts)) {
      active_.pop_back();
      isUseless_[next] = true;
    }
  }
  Result result{.impulses = impulses_, .speeds = speeds_};
  bodies_.assign(bodies.begin(), bodies.end());
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (!(impulses_[i] > 0.0)) continue;
    act(bodies_, contacts[i], impulses_[i]);
    result.weight += impulses_[i] * std::max(-speeds_[i], 0.0);
  }
  const bool anyMoves = std::any_of(contacts.begin(), contacts.end(),
                                    [](const JointContact& each) { return each.wallSpeed != 0.0; });
  double change = 0.0;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    change += bodies_[i].energy() - bodies[i].energy();
  // As seen from walls that move the approach ends at each contact.
  result.energyChange = anyMoves ? -0.5 * result.weight : std::min(change, 0.0);
  return result;
}

}  // namespace bumper
