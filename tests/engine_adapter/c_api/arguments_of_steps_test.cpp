// Every call of a program's loop, with arguments that are NaN, infinite, negative, huge, null and
// stale. (That none is left out: arguments_of_all_test.cpp.)

#include <array>
#include <string_view>

#include "arguments.h"

namespace bumper::tests {
namespace {

TEST_F(CArguments, OfContactsAreRefused) {
  const dGeomID a = world_.car.geom;
  dGeomID wall = nullptr;
  ASSERT_EQ(bumper_get_geom(world_.responder, world_.barrier, &wall), BUMPER_OK);
  refuseResponder("bumper_claims",
                  [&](bumper_responder responder) { return bumper_claims(responder, a, wall); });
  expectRefused("bumper_claims", "a is null", bumper_claims(world_.responder, nullptr, wall));
  expectRefused("bumper_claims", "b is null", bumper_claims(world_.responder, a, nullptr));

  const char* call = "bumper_keep_unclaimed";
  std::array<dContact, 4> contacts{};
  const auto keep = [&](dGeomID first, dGeomID second, dContact* some, int count) {
    return bumper_keep_unclaimed(world_.responder, first, second, some, count);
  };
  refuseResponder(call, [&](bumper_responder responder) {
    return bumper_keep_unclaimed(responder, a, wall, contacts.data(), 4);
  });
  expectRefused(call, "a is null", keep(nullptr, wall, contacts.data(), 4));
  expectRefused(call, "b is null", keep(a, nullptr, contacts.data(), 4));
  expectRefused(call, "contacts", keep(a, wall, nullptr, 4));
  for (const int count :
       {-1, 65536, std::numeric_limits<int>::max(), std::numeric_limits<int>::min()}) {
    expectRefused(call, "count", keep(a, wall, contacts.data(), count));
  }
  EXPECT_EQ(keep(a, wall, nullptr, 0), 0);
}

TEST_F(CArguments, OfStepsAreRefused) {
  refuseResponder("bumper_step",
                  [](bumper_responder responder) { return bumper_step(responder, 0.005); });
  refuseNumber("bumper_step", "h", {-0.005, -1e-300},
               [&](double value) { return bumper_step(world_.responder, value); });
  EXPECT_EQ(bumper_step(world_.responder, 0.0), 0);
  EXPECT_EQ(bumper_step(world_.responder, -0.0), 0);
}

TEST_F(CArguments, OfEventsAreRefused) {
  const char* call = "bumper_get_event";
  auto event = initialised(bumper_init_event);
  expectRefused(call, "index", bumper_get_event(world_.responder, 0, &event));
  CWorld second;
  second.stepToImpact();
  const auto ask = [&](std::size_t index) {
    return bumper_get_event(second.responder, index, &event);
  };
  refuseResponder(
      call, [&](bumper_responder responder) { return bumper_get_event(responder, 0, &event); });
  for (const std::size_t index : {std::size_t{1}, std::size_t{1} << 32U, hugeCount}) {
    expectRefused(call, "index", ask(index));
  }
  refuseFilling<bumper_event>(call, "event", [&](bumper_event* some) {
    return bumper_get_event(second.responder, 0, some);
  });
  EXPECT_EQ(event.approach_speed, 0.0);
  EXPECT_EQ(ask(0), BUMPER_OK);
  EXPECT_GT(event.approach_speed, 0.0);
  EXPECT_STREQ(event.vehicle, "vehicle 0");
}

TEST_F(CArguments, OfQuestionsAreRefused) {
  const bumper_responder responder = world_.responder;
  double time = -1.0;
  refuseResponder("bumper_get_time",
                  [&](bumper_responder stale) { return bumper_get_time(stale, &time); });
  expectRefused("bumper_get_time", "time", bumper_get_time(responder, nullptr));
  EXPECT_EQ(time, -1.0);

  refuseResponder("bumper_get_issues", bumper_get_issues);
  refuseResponder("bumper_get_vehicle_issues", [&](bumper_responder stale) {
    return bumper_get_vehicle_issues(stale, world_.vehicle);
  });
  refuseVehicle("bumper_get_vehicle_issues", "vehicle",
                [&](bumper_vehicle stale) { return bumper_get_vehicle_issues(responder, stale); });

  const char* text = nullptr;
  refuseResponder("bumper_warning_count", bumper_warning_count);
  refuseResponder("bumper_get_warning",
                  [&](bumper_responder stale) { return bumper_get_warning(stale, 0, &text); });
  for (const std::size_t index : {std::size_t{1000}, hugeCount}) {
    expectRefused("bumper_get_warning", "index", bumper_get_warning(responder, index, &text));
  }
  EXPECT_EQ(text, nullptr);

  auto motion = initialised(bumper_init_motion);
  refuseResponder("bumper_get_motion", [&](bumper_responder stale) {
    return bumper_get_motion(stale, world_.vehicle, &motion);
  });
  refuseVehicle("bumper_get_motion", "vehicle",
                [&](bumper_vehicle stale) { return bumper_get_motion(responder, stale, &motion); });
  refuseFilling<bumper_motion>("bumper_get_motion", "motion", [&](bumper_motion* some) {
    return bumper_get_motion(responder, world_.vehicle, some);
  });

  dGeomID geom = nullptr;
  refuseResponder("bumper_get_geom", [&](bumper_responder stale) {
    return bumper_get_geom(stale, world_.barrier, &geom);
  });
  refuseBarrier("bumper_get_geom",
                [&](bumper_barrier stale) { return bumper_get_geom(responder, stale, &geom); });
  expectRefused("bumper_get_geom", "geom", bumper_get_geom(responder, world_.barrier, nullptr));
  EXPECT_EQ(geom, nullptr);

  auto report = initialised(bumper_init_wall_report);
  refuseResponder("bumper_get_wall_report", [&](bumper_responder stale) {
    return bumper_get_wall_report(stale, world_.barrier, &report);
  });
  refuseBarrier("bumper_get_wall_report", [&](bumper_barrier stale) {
    return bumper_get_wall_report(responder, stale, &report);
  });
  refuseFilling<bumper_wall_report>(
      "bumper_get_wall_report", "report", [&](bumper_wall_report* some) {
        return bumper_get_wall_report(responder, world_.barrier, some);
      });
}

TEST_F(CArguments, OfTheLockCannotBeWrongButItsOrderCan) {
  expectRefused("bumper_unlock_trimesh", "lock", bumper_unlock_trimesh());
  EXPECT_EQ(bumper_lock_trimesh(), BUMPER_OK);
  expectRefused("bumper_lock_trimesh", "lock", bumper_lock_trimesh());
  EXPECT_EQ(bumper_unlock_trimesh(), BUMPER_OK);
  expectRefused("bumper_unlock_trimesh", "lock", bumper_unlock_trimesh());
}

TEST_F(CArguments, OfWordsHaveOneWordForAllThatIsUnknown) {
  for (const std::int32_t number : {-1, 6, std::numeric_limits<std::int32_t>::max(),
                                    std::numeric_limits<std::int32_t>::min()}) {
    for (const char* word : {bumper_phase_word(number), bumper_law_word(number),
                             bumper_outcome_word(number), bumper_regime_word(number)}) {
      EXPECT_STREQ(word, "unknown");
    }
  }
  EXPECT_STREQ(bumper_phase_word(BUMPER_PHASE_CONTACT_END), "contact_end");
  EXPECT_STREQ(bumper_regime_word(BUMPER_REGIME_REVERSE_SLIP), "reverse_slip");
}

}  // namespace
}  // namespace bumper::tests
