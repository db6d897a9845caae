#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "c_world.h"

namespace bumper::tests {

/// Tries calls with arguments that must be refused: by an error whose message names the function
/// and the argument, and without any effect.
class CArguments : public testing::Test {
 protected:
  CArguments();
  ~CArguments() override;
  /// The world goes on as one in which nothing of that was called.
  void TearDown() override;

  static constexpr std::size_t hugeCount = std::numeric_limits<std::size_t>::max();

  using Settings = bumper_response_settings;
  template <typename Struct>
  using Call = std::function<int(const Struct*)>;

  static void expectRefused(const char* function, const std::string& argument, int answer,
                            int code = BUMPER_INVALID_ARGUMENT);

  /// Handles that name nothing, or nothing any more, or what another responder has.
  void refuseResponder(const char* function, const std::function<int(bumper_responder)>& call);
  void refuseVehicle(const char* function, const char* argument,
                     const std::function<int(bumper_vehicle)>& call);
  void refuseBarrier(const char* function, const std::function<int(bumper_barrier)>& call);
  void refuseState(const char* function, const std::function<int(bumper_state)>& call);

  /// What no number may be, and what this one may not.
  static void refuseNumber(const char* function, const std::string& argument,
                           const std::vector<double>& notAllowed,
                           const std::function<int(double)>& call);
  static void refuseEnumerator(const char* function, const std::string& argument, int count,
                               const std::function<int(std::int32_t)>& call);

  /// The same of a struct's member.
  template <typename Struct>
  static void refuseMember(const char* function, const std::string& argument, const Struct& valid,
                           double Struct::*member, const std::vector<double>& notAllowed,
                           const Call<Struct>& call) {
    refuseNumber(function, argument, notAllowed, [&](double value) {
      Struct changed = valid;
      changed.*member = value;
      return call(&changed);
    });
  }
  template <typename Struct>
  static void refuseMember(const char* function, const std::string& argument, const Struct& valid,
                           std::int32_t Struct::*member, int count, const Call<Struct>& call) {
    refuseEnumerator(function, argument, count, [&](std::int32_t value) {
      Struct changed = valid;
      changed.*member = value;
      return call(&changed);
    });
  }

  /// A direction: each of its numbers, and one that is not unit.
  template <typename Struct>
  static void refuseDirection(const char* function, const std::string& argument,
                              const Struct& valid, double (Struct::*member)[3],
                              const Call<Struct>& call) {
    for (std::size_t i = 0; i < 3; ++i) {
      refuseNumber(function, argument + '[' + std::to_string(i) + ']', {-3.0, 3.0},
                   [&](double value) {
                     Struct changed = valid;
                     (changed.*member)[i] = value;
                     return call(&changed);
                   });
    }
    Struct zero = valid;
    for (double& each : zero.*member) each = 0.0;
    expectRefused(function, "", call(&zero));
  }

  /// Sizes that a struct that is given cannot have, and members that the library does not know.
  template <typename Struct>
  static void refuseSizes(const char* function, const std::string& argument, const Struct& valid,
                          const Call<Struct>& call) {
    struct Longer {
      Struct known;
      std::uint64_t unknown[2];
    };
    Longer longer{.known = valid, .unknown = {}};
    for (const std::size_t size :
         {std::size_t{0}, std::size_t{1}, sizeof(Struct) - 8, sizeof(Struct) + 4, hugeCount}) {
      longer.known.size = size;
      expectRefused(function, argument, call(&longer.known));
    }
    longer.known.size = sizeof longer;
    longer.unknown[1] = 1;
    expectRefused(function, argument, call(&longer.known));
  }

  /// Sizes that a struct to be filled cannot have.
  template <typename Struct>
  static void refuseFilling(const char* function, const char* argument,
                            const std::function<int(Struct*)>& call) {
    expectRefused(function, argument, call(nullptr));
    for (const std::size_t size :
         {std::size_t{0}, sizeof(Struct) - 8, sizeof(Struct) + 4, hugeCount}) {
      Struct some{};
      some.size = size;
      expectRefused(function, argument, call(&some));
    }
  }

  /// All that may be wrong in what several calls take.
  void refuseSettings(const char* function, const std::string& argument,
                      const Call<Settings>& call);
  void refuseParameters(const char* function, const Call<bumper_vehicle_parameters>& call);

  CWorld world_;
  Settings settings_ = initialised(bumper_init_response_settings);

 private:
  void refuseCurve(const char* function, const std::string& argument,
                   bumper_angle_curve Settings::*curve, const Call<Settings>& call);

  bumper_responder next_{};  // in the place of one that was destroyed
  std::vector<bumper_responder> staleResponders_;
  std::vector<bumper_vehicle> staleVehicles_;
  std::vector<bumper_barrier> staleBarriers_;
  std::vector<bumper_state> staleStates_;
};

}  // namespace bumper::tests
