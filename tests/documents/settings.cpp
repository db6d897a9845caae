// The settings that engine_adapter/docs/parameters.md shows.

#include <bumper/response/response_settings.h>
#include <gtest/gtest.h>

namespace {

TEST(Settings, OfThePageAreValid) {
  bumper::ResponseSettings rubber;
  rubber.restitution = bumper::AngleCurve::cosine(0.5, 0.3);  // grazing, head-on
  rubber.friction = bumper::AngleCurve::constant(0.6);
  EXPECT_NO_THROW(validate(rubber));

  bumper::ResponseSettings fence;
  fence.law = bumper::Law::energy;
  fence.energyRoot = bumper::EnergyRoot::break_through;
  fence.energyRemaining = bumper::AngleCurve::cosine(1.0, 0.65);  // grazing, head-on
  EXPECT_NO_THROW(validate(fence));
  EXPECT_TRUE(breaks(fence));
}

}  // namespace
