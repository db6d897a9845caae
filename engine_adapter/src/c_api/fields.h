#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <concepts>
#include <cstddef>
#include <type_traits>

#include "read_value.h"
#include "struct_size.h"
#include "write_value.h"

/// Each member of the interface's structs beside what it is in C++: the one place where a new one
/// is added, once it is in the header. Arrays with a count are read by the calls that take them.
namespace bumper::c_api {

template <typename T, typename Struct>
concept Is = std::same_as<std::remove_const_t<T>, Struct>;

/// A vehicle's motion, which has no struct of its own in C++.
struct Motion {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  double yawRate = 0.0;
};

/// A scene has arrays alone.
struct SceneView {};

void fields(Is<bumper_response_settings> auto& c, auto& cpp, const auto& visit) {
  visit("method", c.method, cpp.method);
  visit("law", c.law, cpp.law);
  visit("angle", c.angle, cpp.angle);
  visit("restitution_kind", c.restitution_kind, cpp.restitutionKind);
  visit("friction_kind", c.friction_kind, cpp.frictionKind);
  visit("energy_root", c.energy_root, cpp.energyRoot);
  visit("restitution", c.restitution, cpp.restitution);
  visit("friction", c.friction, cpp.friction);
  visit("energy_remaining", c.energy_remaining, cpp.energyRemaining);
  visit("max_restitution", c.max_restitution, cpp.maxRestitution);
  visit("penetration_time", c.penetration_time, cpp.penetrationTime);
  visit("smallest_feature", c.smallest_feature, cpp.smallestFeature);
  visit("contact_time", c.contact_time, cpp.contactTime);
  visit("rest_speed", c.rest_speed, cpp.restSpeed);
}

void fields(Is<bumper_responder_options> auto& c, auto& cpp, const auto& visit) {
  visit("response", c.response, cpp.response);
  visit("vehicle_response", c.vehicle_response, cpp.vehicleResponse);
  visit("vehicles_collide", c.vehicles_collide, cpp.vehiclesCollide);
  visit("delivery", c.delivery, cpp.delivery);
  visit("guard_contacts", c.guard_contacts, cpp.guardContacts);
  visit("skipping", c.skipping, cpp.skipping);
  visit("up", c.up, cpp.axes.up);
  visit("metre", c.metre, cpp.axes.metre);
}

/// Of WallSelection but for the ground's reach.
void fields(Is<bumper_wall_selection> auto& c, auto& cpp, const auto& visit) {
  visit("max_normal_up", c.max_normal_up, cpp.maxNormalUp);
  visit("scenery", c.scenery, cpp.scenery);
  visit("drop_repeated", c.drop_repeated, cpp.dropRepeated);
  visit("limit_ground_reach", c.limit_ground_reach, cpp.limitGroundReach);
  visit("reach_distance", c.reach_distance, cpp.reach.distance);
  visit("reach_above", c.reach_above, cpp.reach.above);
  visit("reach_below", c.reach_below, cpp.reach.below);
}

void fields(Is<bumper_barrier_options> auto& c, auto& cpp, const auto& visit) {
  visit("space", c.space, cpp.space);
  visit("geom", c.geom, cpp.geom);
  visit("name", c.name, cpp.name);
  visit("walls", c.walls, cpp.walls);
  visit("response", c.response, cpp.response);
}

void fields(Is<bumper_scene> auto& /*c*/, auto& /*cpp*/, const auto& /*visit*/) {}

void fields(Is<bumper_wall_report> auto& c, auto& cpp, const auto& visit) {
  visit("walls", c.walls, cpp.walls);
  visit("dropped_flat", c.dropped_flat, cpp.droppedFlat);
  visit("dropped_degenerate", c.dropped_degenerate, cpp.droppedDegenerate);
  visit("dropped_scenery", c.dropped_scenery, cpp.droppedScenery);
  visit("dropped_duplicate", c.dropped_duplicate, cpp.droppedDuplicate);
  visit("dropped_retriangulated", c.dropped_retriangulated, cpp.droppedRetriangulated);
  visit("dropped_overhead", c.dropped_overhead, cpp.droppedOverhead);
  visit("dropped_buried", c.dropped_buried, cpp.droppedBuried);
  visit("dropped_on_guess", c.dropped_on_guess, cpp.droppedOnGuess);
  visit("without_ground", c.without_ground, cpp.withoutGround);
  visit("in_doubt", c.in_doubt, cpp.inDoubt);
  visit("memory", c.memory, cpp.memory);
  visit("lowest_foot", c.lowest_foot, cpp.lowestFoot);
  visit("highest_top", c.highest_top, cpp.highestTop);
}

void fields(Is<bumper_vehicle_parameters> auto& c, auto& cpp, const auto& visit) {
  visit("mass", c.mass, cpp.mass);
  visit("yaw_inertia", c.yaw_inertia, cpp.yawInertia);
  visit("mass_centre_to_front", c.mass_centre_to_front, cpp.massCentreToFront);
  visit("mass_centre_to_rear", c.mass_centre_to_rear, cpp.massCentreToRear);
  visit("width", c.width, cpp.width);
  visit("mass_centre_height", c.mass_centre_height, cpp.massCentreHeight);
}

void fields(Is<bumper_vehicle_options> auto& c, auto& cpp, const auto& visit) {
  visit("name", c.name, cpp.name);
  visit("band", c.band, cpp.band);
  visit("tilt_limit", c.tilt_limit, cpp.tiltLimit);
  visit("mover", c.mover, cpp.mover);
  visit("finite_rotation", c.finite_rotation, cpp.finiteRotation);
  visit("forward", c.forward, cpp.axes.forward);
  visit("up", c.up, cpp.axes.up);
}

void fields(Is<bumper_pair_options> auto& c, auto& cpp, const auto& visit) {
  visit("response", c.response, cpp.response);
  visit("collide", c.collide, cpp.collide);
}

void fields(Is<bumper_motion> auto& c, auto& cpp, const auto& visit) {
  visit("position", c.position, cpp.position);
  visit("orientation", c.orientation, cpp.orientation);
  visit("velocity", c.velocity, cpp.velocity);
  visit("yaw_rate", c.yaw_rate, cpp.yawRate);
}

void fields(Is<bumper_event> auto& c, auto& cpp, const auto& visit) {
  visit("time", c.time, cpp.time);
  visit("phase", c.phase, cpp.phase);
  visit("triangle", c.triangle, cpp.triangle);
  visit("vehicle", c.vehicle, cpp.vehicle);
  visit("barrier", c.barrier, cpp.barrier);
  visit("other_vehicle", c.other_vehicle, cpp.otherVehicle);
  visit("material", c.material, cpp.material);
  visit("contact", c.contact, cpp.contact);
  visit("normal", c.normal, cpp.normal);
  visit("arm", c.arm, cpp.arm);
  visit("other_arm", c.other_arm, cpp.otherArm);
  visit("other_velocity_before", c.other_velocity_before, cpp.otherVelocityBefore);
  visit("other_velocity_after", c.other_velocity_after, cpp.otherVelocityAfter);
  visit("other_yaw_rate_before", c.other_yaw_rate_before, cpp.otherYawRateBefore);
  visit("other_yaw_rate_after", c.other_yaw_rate_after, cpp.otherYawRateAfter);
  visit("law", c.law, cpp.law);
  visit("outcome", c.outcome, cpp.outcome);
  visit("regime", c.regime, cpp.regime);
  visit("angle_contact_velocity", c.angle_contact_velocity, cpp.angles.contactVelocity);
  visit("angle_centre_velocity", c.angle_centre_velocity, cpp.angles.centreVelocity);
  visit("angle_heading", c.angle_heading, cpp.angles.heading);
  visit("approach_speed", c.approach_speed, cpp.approachSpeed);
  visit("restitution", c.restitution, cpp.restitution);
  visit("friction", c.friction, cpp.friction);
  visit("impulse_normal", c.impulse_normal, cpp.impulseNormal);
  visit("impulse_tangent", c.impulse_tangent, cpp.impulseTangent);
  visit("impulse_ratio", c.impulse_ratio, cpp.impulseRatio);
  visit("critical_impulse_ratio", c.critical_impulse_ratio, cpp.criticalImpulseRatio);
  visit("delta_v", c.delta_v, cpp.deltaV);
  visit("yaw_rate_before", c.yaw_rate_before, cpp.yawRateBefore);
  visit("yaw_rate_after", c.yaw_rate_after, cpp.yawRateAfter);
  visit("speed_before", c.speed_before, cpp.speedBefore);
  visit("speed_after", c.speed_after, cpp.speedAfter);
  visit("velocity_after", c.velocity_after, cpp.velocityAfter);
  visit("energy_asked", c.energy_asked, cpp.energyAsked);
  visit("energy_ratio", c.energy_ratio, cpp.energyRatio);
  visit("energy_lost", c.energy_lost, cpp.energyLost);
  visit("duration", c.duration, cpp.duration);
}

/// WallSelection with its ground's reach beside the question whether it is limited.
struct FlatWallSelection {
  double maxNormalUp = WallSelection{}.maxNormalUp;
  std::string_view scenery{};
  bool dropRepeated = WallSelection{}.dropRepeated;
  bool limitGroundReach = WallSelection{}.groundReach.has_value();
  GroundReach reach{};

  [[nodiscard]] WallSelection asOne() const {
    return {.maxNormalUp = maxNormalUp,
            .scenery = scenery,
            .dropRepeated = dropRepeated,
            .groundReach = limitGroundReach ? std::optional(reach) : std::nullopt};
  }
};

template <typename Cpp_, std::size_t firstSize_>
struct LayoutOf {
  using Cpp = Cpp_;
  static constexpr std::size_t firstSize = firstSize_;
};

// The last member of the first release: it never changes.
#define BUMPER_FIRST_SIZE(Struct, member) (offsetof(Struct, member) + sizeof(Struct::member))

template <>
struct Layout<bumper_response_settings>
    : LayoutOf<ResponseSettings, BUMPER_FIRST_SIZE(bumper_response_settings, rest_speed)> {};
template <>
struct Layout<bumper_responder_options>
    : LayoutOf<ResponderOptions, BUMPER_FIRST_SIZE(bumper_responder_options, metre)> {};
template <>
struct Layout<bumper_wall_selection>
    : LayoutOf<FlatWallSelection, BUMPER_FIRST_SIZE(bumper_wall_selection, reach_below)> {};
template <>
struct Layout<bumper_barrier_options>
    : LayoutOf<BarrierOptions, BUMPER_FIRST_SIZE(bumper_barrier_options, material_count)> {};
template <>
struct Layout<bumper_scene> : LayoutOf<SceneView, BUMPER_FIRST_SIZE(bumper_scene, mesh_count)> {};
template <>
struct Layout<bumper_wall_report>
    : LayoutOf<WallReport, BUMPER_FIRST_SIZE(bumper_wall_report, highest_top)> {};
template <>
struct Layout<bumper_vehicle_parameters>
    : LayoutOf<VehicleParameters,
               BUMPER_FIRST_SIZE(bumper_vehicle_parameters, mass_centre_height)> {};
template <>
struct Layout<bumper_vehicle_options>
    : LayoutOf<VehicleOptions, BUMPER_FIRST_SIZE(bumper_vehicle_options, up)> {};
template <>
struct Layout<bumper_pair_options>
    : LayoutOf<PairOptions, BUMPER_FIRST_SIZE(bumper_pair_options, reserved)> {};
template <>
struct Layout<bumper_motion> : LayoutOf<Motion, BUMPER_FIRST_SIZE(bumper_motion, yaw_rate)> {};
template <>
struct Layout<bumper_event> : LayoutOf<ImpactEvent, BUMPER_FIRST_SIZE(bumper_event, duration)> {};

#undef BUMPER_FIRST_SIZE

/// A whole struct of C from what it is in C++.
template <Sized C>
C inC(const typename Layout<C>::Cpp& cpp) {
  C c{};
  c.size = sizeof(C);
  fields(c, cpp, [](const char* /*member*/, auto& to, const auto& from) { write(from, to); });
  return c;
}

template <Sized C>
C inC() {
  return inC<C>(typename Layout<C>::Cpp{});
}

template <Sized C>
void read(const Name& name, const C* from, typename Layout<C>::Cpp& to);

/// Pointers to structs: null leaves the default.
template <Sized C>
void read(const Name& name, const C* from, std::optional<typename Layout<C>::Cpp>& to) {
  if (from != nullptr) read(name, from, to.emplace());
}

inline void read(const Name& name, const bumper_band* from, std::optional<Band>& to) {
  if (from != nullptr) read(name, *from, to.emplace());
}

void read(const Name& name, const bumper_wall_selection* from, WallSelection& to);

/// What a whole struct of C is in C++, but for its arrays.
template <Sized C>
void readFields(const Name& name, const C& from, typename Layout<C>::Cpp& to) {
  fields(from, to, [&](const char* member, const auto& c, auto& cpp) {
    read(Name{member, &name}, c, cpp);
  });
}

template <Sized C>
void read(const Name& name, const C* from, typename Layout<C>::Cpp& to) {
  if (from != nullptr) readFields(name, completed(name, *from, inC<C>()), to);
}

inline void read(const Name& name, const bumper_wall_selection* from, WallSelection& to) {
  FlatWallSelection flat;
  read(name, from, flat);
  to = flat.asOne();
}

/// Fills a caller's struct, which knows its size.
template <Sized C>
void give(const char* name, C* to, const typename Layout<C>::Cpp& from) {
  C& target = required(name, to);
  fill({name}, target, target.size, inC<C>(from));
}

/// Sets a caller's struct of that size to the defaults.
template <Sized C>
int initialise(const char* function, const char* name, C* to, std::size_t size) {
  return guarded(function, [&] {
    fill({name}, required(name, to), size, inC<C>());
    return int{BUMPER_OK};
  });
}

}  // namespace bumper::c_api
