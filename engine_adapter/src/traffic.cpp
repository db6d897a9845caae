#include "traffic.h"

#include <algorithm>

#include "bumper/response/pair.h"
#include "guard_contacts.h"

namespace bumper {

namespace {

// By how much a vehicle may change its velocity until the next look: a part of its speed, and this
// more, m/s.
constexpr double shareAllowed = 0.05;
constexpr double speedAllowance = 0.5;

// Outlines nearer to each other than this, m, are compared as they lie, others as circles.
constexpr double nearby = 12.0;

// It is looked at again after this way at the latest, m, so that its cell is right to that.
constexpr double mostWay = 8.0;

// What one step may add to a motion beyond the limits, m: the acceleration allowed, at 20 ms.
constexpr double margin = 0.1;

// A speed, m/s, and a coordinate, m, beyond these are errors of the application's.
constexpr double mostSpeed = 1e4;
constexpr double farthest = 1e12;

// A vehicle hit by another may leave faster than that came: by its lightness and rebound.
constexpr double fasterAfterHit = 2.0;

// The gap that two may close in a step at these speeds or at those after a blow, m.
double reachOf(double closing, double h) {
  return guardDistance(0.5 * fasterAfterHit * closing, h);
}

// By how much a known force changes its speed in a step, m/s.
double pushOf(const Traveller& traveller, double h) {
  const double force = std::hypot(traveller.force[0], traveller.force[1]);
  const double change =
      h * Traffic::accelerationAllowed * force / std::max(traveller.forceAllowed, 1e-9);
  return change < mostSpeed ? change : mostSpeed;
}

Placement placementOf(const Traveller& traveller) {
  const double x = traveller.rotation[0];
  const double y = traveller.rotation[4];
  const double length = std::hypot(x, y);
  Placement at;
  at.cosine = x / length;
  at.sine = y / length;
  at.position =
      Vector2(traveller.position[0], traveller.position[1]) + at.turned(traveller.massCentre);
  return at;
}

double gapOf(const Traveller& one, const Traveller& other) {
  return separation(one.outline, placementOf(one), other.outline, placementOf(other)).distance;
}

}  // namespace

Traveller*& Traffic::bucketOf(long x, long y) {
  const auto mixed = static_cast<std::size_t>(x) * 0x9E3779B97F4A7C15U ^
                     static_cast<std::size_t>(y) * 0xC2B2AE3D27D4EB4FU;
  return buckets_[(mixed >> 32U) % bucketCount];
}

void Traffic::add(Traveller& traveller) {
  if (buckets_.empty()) buckets_.assign(bucketCount, nullptr);
  // All cells are as wide as the largest vehicle needs.
  const double needed = 4.0 * (traveller.radius + mostWay);
  if (needed > cell_) {
    cell_ = needed;
    for (Traveller*& first : buckets_) {
      for (Traveller* each = std::exchange(first, nullptr); each != nullptr;) {
        Traveller* const next = each->next;
        each->isListed = false;
        each->forget();
        each = next;
      }
    }
  }
  traveller.forget();
}

void Traffic::remove(Traveller& traveller) {
  unlist(traveller);
  std::erase_if(pairs_, [&](const Pair& pair) {
    return pair.first == &traveller || pair.second == &traveller;
  });
}

void Traffic::unlist(Traveller& traveller) {
  if (!traveller.isListed) return;
  *traveller.link = traveller.next;
  if (traveller.next != nullptr) traveller.next->link = traveller.link;
  traveller.isListed = false;
}

void Traffic::place(Traveller& traveller) {
  const auto cellOf = [&](double value) {
    return std::abs(value) < farthest ? std::lround(std::floor(value / cell_)) : 0L;
  };
  const long x = cellOf(traveller.x);
  const long y = cellOf(traveller.y);
  if (traveller.isListed && x == traveller.cellX && y == traveller.cellY) return;
  unlist(traveller);
  traveller.cellX = x;
  traveller.cellY = y;
  Traveller*& first = bucketOf(x, y);
  traveller.next = first;
  traveller.link = &first;
  if (first != nullptr) first->link = &traveller.next;
  first = &traveller;
  traveller.isListed = true;
}

void Traffic::refresh(Traveller& traveller, double now, double h) {
  traveller.x = traveller.position[0];
  traveller.y = traveller.position[1];
  traveller.looked = now;
  traveller.velocityX = traveller.velocity[0];
  traveller.velocityY = traveller.velocity[1];
  traveller.yawRate = traveller.turning[2];
  const double speed = std::min(std::hypot(traveller.velocityX, traveller.velocityY), mostSpeed);
  traveller.allowance = shareAllowed * speed + speedAllowance;
  traveller.companySpeed = speed + traveller.allowance + pushOf(traveller, h);
  traveller.apartUntil = now + mostWay / traveller.companySpeed;
  place(traveller);
}

void Traffic::enqueue(Traveller& traveller) {
  if (traveller.isQueued) return;
  traveller.isQueued = true;
  queue_.push_back(&traveller);
}

// The time that two need not be looked at; or, if they may meet in this step, that they may, and
// that the faster one may set the other moving.
void Traffic::meet(Traveller& one, Traveller& other, double now, double h) {
  const double x = one.position[0] - other.position[0];
  const double y = one.position[1] - other.position[1];
  const double circles = std::hypot(x, y) - one.radius - other.radius;
  const double gap = (circles < nearby ? std::max(circles, gapOf(one, other)) : circles) - margin;
  const double spins = (std::abs(one.yawRate) + turningAllowance) * one.radius +
                       (std::abs(other.yawRate) + turningAllowance) * other.radius;
  const double closing =
      std::hypot(one.velocityX - other.velocityX, one.velocityY - other.velocityY) + one.allowance +
      other.allowance + spins;
  const double until = now + std::max(gap, 0.0) / closing;
  one.apartUntil = std::min(one.apartUntil, until);
  other.apartUntil = std::min(other.apartUntil, until);
  const double company = std::max(one.companySpeed, other.companySpeed);
  if (gap > reachOf(one.companySpeed + other.companySpeed, h)) return;
  Traveller* const low = std::min(&one, &other);
  pairs_.emplace_back(low, low == &one ? &other : &one);
  for (Traveller* each : {&one, &other}) {
    if (each->companySpeed < company) {
      each->companySpeed = company;
      enqueue(*each);
    }
  }
}

void Traffic::look(std::span<Traveller* const> some, double now, double h) {
  for (const Pair& pair : pairs_) {
    pair.first->companySpeed = pair.second->companySpeed = 0.0;
  }
  pairs_.clear();
  queue_.clear();
  for (Traveller* each : some) {
    refresh(*each, now, h);
    enqueue(*each);
  }
  // It grows meanwhile.
  for (std::size_t next = 0; next < queue_.size();) {
    Traveller& one = *queue_[next++];
    one.isQueued = false;
    const double reach = reachOf(2.0 * one.companySpeed, h);
    const long rings = 1 + static_cast<long>(std::min(2.0 * reach / cell_, 8.0));
    for (long x = one.cellX - rings; x <= one.cellX + rings; ++x) {
      for (long y = one.cellY - rings; y <= one.cellY + rings; ++y) {
        for (Traveller* other = bucketOf(x, y); other != nullptr; other = other->next) {
          if (other == &one || other->cellX != x || other->cellY != y) continue;
          // Its company is that of this step.
          other->companySpeed =
              std::max(other->companySpeed,
                       std::hypot(other->velocityX, other->velocityY) + other->allowance);
          meet(one, *other, now, h);
        }
      }
    }
  }
  std::sort(pairs_.begin(), pairs_.end());
  pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
}

}  // namespace bumper
