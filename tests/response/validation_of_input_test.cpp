#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <string>

#include "bumper/response/error.h"
#include "bumper/response/impact_event.h"
#include "bumper/response/response_settings.h"
#include "bumper/response/vehicle_parameters.h"

namespace bumper::tests {
namespace {

using testing::HasSubstr;

const double nan = std::numeric_limits<double>::quiet_NaN();
const double infinity = std::numeric_limits<double>::infinity();

template <typename Settings>
std::string complaint(const Settings& settings) {
  try {
    validate(settings);
  } catch (const Error& error) {
    return error.what();
  }
  return "no complaint";
}

VehicleParameters goodVehicle() {
  return {.mass = 1500.0,
          .yawInertia = 2600.0,
          .massCentreToFront = 2.1,
          .massCentreToRear = 2.5,
          .width = 1.8,
          .massCentreHeight = 0.55};
}

TEST(VehicleParameters, EveryBadValueIsNamed) {
  EXPECT_NO_THROW(validate(goodVehicle()));
  const std::pair<double VehicleParameters::*, const char*> fields[] = {
      {&VehicleParameters::mass, "mass"},
      {&VehicleParameters::yawInertia, "yawInertia"},
      {&VehicleParameters::massCentreToFront, "massCentreToFront"},
      {&VehicleParameters::massCentreToRear, "massCentreToRear"},
      {&VehicleParameters::width, "width"},
      {&VehicleParameters::massCentreHeight, "massCentreHeight"}};
  for (const auto& [field, name] : fields) {
    for (const double bad : {0.0, -1.0, nan, infinity, -infinity}) {
      VehicleParameters vehicle = goodVehicle();
      vehicle.*field = bad;
      EXPECT_THAT(complaint(vehicle), HasSubstr(name)) << bad;
    }
  }
}

TEST(ResponseSettings, DefaultsAreThePapers) {
  const ResponseSettings settings;
  EXPECT_NO_THROW(validate(settings));
  EXPECT_EQ(settings.restitution(0.0), 0.3);
  EXPECT_EQ(settings.friction(0.0), 0.3);
  EXPECT_EQ(settings.energyRemaining(0.0), 0.92);
}

TEST(ResponseSettings, EveryBadValueIsNamed) {
  const auto with = [](auto change) {
    ResponseSettings settings;
    settings.law = Law::energy;  // so that every value is in use
    change(settings);
    return complaint(settings);
  };
  for (const double bad : {-0.01, 1.01}) {
    EXPECT_THAT(with([&](auto& s) { s.restitution = AngleCurve::constant(bad); }),
                HasSubstr("restitution"));
    EXPECT_THAT(with([&](auto& s) { s.restitution = AngleCurve::cosine(0.3, bad); }),
                HasSubstr("restitution"));
    EXPECT_THAT(with([&](auto& s) { s.energyRemaining = AngleCurve::constant(bad); }),
                HasSubstr("energyRemaining"));
    EXPECT_THAT(with([&](auto& s) { s.maxRestitution = bad; }), HasSubstr("maxRestitution"));
  }
  for (const double bad : {nan, infinity, -infinity}) {
    EXPECT_THAT(with([&](auto& s) { s.maxRestitution = bad; }), HasSubstr("maxRestitution"));
    EXPECT_THAT(with([&](auto& s) { s.penetrationTime = bad; }), HasSubstr("penetrationTime"));
    EXPECT_THAT(with([&](auto& s) { s.restSpeed = bad; }), HasSubstr("restSpeed"));
  }
  EXPECT_THAT(with([](auto& s) { s.friction = AngleCurve::constant(-0.1); }),
              HasSubstr("friction"));
  EXPECT_THAT(with([](auto& s) { s.penetrationTime = -1e-6; }), HasSubstr("penetrationTime"));
  EXPECT_THAT(with([](auto& s) { s.restSpeed = -1e-6; }), HasSubstr("restSpeed"));
  EXPECT_EQ(with([](auto& s) { s.friction = AngleCurve::constant(3.0); }), "no complaint");
  EXPECT_THAT(with([](auto& s) { s.frictionKind = Friction::Kind::fraction_of_critical; }),
              HasSubstr("frictionKind"));
  EXPECT_THAT(with([](auto& s) {
                s.law = Law::restitution;
                s.frictionKind = Friction::Kind::fraction_of_critical;
                s.friction = AngleCurve::constant(1.1);
              }),
              HasSubstr("friction"));
  EXPECT_EQ(with([](auto& s) {
              s.law = Law::restitution;
              s.frictionKind = Friction::Kind::fraction_of_critical;
              s.friction = AngleCurve::constant(1.0);
              s.penetrationTime = 0.0;
              s.restSpeed = 0.0;
              s.maxRestitution = 1.0;
            }),
            "no complaint");
}

TEST(Words, AreDistinctAndNeverEmpty) {
  std::set<std::string_view> words;
  const auto add = [&](std::string_view word) {
    EXPECT_FALSE(word.empty());
    EXPECT_TRUE(words.insert(word).second) << word;
  };
  for (const Law law : {Law::restitution, Law::energy}) add(toString(law));
  for (const Regime regime :
       {Regime::separating, Regime::sliding, Regime::sticking, Regime::reverse_slip}) {
    add(toString(regime));
  }
  for (const EnergyOutcome outcome :
       {EnergyOutcome::not_asked, EnergyOutcome::met, EnergyOutcome::limited_by_restitution,
        EnergyOutcome::limited_by_friction, EnergyOutcome::below_reach,
        EnergyOutcome::no_break_through}) {
    add(toString(outcome));
  }
  add(toString(EventPhase::impact));
}

}  // namespace
}  // namespace bumper::tests
