#include "bumper/response/response_settings.h"

#include <cmath>
#include <limits>
#include <sstream>

#include "bumper/response/error.h"

namespace bumper {

namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

void requireRange(double value, double low, double high, const char* name, const char* unit) {
  if (std::isfinite(value) && value >= low && value <= high) return;
  std::ostringstream message;
  message << "ResponseSettings::" << name << " is " << value << unit << ": it must ";
  if (std::isinf(high)) {
    message << "be finite and at least " << low << unit;
  } else {
    message << "lie in [" << low << ", " << high << "]";
  }
  throw Error(message.str());
}

void requireCurve(const AngleCurve& curve, double high, const char* name) {
  const auto [smallest, largest] = curve.range();
  requireRange(smallest, 0.0, high, name, "");
  requireRange(largest, 0.0, high, name, "");
}

}  // namespace

void validate(const ResponseSettings& settings) {
  requireCurve(settings.restitution, 1.0, "restitution");
  requireCurve(settings.friction,
               settings.frictionKind == Friction::Kind::coulomb ? unbounded : 1.0, "friction");
  if (settings.frictionKind == Friction::Kind::fraction_of_critical &&
      (settings.law == Law::energy || settings.method == Method::paper)) {
    throw Error(
        "ResponseSettings::frictionKind is fraction_of_critical: only the restitution law of "
        "Method::bumper knows it");
  }
  if (settings.restitutionKind == RestitutionKind::kudlich_slibar &&
      (settings.law == Law::energy || settings.method == Method::paper)) {
    throw Error(
        "ResponseSettings::restitutionKind is kudlich_slibar: only the restitution law of "
        "Method::bumper knows it");
  }
  requireCurve(settings.energyRemaining, 1.0, "energyRemaining");
  requireRange(settings.maxRestitution, 0.0, 1.0, "maxRestitution", "");
  requireRange(settings.penetrationTime, 0.0, unbounded, "penetrationTime", " s");
  requireRange(settings.smallestFeature, 0.0, unbounded, "smallestFeature", "");
  requireRange(settings.contactTime, 0.0, unbounded, "contactTime", " s");
  requireRange(settings.restSpeed, 0.0, unbounded, "restSpeed", " m/s");
}

}  // namespace bumper
