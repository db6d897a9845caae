#pragma once

// What shared libraries let others see. By GCC everything is hidden that does not stand in a
// namespace opened with one of these:
//
//   namespace BUMPER_API bumper {
//
// A class of which such a header tells the name alone is BUMPER_HIDDEN where it is defined.

/// In every public header.
#define BUMPER_API [[gnu::visibility("default")]]

/// In a header that another of Bumper's own libraries includes. It is not installed, and what it
/// declares may be gone in the next version.
#define BUMPER_INTERNAL [[gnu::visibility("default")]]

#define BUMPER_HIDDEN [[gnu::visibility("hidden")]]
