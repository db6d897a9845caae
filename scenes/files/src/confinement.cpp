#include "confinement.h"

#include <fcntl.h>
#include <linux/landlock.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cstdint>

namespace bumper {

// A sanitizer maps terabytes, and looks at its own process from outside when this ends.
#ifdef __SANITIZE_ADDRESS__

void limitResources(std::size_t /*memory*/) {}
bool confineTo(const std::filesystem::path& /*file*/) { return false; }

#else

namespace {

void setLimit(decltype(RLIMIT_AS) resource, rlim_t value) {
  const rlimit limit{value, value};
  setrlimit(resource, &limit);
}

// As in Linux 6.12, whose header may be newer than the one that this is compiled with: what a
// kernel does not know yet is left out.
struct Ruleset {
  std::uint64_t files = 0;
  std::uint64_t network = 0;
  std::uint64_t scopes = 0;
};

struct Version {
  long from;          ///< of Landlock's interface
  unsigned fileBits;  ///< how many kinds of access it knows
  std::size_t size;   ///< of the ruleset, bytes
};

constexpr std::uint64_t bits(unsigned count) { return (std::uint64_t{1} << count) - 1; }

/// All that the kernel can forbid, and for the ruleset's size.
std::size_t everything(long version, Ruleset& ruleset) {
  constexpr std::array versions{Version{6, 16, 24}, Version{5, 16, 16}, Version{4, 15, 16},
                                Version{3, 15, 8},  Version{2, 14, 8},  Version{1, 13, 8}};
  for (const Version& each : versions) {
    if (version < each.from) continue;
    ruleset.files = bits(each.fileBits);
    if (version >= 4) ruleset.network = bits(2);
    if (version >= 6) ruleset.scopes = bits(2);
    return each.size;
  }
  return 0;
}

void allow(int ruleset, const std::filesystem::path& place, int flags, std::uint64_t access) {
  const int descriptor = open(place.c_str(), O_PATH | O_CLOEXEC | flags);
  if (descriptor < 0) return;
  landlock_path_beneath_attr rule{};
  rule.allowed_access = access;
  rule.parent_fd = descriptor;
  syscall(SYS_landlock_add_rule, ruleset, LANDLOCK_RULE_PATH_BENEATH, &rule, 0);
  close(descriptor);
}

}  // namespace

void limitResources(std::size_t memory) {
  setLimit(RLIMIT_CORE, 0);
  setLimit(RLIMIT_AS, memory);
  setLimit(RLIMIT_FSIZE, 0);
  setLimit(RLIMIT_NPROC, 0);
}

bool confineTo(const std::filesystem::path& file) {
  if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return false;
  const long version =
      syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
  Ruleset wanted;
  const std::size_t size = everything(version, wanted);
  if (size == 0) return false;
  const auto ruleset = static_cast<int>(syscall(SYS_landlock_create_ruleset, &wanted, size, 0));
  if (ruleset < 0) return false;
  allow(ruleset, file, 0, LANDLOCK_ACCESS_FS_READ_FILE);
  const std::filesystem::path folder = file.parent_path();
  allow(ruleset, folder.empty() ? "." : folder, O_DIRECTORY,
        LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR);
  const bool isConfined = syscall(SYS_landlock_restrict_self, ruleset, 0) == 0;
  close(ruleset);
  return isConfined;
}

#endif

}  // namespace bumper
