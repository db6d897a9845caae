#include <memory>

#include "bumper/engine_adapter/trimesh_lock.h"
#include "session.h"

namespace bumper::c_api {

namespace {

// A mutex that is held twice, or given back without being held, must be noticed here.
thread_local bool holdsTrimeshLock = false;

}  // namespace

extern "C" {

int bumper_save(bumper_responder responder, bumper_state* state) {
  return asking("bumper_save", responder, [&](const Session& session) {
    required("state", state);
    auto saved = std::make_unique<SavedState>(session.responder.save());
    state->value = savedStates.add(std::move(saved), "saved states");
  });
}

int bumper_restore(bumper_responder responder, bumper_state state) {
  return changing("bumper_restore", responder, [&](Session& session) {
    const SavedState* saved = savedStates.find(state.value);
    if (saved == nullptr) refuseHandle("state", state.value, "saved state");
    session.responder.restore(*saved);
  });
}

int bumper_destroy_state(bumper_state state) {
  return guarded("bumper_destroy_state", [&] {
    if (!savedStates.take(state.value)) refuseHandle("state", state.value, "saved state");
    return int{BUMPER_OK};
  });
}

int bumper_lock_trimesh() {
  return guarded("bumper_lock_trimesh", [] {
    if (holdsTrimeshLock) throw Error("this thread holds the lock already");
    trimeshLock().lock();
    holdsTrimeshLock = true;
    return int{BUMPER_OK};
  });
}

int bumper_unlock_trimesh() {
  return guarded("bumper_unlock_trimesh", [] {
    if (!holdsTrimeshLock) throw Error("this thread does not hold the lock");
    holdsTrimeshLock = false;
    trimeshLock().unlock();
    return int{BUMPER_OK};
  });
}

}  // extern "C"

}  // namespace bumper::c_api
