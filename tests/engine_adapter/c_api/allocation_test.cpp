// Nothing is allocated in a loop through the C interface, after warm-up.

#include <gtest/gtest.h>

#include <array>

#include "c_world.h"
#include "caught_allocations.h"

namespace bumper::tests {
namespace {

TEST(CAllocation, NoneInALoopAfterWarmUp) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer has its own malloc";
#endif
  CWorld world;
  bumper_state begin{};
  ASSERT_EQ(bumper_save(world.responder, &begin), BUMPER_OK);
  dGeomID wall = nullptr;
  ASSERT_EQ(bumper_get_geom(world.responder, world.barrier, &wall), BUMPER_OK);
  int events = 0;
  int allocations = 0;
  int failures = 0;
  std::array<dContact, 8> contacts{};
  for (int round = 0; round < 6; ++round) {
    world.start();
    ASSERT_EQ(bumper_restore(world.responder, begin), BUMPER_OK);
    for (int step = 0; step < 400; ++step) {
      caught = 0;
      guarded = true;
      if (bumper_claims(world.responder, world.car.geom, wall) < 0) ++failures;
      if (bumper_keep_unclaimed(world.responder, world.car.geom, wall, contacts.data(), 0) < 0) {
        ++failures;
      }
      const int count = bumper_step(world.responder, 0.005);
      bumper_event event;
      bumper_init_event(&event, sizeof event);
      for (int i = 0; i < count; ++i) {
        if (bumper_get_event(world.responder, static_cast<std::size_t>(i), &event) < 0) ++failures;
      }
      bumper_motion motion;
      bumper_init_motion(&motion, sizeof motion);
      if (bumper_get_motion(world.responder, world.vehicle, &motion) < 0) ++failures;
      if (bumper_get_issues(world.responder) < 0) ++failures;
      guarded = false;
      events += count;
      if (round >= 2) allocations += caught;
      dWorldQuickStep(world.ode.world, 0.005);
    }
  }
  EXPECT_GT(events, 30);
  EXPECT_EQ(failures, 0);
  EXPECT_EQ(allocations, 0);
  EXPECT_EQ(bumper_destroy_state(begin), BUMPER_OK);
}

}  // namespace
}  // namespace bumper::tests
