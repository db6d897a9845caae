#include "session.h"

namespace bumper::c_api {

namespace {

constexpr std::size_t mostLinkedBodies = 65536;

VehicleParameters vehicleParameters(const bumper_vehicle_parameters* given) {
  VehicleParameters result;
  read({"parameters"}, &required("parameters", given), result);
  validate(result);
  return result;
}

VehicleOptions vehicleOptions(const bumper_vehicle_options* given) {
  VehicleOptions result;
  if (given == nullptr) return result;
  const Name name{"options"};
  const auto whole = completed(name, *given, inC<bumper_vehicle_options>());
  readFields(name, whole, result);
  requireArray({"linked_bodies", &name}, whole.linked_bodies, whole.linked_body_count,
               mostLinkedBodies);
  result.linkedBodies = {whole.linked_bodies, whole.linked_body_count};
  return result;
}

PairOptions pairOptions(const bumper_pair_options* given) {
  const Name name{"options"};
  const auto whole = completed(name, required("options", given), inC<bumper_pair_options>());
  if (whole.reserved != 0) refuse({"reserved", &name}, "is not 0");
  PairOptions result;
  readFields(name, whole, result);
  return result;
}

// An outline must have all four dimensions, whatever the bodies are.
void giveParameters(const VehicleParameters& measured, bumper_vehicle_parameters* parameters) {
  validate(measured);
  give("parameters", parameters, measured);
}

template <typename Measure>
int giveBand(const char* function, const bumper_vehicle_parameters* parameters, bumper_band* band,
             const Measure& measure) {
  return guarded(function, [&] {
    required("band", band);
    const Band result = measure(vehicleParameters(parameters));
    *band = {.bottom = result.bottom, .top = result.top};
    return int{BUMPER_OK};
  });
}

}  // namespace

extern "C" {

int bumper_parameters_from_bodies(dBodyID chassis, const bumper_vehicle_options* options,
                                  double mass_centre_to_front, double mass_centre_to_rear,
                                  double width, double mass_centre_height,
                                  bumper_vehicle_parameters* parameters) {
  return guarded("bumper_parameters_from_bodies", [&] {
    required("chassis", chassis);
    required("parameters", parameters);
    requireNumber({"mass_centre_to_front"}, mass_centre_to_front);
    requireNumber({"mass_centre_to_rear"}, mass_centre_to_rear);
    requireNumber({"width"}, width);
    requireNumber({"mass_centre_height"}, mass_centre_height);
    const VehicleOptions known = vehicleOptions(options);
    giveParameters(parametersFromBodies(chassis, known.linkedBodies, mass_centre_to_front,
                                        mass_centre_to_rear, width, mass_centre_height, known.axes),
                   parameters);
    return int{BUMPER_OK};
  });
}

int bumper_parameters_from_geoms(dBodyID chassis, const bumper_vehicle_options* options,
                                 double mass_centre_height, bumper_vehicle_parameters* parameters) {
  return guarded("bumper_parameters_from_geoms", [&] {
    required("chassis", chassis);
    required("parameters", parameters);
    requireNumber({"mass_centre_height"}, mass_centre_height);
    const VehicleOptions known = vehicleOptions(options);
    giveParameters(parametersFromGeoms(chassis, known.linkedBodies, mass_centre_height, known.axes),
                   parameters);
    return int{BUMPER_OK};
  });
}

int bumper_default_band(const bumper_vehicle_parameters* parameters, bumper_band* band) {
  return giveBand("bumper_default_band", parameters, band, defaultBand);
}

int bumper_plate_band(const bumper_vehicle_parameters* parameters, bumper_band* band) {
  return giveBand("bumper_plate_band", parameters, band, plateBand);
}

int bumper_add_vehicle(bumper_responder responder, dBodyID chassis,
                       const bumper_vehicle_parameters* parameters,
                       const bumper_vehicle_options* options, bumper_vehicle* vehicle) {
  return changing("bumper_add_vehicle", responder, [&](Session& session) {
    required("chassis", chassis);
    required("vehicle", vehicle);
    const VehicleId id = session.responder.addVehicle(chassis, vehicleParameters(parameters),
                                                      vehicleOptions(options));
    vehicle->value = handleOf(session, id.value);
  });
}

int bumper_remove_vehicle(bumper_responder responder, bumper_vehicle vehicle) {
  return changing("bumper_remove_vehicle", responder, [&](Session& session) {
    session.responder.removeVehicle(idOf(session, "vehicle", vehicle));
  });
}

int bumper_set_pair(bumper_responder responder, bumper_vehicle a, bumper_vehicle b,
                    const bumper_pair_options* options) {
  return withSession("bumper_set_pair", responder, [&](Session& session) {
    const VehicleId first = idOf(session, "a", a);
    session.responder.setPair(first, idOf(session, "b", b), pairOptions(options));
    return int{BUMPER_OK};
  });
}

int bumper_get_motion(bumper_responder responder, bumper_vehicle vehicle, bumper_motion* motion) {
  return asking("bumper_get_motion", responder, [&](const Session& session) {
    const VehicleId id = idOf(session, "vehicle", vehicle);
    give("motion", motion,
         {.position = session.responder.position(id),
          .orientation = session.responder.orientation(id),
          .velocity = session.responder.velocity(id),
          .yawRate = session.responder.yawRate(id)});
  });
}

}  // extern "C"

}  // namespace bumper::c_api
