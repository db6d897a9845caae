#include "bumper/response/impact_event.h"

namespace bumper {

std::string_view toString(EventPhase phase) {
  switch (phase) {
    case EventPhase::impact:
      return "impact";
    case EventPhase::contact_begin:
      return "contact_begin";
    case EventPhase::contact_end:
      return "contact_end";
  }
  return "unknown";
}

std::string_view toString(Law law) {
  switch (law) {
    case Law::restitution:
      return "restitution";
    case Law::energy:
      return "energy";
  }
  return "unknown";
}

std::string_view toString(Regime regime) {
  switch (regime) {
    case Regime::separating:
      return "separating";
    case Regime::sliding:
      return "sliding";
    case Regime::sticking:
      return "sticking";
    case Regime::reverse_slip:
      return "reverse_slip";
  }
  return "unknown";
}

std::string_view toString(EnergyOutcome outcome) {
  switch (outcome) {
    case EnergyOutcome::not_asked:
      return "not_asked";
    case EnergyOutcome::met:
      return "met";
    case EnergyOutcome::limited_by_restitution:
      return "limited_by_restitution";
    case EnergyOutcome::limited_by_friction:
      return "limited_by_friction";
    case EnergyOutcome::below_reach:
      return "below_reach";
    case EnergyOutcome::no_break_through:
      return "no_break_through";
  }
  return "unknown";
}

}  // namespace bumper
