#pragma once

#include <memory>
#include <span>
#include <vector>

#include "../pair/joint_approach.h"
#include "../pair/pair_contact.h"
#include "bumper/response/island_step.h"
#include "encounter.h"

namespace bumper {

/// Several encounters on one timeline, and the pairs of them that may touch: see IslandStep. Each
/// vehicle is advanced only when something happens to it.
class Island {
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
    double distance = 0.0;  // m
    double depth = 0.0;
    PairContact contact;
  };

  [[nodiscard]] Member& member(int number) { return members_[static_cast<std::size_t>(number)]; }
  [[nodiscard]] const Member& member(int number) const {
    return members_[static_cast<std::size_t>(number)];
  }
  [[nodiscard]] PairBody bodyOf(int number, const PairFrame& frame, double time) const;
  [[nodiscard]] bool isHeld(const Pair& pair) const;

  void begin(std::span<const IslandMember> members, std::span<const IslandPair> pairs, double h);
  void easeApart();
  void look(Pair& pair, double time);
  [[nodiscard]] double nextLook(const Pair& pair, double time) const;
  void involve(int number, double time);
  void settle(double time);
  void settleWalls(int answers);
  Pair* fastestPair(double time);
  void answer(Pair& pair, double time, Rebound rebound);
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
  struct Owner {
    int pair = -1;    // or …
    int member = -1;  // … a wall of this one, its contact's number among
    std::size_t wall = 0;
    Vector2 aside = Vector2::Zero();  // of the pair's contact point, m
  };
  std::vector<Owner> owners_;
};

}  // namespace bumper
