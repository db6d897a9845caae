#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <utility>

#include "border.h"
#include "bumper/engine_adapter/responder.h"
#include "fields.h"
#include "handle_table.h"

/// What handles stand for.
namespace bumper::c_api {

/// A responder of the C interface.
struct Session {
  Responder responder;
  std::span<const ImpactEvent> events{};  ///< of the last step; empty once they may be void
  std::uint32_t tag = 0;                  ///< marks the handles of its vehicles and barriers
  std::map<dSpaceID, const SpaceBarriers*> spaces{};  ///< the responder's own
};

/// The only state that is the whole program's: handles that are given again after their thing is
/// gone can only be told by what is left.
extern HandleTable<Session> sessions;
extern HandleTable<SavedState> savedStates;

[[noreturn]] void refuseHandle(const char* name, std::uint64_t handle, const char* kind);

inline Session& sessionOf(bumper_responder responder) {
  if (Session* session = sessions.find(responder.value)) return *session;
  refuseHandle("responder", responder.value, "responder");
}

/// A vehicle or barrier: the tag of its responder above its number there plus one.
inline std::uint64_t handleOf(const Session& session, int id) {
  return (static_cast<std::uint64_t>(session.tag) << 32U) | (static_cast<std::uint32_t>(id) + 1U);
}

/// Throws Error unless index < count, of `things`.
void requireIndex(std::size_t index, std::size_t count, const char* things);

/// Throw StaleHandle unless the thing is registered.
VehicleId idOf(const Session& session, const char* name, bumper_vehicle vehicle);
BarrierId idOf(const Session& session, const char* name, bumper_barrier barrier);

/// Calls with a responder.
template <typename Call>
int withSession(const char* function, bumper_responder responder, const Call& call) noexcept {
  return guarded(function, [&] { return call(sessionOf(responder)); });
}

/// Those that change what is registered: events, and names in them, may be void by then, even if
/// memory runs out in the middle.
template <typename Call>
int changing(const char* function, bumper_responder responder, const Call& call) noexcept {
  return withSession(function, responder, [&](Session& session) {
    session.events = {};
    call(session);
    return int{BUMPER_OK};
  });
}

/// Those that ask.
template <typename Call>
int asking(const char* function, bumper_responder responder, const Call& call) noexcept {
  return withSession(function, responder, [&](const Session& session) {
    call(session);
    return int{BUMPER_OK};
  });
}

}  // namespace bumper::c_api
