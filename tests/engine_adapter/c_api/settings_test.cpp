// Settings on their way to C and back.

#include <gtest/gtest.h>

#include <numbers>
#include <optional>
#include <string_view>

#include "bumper/response/presets.h"
#include "c_api/fields.h"
#include "c_world.h"

namespace bumper::tests {
namespace {

void expectSame(const AngleCurve& a, const AngleCurve& b) {
  for (double angle = 0.0; angle <= 0.5 * std::numbers::pi; angle += 0.01) {
    ASSERT_EQ(a(angle), b(angle)) << angle;
  }
}

void expectSame(const ResponseSettings& a, const ResponseSettings& b) {
  EXPECT_EQ(a.method, b.method);
  EXPECT_EQ(a.law, b.law);
  EXPECT_EQ(a.angle, b.angle);
  expectSame(a.restitution, b.restitution);
  EXPECT_EQ(a.restitutionKind, b.restitutionKind);
  expectSame(a.friction, b.friction);
  EXPECT_EQ(a.frictionKind, b.frictionKind);
  expectSame(a.energyRemaining, b.energyRemaining);
  EXPECT_EQ(a.energyRoot, b.energyRoot);
  EXPECT_EQ(a.maxRestitution, b.maxRestitution);
  EXPECT_EQ(a.penetrationTime, b.penetrationTime);
  EXPECT_EQ(a.smallestFeature, b.smallestFeature);
  EXPECT_EQ(a.contactTime, b.contactTime);
  EXPECT_EQ(a.restSpeed, b.restSpeed);
}

ResponseSettings inCpp(const bumper_response_settings& settings) {
  ResponseSettings result;
  c_api::read({"settings"}, &settings, result);
  return result;
}

TEST(CSettings, OfPresetsAreThoseOfCpp) {
  ASSERT_EQ(bumper_preset_count(), static_cast<int>(presetNames().size()));
  for (std::size_t i = 0; i < presetNames().size(); ++i) {
    auto byIndex = initialised(bumper_init_response_settings);
    auto byName = byIndex;
    const char* name = nullptr;
    ASSERT_EQ(bumper_get_preset(i, &name, &byIndex), BUMPER_OK);
    EXPECT_EQ(std::string_view(name), presetNames()[i]);
    ASSERT_EQ(bumper_find_preset(name, &byName), BUMPER_OK);
    const ResponseSettings expected = findPreset(name).value();
    expectSame(inCpp(byIndex), expected);
    expectSame(inCpp(byName), expected);
    ASSERT_EQ(bumper_get_preset(i, &name, nullptr), BUMPER_OK);
    ASSERT_EQ(bumper_get_preset(i, nullptr, &byIndex), BUMPER_OK);
  }
}

TEST(CSettings, ReachCppMemberByMember) {
  auto settings = initialised(bumper_init_response_settings);
  expectSame(inCpp(settings), {});
  const double points[] = {0.1, 0.3, 0.9, 0.2};
  settings.law = BUMPER_LAW_ENERGY;
  settings.angle = BUMPER_ANGLE_HEADING;
  settings.restitution = {.shape = BUMPER_CURVE_HALF_COSINE,
                          .point_count = 0,
                          .grazing = 0.4,
                          .head_on = 0.1,
                          .points = nullptr};
  settings.restitution_kind = BUMPER_RESTITUTION_KUDLICH_SLIBAR;
  settings.friction.grazing = 0.5;
  settings.friction_kind = BUMPER_FRICTION_FRACTION_OF_CRITICAL;
  settings.energy_remaining = {.shape = BUMPER_CURVE_TABLE,
                               .point_count = 2,
                               .grazing = 0.0,
                               .head_on = 0.0,
                               .points = points};
  settings.energy_root = BUMPER_ENERGY_BREAK_THROUGH;
  settings.max_restitution = 0.21;
  settings.penetration_time = 0.022;
  settings.smallest_feature = 0.023;
  settings.contact_time = 0.024;
  settings.rest_speed = 0.25;
  expectSame(inCpp(settings), {.method = Method::bumper,
                               .law = Law::energy,
                               .angle = AngleDefinition::heading,
                               .restitution = AngleCurve::halfCosine(0.4, 0.1),
                               .restitutionKind = RestitutionKind::kudlich_slibar,
                               .friction = AngleCurve::cosine(0.5, 0.0),
                               .frictionKind = Friction::Kind::fraction_of_critical,
                               .energyRemaining = AngleCurve::table({{0.1, 0.3}, {0.9, 0.2}}),
                               .energyRoot = EnergyRoot::break_through,
                               .maxRestitution = 0.21,
                               .penetrationTime = 0.022,
                               .smallestFeature = 0.023,
                               .contactTime = 0.024,
                               .restSpeed = 0.25});
}

TEST(CSettings, OfAWallSelectionReachCpp) {
  auto walls = initialised(bumper_init_wall_selection);
  WallSelection read{.maxNormalUp = 0.9, .groundReach = std::nullopt};
  c_api::read({"walls"}, &walls, read);
  const WallSelection usual;
  EXPECT_EQ(read.maxNormalUp, usual.maxNormalUp);
  EXPECT_EQ(read.dropRepeated, usual.dropRepeated);
  ASSERT_EQ(read.groundReach.has_value(), usual.groundReach.has_value());
  EXPECT_EQ(read.groundReach->distance, usual.groundReach->distance);
  EXPECT_EQ(read.groundReach->above, usual.groundReach->above);
  EXPECT_EQ(read.groundReach->below, usual.groundReach->below);

  walls.max_normal_up = 0.7;
  walls.scenery = "TREE.*";
  walls.drop_repeated = 0;
  walls.reach_distance = 1.0;
  walls.reach_above = 2.0;
  walls.reach_below = 3.0;
  c_api::read({"walls"}, &walls, read);
  EXPECT_EQ(read.maxNormalUp, 0.7);
  EXPECT_EQ(read.scenery, "TREE.*");
  EXPECT_FALSE(read.dropRepeated);
  EXPECT_EQ(read.groundReach->distance, 1.0);
  EXPECT_EQ(read.groundReach->above, 2.0);
  EXPECT_EQ(read.groundReach->below, 3.0);
  walls.limit_ground_reach = 0;
  c_api::read({"walls"}, &walls, read);
  EXPECT_FALSE(read.groundReach.has_value());
}

TEST(CSettings, OfAResponderReachCpp) {
  auto options = initialised(bumper_init_responder_options);
  options.vehicles_collide = 0;
  options.delivery = BUMPER_DELIVERY_STATE_RESET;
  options.guard_contacts = 0;
  options.skipping = 0;
  options.up[1] = 1.0;
  options.up[2] = 0.0;
  options.metre = 100.0;
  ResponderOptions read;
  c_api::read({"options"}, &options, read);
  EXPECT_FALSE(read.vehiclesCollide);
  EXPECT_EQ(read.delivery, Delivery::state_reset);
  EXPECT_FALSE(read.guardContacts);
  EXPECT_FALSE(read.skipping);
  EXPECT_EQ(read.axes.up, Eigen::Vector3d::UnitY());
  EXPECT_EQ(read.axes.metre, 100.0);
}

TEST(CSettings, OfAVehicleReachCpp) {
  auto options = initialised(bumper_init_vehicle_options);
  const bumper_band band{.bottom = 0.1, .top = 0.9};
  options.name = "Käfer";
  options.band = &band;
  options.tilt_limit = 0.4;
  options.mover = BUMPER_MOVER_OTHER_HOST;
  options.finite_rotation = 1;
  options.forward[0] = 0.0;
  options.forward[1] = 1.0;
  VehicleOptions read;
  c_api::read({"options"}, &options, read);
  EXPECT_EQ(read.name, "Käfer");
  EXPECT_EQ(read.band.value().bottom, 0.1);
  EXPECT_EQ(read.band.value().top, 0.9);
  EXPECT_EQ(read.tiltLimit, 0.4);
  EXPECT_EQ(read.mover, Mover::other_host);
  EXPECT_TRUE(read.finiteRotation);
  EXPECT_EQ(read.axes.forward, Eigen::Vector3d::UnitY());
  EXPECT_EQ(read.axes.up, Eigen::Vector3d::UnitZ());
}

}  // namespace
}  // namespace bumper::tests
