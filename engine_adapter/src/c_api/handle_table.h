#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

#include "border.h"

namespace bumper::c_api {

/// Things by handles, which are never used twice: a slot's number in the low 16 bits, above it a
/// count of all that have been added. To find one takes no lock, so that a step does not. Things
/// that are left at the program's end are left alone, for their world may be gone.
template <typename Thing>
class HandleTable {
 public:
  static constexpr std::size_t capacity = 65536;

  /// Throws TooMany if the table is full; `kind` is for the message.
  std::uint64_t add(std::unique_ptr<Thing> thing, const char* kind) {
    const std::lock_guard lock(mutex_);
    const std::size_t number = lastFreed_ != 0 ? lastFreed_ - 1 : used_;
    if (number == capacity) {
      throw TooMany("there are " + std::to_string(capacity) + ' ' + kind + " already");
    }
    Slot& slot = slots_[number];
    if (lastFreed_ != 0) {
      lastFreed_ = slot.freedBefore;
    } else {
      ++used_;
    }
    const std::uint64_t handle = (++added_ << 16U) | number;
    slot.thing.store(thing.release(), std::memory_order_relaxed);
    slot.handle.store(handle, std::memory_order_release);
    return handle;
  }

  /// Null if the handle names nothing.
  [[nodiscard]] Thing* find(std::uint64_t handle) const noexcept {
    const Slot& slot = slots_[handle % capacity];
    if (handle == 0 || slot.handle.load(std::memory_order_acquire) != handle) return nullptr;
    return slot.thing.load(std::memory_order_relaxed);
  }

  /// Null likewise.
  std::unique_ptr<Thing> take(std::uint64_t handle) noexcept {
    const std::lock_guard lock(mutex_);
    std::unique_ptr<Thing> thing(find(handle));
    if (thing) {
      Slot& slot = slots_[handle % capacity];
      slot.handle.store(0, std::memory_order_relaxed);
      slot.freedBefore = lastFreed_;
      lastFreed_ = handle % capacity + 1;
    }
    return thing;
  }

 private:
  struct Slot {
    std::atomic<std::uint64_t> handle{0};  // 0: it is free
    std::atomic<Thing*> thing{nullptr};
    std::size_t freedBefore = 0;  // like lastFreed_
  };

  // All zero at first, so that the table takes no memory until it is used.
  std::mutex mutex_;
  std::array<Slot, capacity> slots_{};
  std::size_t used_ = 0;       // slots from here on have never been
  std::size_t lastFreed_ = 0;  // number of a slot + 1; 0: none
  std::uint64_t added_ = 0;
};

}  // namespace bumper::c_api
