#pragma once

#include <mutex>

#include "bumper/base/api.h"

namespace BUMPER_API bumper {

/// ODE's trimesh collider keeps global state and is not thread safe in the usual builds: two
/// threads that collide anything with a trimesh at the same time get wrong contacts, silently.
/// Bumper holds this lock around its own queries. An application that collides on several threads
/// must hold it around its own calls of dCollide and dSpaceCollide too; a lock on one side alone
/// protects neither.
std::mutex& trimeshLock();

}  // namespace bumper
