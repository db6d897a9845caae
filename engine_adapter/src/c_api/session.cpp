#include "session.h"

#include <string>

namespace bumper::c_api {

constinit HandleTable<Session> sessions;
constinit HandleTable<SavedState> savedStates;

namespace {

// The number of a thing of this responder; −1 if the handle is of none.
int numberOf(const Session& session, std::uint64_t handle) {
  const auto number = static_cast<std::uint32_t>(handle);
  const bool isOfThis = handle >> 32U == session.tag && number > 0 && number <= 0x7FFFFFFFU;
  return isOfThis ? static_cast<int>(number - 1) : -1;
}

}  // namespace

void refuseHandle(const char* name, std::uint64_t handle, const char* kind) {
  if (handle == 0) throw StaleHandle(std::string(name) + " is 0, which names nothing");
  throw StaleHandle(std::string(name) + " names no " + kind + ", or none any more");
}

void requireIndex(std::size_t index, std::size_t count, const char* things) {
  if (index < count) return;
  refuse({"index"},
         "is " + std::to_string(index) + ": there are " + std::to_string(count) + ' ' + things);
}

VehicleId idOf(const Session& session, const char* name, bumper_vehicle vehicle) {
  const VehicleId id{numberOf(session, vehicle.value)};
  try {
    static_cast<void>(session.responder.issues(id));
  } catch (const Error&) {
    refuseHandle(name, vehicle.value, "vehicle of this responder");
  }
  return id;
}

BarrierId idOf(const Session& session, const char* name, bumper_barrier barrier) {
  const BarrierId id{numberOf(session, barrier.value)};
  try {
    static_cast<void>(session.responder.report(id));
  } catch (const Error&) {
    refuseHandle(name, barrier.value, "barrier of this responder");
  }
  return id;
}

}  // namespace bumper::c_api
