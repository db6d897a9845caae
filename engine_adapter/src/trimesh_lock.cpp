#include "bumper/engine_adapter/trimesh_lock.h"

namespace bumper {

std::mutex& trimeshLock() {
  static std::mutex lock;
  return lock;
}

}  // namespace bumper
