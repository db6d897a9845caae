#pragma once

#include <type_traits>

#include "bumper/engine_adapter/c_api.h"
#include "bumper/engine_adapter/responder.h"

/// The enumerations, whose numbers are the same in C as in C++.
namespace bumper::c_api {

/// How many enumerators one has, counted from 0; 0: it is none of the interface.
template <typename E>
inline constexpr int countOf = 0;

template <typename E>
concept Enumeration = countOf<E> >
0;

template <typename E>
constexpr bool isSame(int c, E cpp) {
  return c == static_cast<int>(cpp);
}

template <>
inline constexpr int countOf<Method> = 2;
static_assert(isSame(BUMPER_METHOD_BUMPER, Method::bumper) &&
              isSame(BUMPER_METHOD_PAPER, Method::paper));

template <>
inline constexpr int countOf<Law> = 2;
static_assert(isSame(BUMPER_LAW_RESTITUTION, Law::restitution) &&
              isSame(BUMPER_LAW_ENERGY, Law::energy));

template <>
inline constexpr int countOf<AngleDefinition> = 3;
static_assert(isSame(BUMPER_ANGLE_CONTACT_VELOCITY, AngleDefinition::contact_velocity) &&
              isSame(BUMPER_ANGLE_CENTRE_VELOCITY, AngleDefinition::centre_velocity) &&
              isSame(BUMPER_ANGLE_HEADING, AngleDefinition::heading));

template <>
inline constexpr int countOf<RestitutionKind> = 2;
static_assert(isSame(BUMPER_RESTITUTION_NEWTON, RestitutionKind::newton) &&
              isSame(BUMPER_RESTITUTION_KUDLICH_SLIBAR, RestitutionKind::kudlich_slibar));

template <>
inline constexpr int countOf<Friction::Kind> = 2;
static_assert(isSame(BUMPER_FRICTION_COULOMB, Friction::Kind::coulomb) &&
              isSame(BUMPER_FRICTION_FRACTION_OF_CRITICAL, Friction::Kind::fraction_of_critical));

template <>
inline constexpr int countOf<EnergyRoot> = 2;
static_assert(isSame(BUMPER_ENERGY_REBOUND, EnergyRoot::rebound) &&
              isSame(BUMPER_ENERGY_BREAK_THROUGH, EnergyRoot::break_through));

template <>
inline constexpr int countOf<Delivery> = 2;
static_assert(isSame(BUMPER_DELIVERY_FORCE_PULSE, Delivery::force_pulse) &&
              isSame(BUMPER_DELIVERY_STATE_RESET, Delivery::state_reset));

template <>
inline constexpr int countOf<Mover> = 3;
static_assert(isSame(BUMPER_MOVER_WORLD, Mover::world) &&
              isSame(BUMPER_MOVER_APPLICATION, Mover::application) &&
              isSame(BUMPER_MOVER_OTHER_HOST, Mover::other_host));

template <>
inline constexpr int countOf<EventPhase> = 3;
static_assert(isSame(BUMPER_PHASE_IMPACT, EventPhase::impact) &&
              isSame(BUMPER_PHASE_CONTACT_BEGIN, EventPhase::contact_begin) &&
              isSame(BUMPER_PHASE_CONTACT_END, EventPhase::contact_end));

template <>
inline constexpr int countOf<EnergyOutcome> = 6;
static_assert(isSame(BUMPER_OUTCOME_NOT_ASKED, EnergyOutcome::not_asked) &&
              isSame(BUMPER_OUTCOME_MET, EnergyOutcome::met) &&
              isSame(BUMPER_OUTCOME_LIMITED_BY_RESTITUTION,
                     EnergyOutcome::limited_by_restitution) &&
              isSame(BUMPER_OUTCOME_LIMITED_BY_FRICTION, EnergyOutcome::limited_by_friction) &&
              isSame(BUMPER_OUTCOME_BELOW_REACH, EnergyOutcome::below_reach) &&
              isSame(BUMPER_OUTCOME_NO_BREAK_THROUGH, EnergyOutcome::no_break_through));

template <>
inline constexpr int countOf<Regime> = 4;
static_assert(isSame(BUMPER_REGIME_SEPARATING, Regime::separating) &&
              isSame(BUMPER_REGIME_SLIDING, Regime::sliding) &&
              isSame(BUMPER_REGIME_STICKING, Regime::sticking) &&
              isSame(BUMPER_REGIME_REVERSE_SLIP, Regime::reverse_slip));

static_assert(BUMPER_ISSUE_INVALID_STEP == step_issue::invalid_step &&
              BUMPER_ISSUE_NOT_FINITE == step_issue::not_finite &&
              BUMPER_ISSUE_TILTED == step_issue::tilted &&
              BUMPER_ISSUE_UNSETTLED == step_issue::unsettled &&
              BUMPER_ISSUE_REPEATED_STEP == step_issue::repeated_step &&
              BUMPER_ISSUE_OTHER_STEP_SIZE == step_issue::other_step_size &&
              BUMPER_ISSUE_MOVED == step_issue::moved &&
              BUMPER_ISSUE_KINEMATIC == step_issue::kinematic);

}  // namespace bumper::c_api
