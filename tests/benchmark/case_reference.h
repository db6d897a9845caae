#pragma once

#include "impact_cases.h"

namespace bumper::benchmark {

enum class Setting { free_flight, tyres };
const char* nameOf(Setting setting);

/// A case's exact outcome, and what it says about the case.
struct CaseReference {
  /// s; the first multiple of 20 ms from 0.4 s on with no impact in its last 20 ms, so that every
  /// pulse has run out; 0.5 s if there is none.
  double duration = 0.0;
  Flight flight;
  bool sensitive = false;  ///< free flight: another number of impacts if the start moves by 1e-10 m
};

CaseReference referenceOf(const ImpactCase& impactCase, Setting setting);

/// The step of the reference with tyres, s.
inline constexpr double tyreReferenceStep = 2e-4;

/// Steps that every scheme is run with, s; all divide 20 ms.
inline constexpr double stepSizes[] = {0.020, 0.010, 0.005, 0.002, 0.001, 0.0005};

/// How far a run's end is from the reference's.
struct EndError {
  double deltaV = 0.0;    ///< of the velocity's change since the start, relative
  double yawRate = 0.0;   ///< rad/s
  double position = 0.0;  ///< m
};
EndError errorOf(const ImpactCase& impactCase, const CaseReference& reference,
                 const PlanarMotion& end);

}  // namespace bumper::benchmark
