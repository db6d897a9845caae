#include "caught_allocations.h"

#include <cstdlib>

namespace bumper::tests {

thread_local bool guarded = false;
thread_local int caught = 0;

}  // namespace bumper::tests

#ifndef __SANITIZE_ADDRESS__

extern "C" {
// The C library's own, under the names that it keeps for this purpose.
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);

void* malloc(std::size_t size) {
  if (bumper::tests::guarded) ++bumper::tests::caught;
  return __libc_malloc(size);
}
void* calloc(std::size_t nmemb, std::size_t size) {
  if (bumper::tests::guarded) ++bumper::tests::caught;
  return __libc_calloc(nmemb, size);
}
void* realloc(void* ptr, std::size_t size) {
  if (bumper::tests::guarded) ++bumper::tests::caught;
  return __libc_realloc(ptr, size);
}
}

#endif
