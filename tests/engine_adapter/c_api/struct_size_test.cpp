// Structs of callers with an older or a newer header, by the rule itself: there is one version yet.

#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>
#include <string>

#include "c_api/fields.h"
#include "c_world.h"

namespace bumper::c_api {

// Two members were added to it since the first release.
struct Grown {
  std::size_t size;
  double first;
  double second;
  double third;
};

template <>
struct Layout<Grown> {
  static constexpr std::size_t firstSize = offsetof(Grown, first) + sizeof(double);
};

}  // namespace bumper::c_api

namespace bumper::tests {
namespace {

using c_api::Grown;

constexpr Grown defaults{.size = sizeof(Grown), .first = 1.0, .second = 2.0, .third = 3.0};

std::string errorOf(const auto& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(CStructs, OfAnOlderCallerAreCompletedByDefaults) {
  for (const std::size_t size : {std::size_t{16}, std::size_t{24}, std::size_t{32}}) {
    const Grown given{.size = size, .first = 10.0, .second = 20.0, .third = 30.0};
    const Grown read = c_api::completed({"grown"}, given, defaults);
    EXPECT_EQ(read.first, 10.0);
    EXPECT_EQ(read.second, size >= 24 ? 20.0 : 2.0);
    EXPECT_EQ(read.third, size >= 32 ? 30.0 : 3.0);
  }
}

TEST(CStructs, OfAnOlderCallerAreFilledUpToTheirEnd) {
  Grown target{.size = 0, .first = 0.0, .second = -1.0, .third = -1.0};
  c_api::fill({"grown"}, target, 16, defaults);
  EXPECT_EQ(target.size, 16U);
  EXPECT_EQ(target.first, 1.0);
  EXPECT_EQ(target.second, -1.0) << "written behind the struct's end";
}

TEST(CStructs, OfANewerCallerMayNotSayWhatIsNotKnown) {
  struct Newer {
    Grown known;
    double fourth;
  } newer{.known = defaults, .fourth = 0.0};
  newer.known.size = sizeof newer;
  newer.known.third = 5.0;
  EXPECT_EQ(c_api::completed({"grown"}, newer.known, defaults).third, 5.0);
  newer.fourth = 4.0;
  EXPECT_NE(errorOf([&] { c_api::completed({"grown"}, newer.known, defaults); }).find("grown"),
            std::string::npos);
  // … and gets 0 there.
  c_api::fill({"grown"}, newer.known, sizeof newer, defaults);
  EXPECT_EQ(newer.fourth, 0.0);
  EXPECT_EQ(newer.known.size, sizeof newer);
}

TEST(CStructs, WithASizeThatNoneHasAreRefused) {
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{8}, std::size_t{20}, ~std::size_t{0}}) {
    Grown given = defaults;
    given.size = size;
    EXPECT_NE(errorOf([&] { c_api::completed({"grown"}, given, defaults); }).find("size"),
              std::string::npos);
  }
}

// A caller that was compiled with the next release's header.
TEST(CStructs, OfANewerCallerWork) {
  struct {
    bumper_vehicle_parameters known;
    double added;
  } parameters;
  ASSERT_EQ(bumper_init_vehicle_parameters(&parameters.known, sizeof parameters), BUMPER_OK);
  EXPECT_EQ(parameters.added, 0.0);
  EXPECT_EQ(parameters.known.size, sizeof parameters);
  CWorld world;
  ASSERT_EQ(bumper_parameters_from_bodies(world.car.body, nullptr, 2.1, 2.5, 1.8, 0.55,
                                          &parameters.known),
            BUMPER_OK);
  ASSERT_EQ(bumper_remove_vehicle(world.responder, world.vehicle), BUMPER_OK);
  EXPECT_EQ(bumper_add_vehicle(world.responder, world.car.body, &parameters.known, nullptr,
                               &world.vehicle),
            BUMPER_OK)
      << bumper_last_error();
}

template <typename C>
void expectDefaultsAreThoseOfCpp(int (*initialise)(C*, std::size_t)) {
  C filled;
  std::memset(&filled, 0xFF, sizeof filled);
  ASSERT_EQ(initialise(&filled, sizeof filled), BUMPER_OK);
  const C expected = c_api::inC<C>();
  EXPECT_EQ(std::memcmp(&filled, &expected, sizeof filled), 0);
}

TEST(CStructs, AreWhollyInitialised) {
  expectDefaultsAreThoseOfCpp(bumper_init_response_settings);
  expectDefaultsAreThoseOfCpp(bumper_init_responder_options);
  expectDefaultsAreThoseOfCpp(bumper_init_wall_selection);
  expectDefaultsAreThoseOfCpp(bumper_init_barrier_options);
  expectDefaultsAreThoseOfCpp(bumper_init_scene);
  expectDefaultsAreThoseOfCpp(bumper_init_wall_report);
  expectDefaultsAreThoseOfCpp(bumper_init_vehicle_parameters);
  expectDefaultsAreThoseOfCpp(bumper_init_vehicle_options);
  expectDefaultsAreThoseOfCpp(bumper_init_pair_options);
  expectDefaultsAreThoseOfCpp(bumper_init_motion);
  expectDefaultsAreThoseOfCpp(bumper_init_event);
}

}  // namespace
}  // namespace bumper::tests
