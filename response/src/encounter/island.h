#pragma once

#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include "../pair/joint_approach.h"
#include "../pair/pair_contact.h"
#include "bumper/response/island_step.h"
#include "bumper/response/pair.h"
#include "encounter.h"

namespace bumper {

/// Several encounters on one timeline, and the pairs of them that may touch: see IslandStep. Each
/// vehicle is advanced only when something happens to it.
class BUMPER_HIDDEN Island {
 public:
  void resolve(std::span<const IslandMember> members, std::span<const IslandPair> pairs, double h);
  [[nodiscard]] StepOutcome outcome(std::size_t member) const;
  [[nodiscard]] std::span<const PairImpact> pairImpacts() const { return impacts_; }
  std::span<const SpeculativeContact> speculativeContacts(std::size_t member,
                                                          const PlanarMotion& motion,
                                                          const PlanarMotion& after,
                                                          double distance, double h);

 private:
  struct Member {
    std::unique_ptr<Encounter> encounter = std::make_unique<Encounter>();
    Vector2 eased = Vector2::Zero();  // out of other vehicles, m/s
    PlanarImpulse impulse;            // of the pairs
    double next = 0.0;                // when its walls are looked at next
    bool involved = false;            // at this instant
    bool changed = false;             // … and it has not been settled since

    [[nodiscard]] const PlanarBody& body() const { return encounter->participant().body; }
  };

  struct Pair {
    IslandPair given;
    double next = 0.0;          // when it is looked at next
    double ignoredUntil = 0.0;  // touches before this time were looked at, to no effect
    int answers = 0;            // at this instant
    // Where it is now, if known.
    bool known = false;
    bool touches = false;
    PairSeparation apart;
    PairContact contact;

    [[nodiscard]] double depth() const { return std::max(-apart.distance, 0.0); }
    [[nodiscard]] bool isOf(int member) const {
      return given.first == member || given.second == member;
    }
  };

  // What an impulse of many together acts on: a pair, beside its contact point by so much, m; or a
  // wall of a member, its number among the points that it touches.
  struct Owner {
    int pair = -1;
    Vector2 aside = Vector2::Zero();
    int member = -1;
    std::size_t wall = 0;
  };

  [[nodiscard]] Member& member(int number) { return members_[static_cast<std::size_t>(number)]; }
  [[nodiscard]] const Member& member(int number) const {
    return members_[static_cast<std::size_t>(number)];
  }
  [[nodiscard]] PairBody bodyOf(int number, const PairFrame& frame, double time) const;
  [[nodiscard]] PairBody firstOf(const Pair& pair, double time) const {
    return bodyOf(pair.given.first, pair.given.firstFrame, time);
  }
  [[nodiscard]] PairBody secondOf(const Pair& pair, double time) const {
    return bodyOf(pair.given.second, pair.given.secondFrame, time);
  }
  [[nodiscard]] bool isHeld(const Pair& pair) const;
  [[nodiscard]] bool isInvolved(const Pair& pair) const {
    return member(pair.given.first).involved || member(pair.given.second).involved;
  }
  [[nodiscard]] int numberOf(const Pair& pair) const {
    return static_cast<int>(&pair - pairs_.data());
  }

  void begin(std::span<const IslandMember> members, std::span<const IslandPair> pairs, double h);
  void easeApart();
  void look(Pair& pair, double time);
  [[nodiscard]] double nextLook(const Pair& pair, double time) const;
  void involve(int number, double time);
  void settle(double time);
  void settleWalls(int answers);
  Pair* fastestPair(double time);
  void answer(Pair& pair, double time);
  void push(int number, const PlanarImpulse& impulse);
  void act(const PairImpact& impact);
  void involveTouching(double time);
  void collectContacts();
  void answerTogether(double time);
  void forgetInstant(double time);

  std::vector<Member> members_;  // the first memberCount_ of them; the others are kept for later
  std::size_t memberCount_ = 0;
  std::vector<Pair> pairs_;
  std::vector<PairImpact> impacts_;
  double step_ = 0.0;
  int answers_ = 0;  // in this step

  JointApproach joint_;
  std::vector<PlanarBody> jointBodies_;
  std::vector<JointContact> jointContacts_;
  std::vector<Owner> owners_;
};

}  // namespace bumper
