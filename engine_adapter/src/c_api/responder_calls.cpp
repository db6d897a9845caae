#include <memory>
#include <string>
#include <utility>

#include "session.h"

namespace bumper::c_api {

namespace {

void requireGeoms(dGeomID a, dGeomID b) {
  required("a", a);
  required("b", b);
}

// Out of the way of a step, whose cost is counted in nanoseconds.
[[noreturn, gnu::noinline, gnu::cold]] void refuseStep(double h) {
  requireNumber({"h"}, h);
  refuse({"h"}, "is " + std::to_string(h) + " s: it must not be negative");
}

// ODE's dCollide gives no more.
constexpr int mostContacts = 65535;

}  // namespace

extern "C" {

int bumper_create_responder(dWorldID world, const bumper_responder_options* options,
                            bumper_responder* responder) {
  return guarded("bumper_create_responder", [&] {
    required("world", world);
    required("responder", responder);
    ResponderOptions settings;
    read({"options"}, options, settings);
    auto session = std::make_unique<Session>(Session{.responder = Responder(world, settings)});
    Session& kept = *session;
    responder->value = sessions.add(std::move(session), "responders");
    kept.tag = static_cast<std::uint32_t>(responder->value >> 16U);
    return int{BUMPER_OK};
  });
}

int bumper_destroy_responder(bumper_responder responder) {
  return guarded("bumper_destroy_responder", [&] {
    if (!sessions.take(responder.value)) refuseHandle("responder", responder.value, "responder");
    return int{BUMPER_OK};
  });
}

int bumper_claims(bumper_responder responder, dGeomID a, dGeomID b) {
  return withSession("bumper_claims", responder, [&](const Session& session) {
    requireGeoms(a, b);
    return session.responder.claims(a, b) ? 1 : 0;
  });
}

int bumper_keep_unclaimed(bumper_responder responder, dGeomID a, dGeomID b, dContact* contacts,
                          int count) {
  return withSession("bumper_keep_unclaimed", responder, [&](const Session& session) {
    requireGeoms(a, b);
    if (count < 0 || count > mostContacts) {
      refuse({"count"},
             "is " + std::to_string(count) + ": it must be 0 to " + std::to_string(mostContacts));
    }
    if (count > 0) required("contacts", contacts);
    return session.responder.keepUnclaimed(a, b, contacts, count);
  });
}

int bumper_step(bumper_responder responder, double h) {
  return withSession("bumper_step", responder, [&](Session& session) {
    if (!(h >= 0.0 && h <= largestNumber)) refuseStep(h);
    session.events = session.responder.step(h);
    return static_cast<int>(session.events.size());
  });
}

int bumper_get_event(bumper_responder responder, size_t index, bumper_event* event) {
  return asking("bumper_get_event", responder, [&](const Session& session) {
    requireIndex(index, session.events.size(), "events of the last step");
    give("event", event, session.events[index]);
  });
}

int bumper_get_time(bumper_responder responder, double* time) {
  return asking("bumper_get_time", responder,
                [&](const Session& session) { required("time", time) = session.responder.time(); });
}

int bumper_get_issues(bumper_responder responder) {
  return withSession("bumper_get_issues", responder, [&](const Session& session) {
    return static_cast<int>(session.responder.issues());
  });
}

int bumper_get_vehicle_issues(bumper_responder responder, bumper_vehicle vehicle) {
  return withSession("bumper_get_vehicle_issues", responder, [&](const Session& session) {
    return static_cast<int>(session.responder.issues(idOf(session, "vehicle", vehicle)));
  });
}

int bumper_warning_count(bumper_responder responder) {
  return withSession("bumper_warning_count", responder, [&](const Session& session) {
    return static_cast<int>(session.responder.warnings().size());
  });
}

int bumper_get_warning(bumper_responder responder, size_t index, const char** text) {
  return asking("bumper_get_warning", responder, [&](const Session& session) {
    const auto warnings = session.responder.warnings();
    requireIndex(index, warnings.size(), "warnings");
    required("text", text) = warnings[index].c_str();
  });
}

}  // extern "C"

}  // namespace bumper::c_api
