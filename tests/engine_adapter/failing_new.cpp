#include "failing_new.h"

#include <cstdlib>
#include <new>

namespace bumper::tests {

long live = 0;
long untilFailure = -1;
bool failsOnce = true;

}  // namespace bumper::tests

namespace {

using bumper::tests::failsOnce;
using bumper::tests::live;
using bumper::tests::untilFailure;

void* allocate(std::size_t size) {
  if (untilFailure == 0) {
    if (failsOnce) untilFailure = -1;
    throw std::bad_alloc();
  }
  if (untilFailure > 0) --untilFailure;
  void* memory = std::malloc(size);
  if (memory == nullptr) throw std::bad_alloc();
  ++live;
  return memory;
}

void release(void* memory) {
  if (memory != nullptr) --live;
  std::free(memory);
}

}  // namespace

void* operator new(std::size_t size) { return allocate(size); }
void* operator new[](std::size_t size) { return allocate(size); }
void operator delete(void* memory) noexcept { release(memory); }
void operator delete[](void* memory) noexcept { release(memory); }
void operator delete(void* memory, std::size_t /*size*/) noexcept { release(memory); }
void operator delete[](void* memory, std::size_t /*size*/) noexcept { release(memory); }
