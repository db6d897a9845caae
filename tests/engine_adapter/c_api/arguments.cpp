#include "arguments.h"

#include <cmath>

namespace bumper::tests {

CArguments::CArguments() {
  bumper_responder gone{};
  bumper_vehicle ofGone{};
  bumper_vehicle removed{};
  bumper_barrier barrierOfGone{};
  bumper_barrier removedBarrier{};
  bumper_state destroyed{};
  BoxCar another(world_.ode.world);
  const bumper_vehicle_parameters parameters = inC(another.parameters);
  const bumper_scene* scene = &world_.wall.scene;
  const auto must = [](int answer) { EXPECT_EQ(answer, BUMPER_OK) << bumper_last_error(); };
  must(bumper_create_responder(world_.ode.world, nullptr, &gone));
  must(bumper_add_vehicle(gone, another.body, &parameters, nullptr, &ofGone));
  must(bumper_add_scene(gone, scene, nullptr, &barrierOfGone));
  must(bumper_save(gone, &destroyed));
  must(bumper_destroy_state(destroyed));
  must(bumper_destroy_responder(gone));
  must(bumper_create_responder(world_.ode.world, nullptr, &next_));
  must(bumper_add_vehicle(world_.responder, another.body, &parameters, nullptr, &removed));
  must(bumper_remove_vehicle(world_.responder, removed));
  must(bumper_add_scene(world_.responder, scene, nullptr, &removedBarrier));
  must(bumper_remove_barrier(world_.responder, removedBarrier));

  constexpr std::uint64_t allBits = std::numeric_limits<std::uint64_t>::max();
  staleResponders_ = {{0}, {1}, {65535}, {65537}, {allBits}, gone, {gone.value + (1U << 30U)}};
  staleVehicles_ = {{0}, {1}, {allBits}, removed, ofGone, {world_.vehicle.value + 1000}};
  staleBarriers_ = {
      {0}, {1}, {allBits}, removedBarrier, barrierOfGone, {world_.barrier.value + 1000}};
  staleStates_ = {{0}, {1}, {allBits}, destroyed};
}

CArguments::~CArguments() { bumper_destroy_responder(next_); }

void CArguments::TearDown() {
  CWorld untouched;
  for (int i = 0; i < 120; ++i) {
    ASSERT_EQ(world_.step(), untouched.step());
    ASSERT_EQ(world_.car.velocity(), untouched.car.velocity());
    ASSERT_EQ(world_.other.angularVelocity(), untouched.other.angularVelocity());
  }
  EXPECT_LT(world_.car.velocity().x(), 10.0) << "nothing was hit";
}

void CArguments::expectRefused(const char* function, const std::string& argument, int answer,
                               int code) {
  const std::string message = bumper_last_error();
  EXPECT_EQ(answer, code) << function << ", " << argument << ": " << message;
  const std::string beginning = std::string(function) + ": ";
  EXPECT_TRUE(message.starts_with(beginning)) << message;
  EXPECT_NE(message.find(argument, beginning.size()), std::string::npos)
      << argument << " is not named: " << message;
}

void CArguments::refuseResponder(const char* function,
                                 const std::function<int(bumper_responder)>& call) {
  for (const bumper_responder each : staleResponders_) {
    expectRefused(function, "responder", call(each), BUMPER_STALE_HANDLE);
  }
}

void CArguments::refuseVehicle(const char* function, const char* argument,
                               const std::function<int(bumper_vehicle)>& call) {
  for (const bumper_vehicle each : staleVehicles_) {
    expectRefused(function, argument, call(each), BUMPER_STALE_HANDLE);
  }
}

void CArguments::refuseBarrier(const char* function,
                               const std::function<int(bumper_barrier)>& call) {
  for (const bumper_barrier each : staleBarriers_) {
    expectRefused(function, "barrier", call(each), BUMPER_STALE_HANDLE);
  }
}

void CArguments::refuseState(const char* function, const std::function<int(bumper_state)>& call) {
  for (const bumper_state each : staleStates_) {
    expectRefused(function, "state", call(each), BUMPER_STALE_HANDLE);
  }
}

void CArguments::refuseNumber(const char* function, const std::string& argument,
                              const std::vector<double>& notAllowed,
                              const std::function<int(double)>& call) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();
  for (const double value : {notANumber, -notANumber, infinity, -infinity, 2e15, -2e15,
                             std::numeric_limits<double>::max()}) {
    SCOPED_TRACE(value);
    expectRefused(function, argument, call(value));
  }
  // The library looks at ranges itself, and says in its own words which value is meant.
  for (const double value : notAllowed) {
    SCOPED_TRACE(value);
    expectRefused(function, "", call(value));
  }
}

void CArguments::refuseEnumerator(const char* function, const std::string& argument, int count,
                                  const std::function<int(std::int32_t)>& call) {
  for (const std::int32_t value : {-1, count, std::numeric_limits<std::int32_t>::max(),
                                   std::numeric_limits<std::int32_t>::min()}) {
    SCOPED_TRACE(value);
    expectRefused(function, argument, call(value));
  }
}

void CArguments::refuseCurve(const char* function, const std::string& argument,
                             bumper_angle_curve Settings::*curve, const Call<Settings>& call) {
  const Call<bumper_angle_curve> with = [&](const bumper_angle_curve* changed) {
    Settings settings = settings_;
    settings.*curve = *changed;
    return call(&settings);
  };
  const bumper_angle_curve valid = settings_.*curve;
  refuseMember(function, argument + ".shape", valid, &bumper_angle_curve::shape, 3, with);
  refuseMember(function, argument + ".grazing", valid, &bumper_angle_curve::grazing, {-0.1}, with);
  refuseMember(function, argument + ".head_on", valid, &bumper_angle_curve::head_on, {-0.1}, with);

  bumper_angle_curve changed = valid;
  changed.point_count = 1;
  expectRefused(function, argument + ".point_count", with(&changed));
  changed.shape = BUMPER_CURVE_TABLE;
  expectRefused(function, argument + ".points", with(&changed));
  const double points[] = {0.2, 0.1, 0.1, 0.1};
  changed.points = points;
  changed.point_count = 0;
  expectRefused(function, "point", with(&changed));
  changed.point_count = 2;
  expectRefused(function, "point", with(&changed));
  changed.point_count = std::numeric_limits<std::uint32_t>::max();
  expectRefused(function, argument + ".points", with(&changed));
  refuseNumber(function, argument + ".points[1]", {-0.1}, [&](double value) {
    const double one[] = {0.1, value};
    changed.points = one;
    changed.point_count = 1;
    return with(&changed);
  });
}

void CArguments::refuseSettings(const char* function, const std::string& argument,
                                const Call<Settings>& call) {
  const auto member = [&](const char* name, auto which, const auto& notAllowed) {
    refuseMember<Settings>(function, argument + '.' + name, settings_, which, notAllowed, call);
  };
  using Numbers = std::vector<double>;
  refuseSizes<Settings>(function, argument, settings_, call);
  member("method", &Settings::method, 2);
  member("law", &Settings::law, 2);
  member("angle", &Settings::angle, 3);
  member("restitution_kind", &Settings::restitution_kind, 2);
  member("friction_kind", &Settings::friction_kind, 2);
  member("energy_root", &Settings::energy_root, 2);
  refuseCurve(function, argument + ".restitution", &Settings::restitution, call);
  refuseCurve(function, argument + ".friction", &Settings::friction, call);
  refuseCurve(function, argument + ".energy_remaining", &Settings::energy_remaining, call);
  member("max_restitution", &Settings::max_restitution, Numbers{-0.1, 1.1});
  member("penetration_time", &Settings::penetration_time, Numbers{-1e-3});
  member("smallest_feature", &Settings::smallest_feature, Numbers{-1e-3});
  member("contact_time", &Settings::contact_time, Numbers{-1e-3});
  member("rest_speed", &Settings::rest_speed, Numbers{-1e-3});
}

void CArguments::refuseParameters(const char* function,
                                  const Call<bumper_vehicle_parameters>& call) {
  using Parameters = bumper_vehicle_parameters;
  const Parameters valid = inC(world_.car.parameters);
  expectRefused(function, "parameters", call(nullptr));
  refuseSizes<Parameters>(function, "parameters", valid, call);
  const auto member = [&](const char* name, double Parameters::*which) {
    refuseMember<Parameters>(function, std::string("parameters.") + name, valid, which,
                             {0.0, -0.0, -1.0}, call);
  };
  member("mass", &Parameters::mass);
  member("yaw_inertia", &Parameters::yaw_inertia);
  member("mass_centre_to_front", &Parameters::mass_centre_to_front);
  member("mass_centre_to_rear", &Parameters::mass_centre_to_rear);
  member("width", &Parameters::width);
  member("mass_centre_height", &Parameters::mass_centre_height);
}

}  // namespace bumper::tests
