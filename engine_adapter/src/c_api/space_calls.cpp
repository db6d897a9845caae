#include "barrier_options.h"

namespace bumper::c_api {

namespace {

const SpaceBarriers& barriersOf(const Session& session, dSpaceID space) {
  required("space", space);
  const auto found = session.spaces.find(space);
  if (found == session.spaces.end()) refuse({"space"}, "was not added to this responder");
  return *found->second;
}

int count(const SpaceBarriers& barriers) { return static_cast<int>(barriers.barriers.size()); }

}  // namespace

extern "C" {

int bumper_add_space(bumper_responder responder, dSpaceID space,
                     const bumper_barrier_options* options) {
  return withSession("bumper_add_space", responder, [&](Session& session) {
    required("space", space);
    const BarrierOptions known = barrierOptions(options);
    session.events = {};
    const auto [place, isNew] = session.spaces.try_emplace(space, nullptr);
    if (!isNew) refuse({"space"}, "was added already: bumper_update_space() brings it up to date");
    try {
      place->second = &session.responder.addBarriers(space, known);
    } catch (...) {
      session.spaces.erase(place);
      throw;
    }
    return count(*place->second);
  });
}

int bumper_update_space(bumper_responder responder, dSpaceID space) {
  return withSession("bumper_update_space", responder, [&](Session& session) {
    static_cast<void>(barriersOf(session, space));
    session.events = {};
    return count(session.responder.updateBarriers(space));
  });
}

int bumper_remove_space(bumper_responder responder, dSpaceID space) {
  return changing("bumper_remove_space", responder, [&](Session& session) {
    static_cast<void>(barriersOf(session, space));
    session.responder.removeBarriers(space);
    session.spaces.erase(space);
  });
}

int bumper_get_space_barrier(bumper_responder responder, dSpaceID space, size_t index,
                             bumper_barrier* barrier) {
  return asking("bumper_get_space_barrier", responder, [&](const Session& session) {
    const std::vector<BarrierId>& barriers = barriersOf(session, space).barriers;
    requireIndex(index, barriers.size(), "barriers");
    required("barrier", barrier).value = handleOf(session, barriers[index].value);
  });
}

int bumper_left_geom_count(bumper_responder responder, dSpaceID space) {
  return withSession("bumper_left_geom_count", responder, [&](const Session& session) {
    return static_cast<int>(barriersOf(session, space).left.size());
  });
}

int bumper_get_left_geom(bumper_responder responder, dSpaceID space, size_t index, dGeomID* geom,
                         const char** reason) {
  return asking("bumper_get_left_geom", responder, [&](const Session& session) {
    const std::vector<SpaceBarriers::Left>& left = barriersOf(session, space).left;
    requireIndex(index, left.size(), "such geoms");
    required("geom", geom);
    required("reason", reason) = left[index].reason.c_str();
    *geom = left[index].geom;
  });
}

}  // extern "C"

}  // namespace bumper::c_api
