#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cerrno>
#include <cstddef>
#include <filesystem>
#include <iterator>

namespace bumper {

inline std::ptrdiff_t openDescriptors() {
  return std::distance(std::filesystem::directory_iterator("/proc/self/fd"), {});
}

/// Fails the test if, when it goes, there is a child process, dead or alive, or a descriptor more
/// or less than when it came.
class NothingLeftBehind {
 public:
  NothingLeftBehind() = default;
  ~NothingLeftBehind() {
    EXPECT_EQ(openDescriptors(), descriptors_);
    EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "a child process is left";
    EXPECT_EQ(errno, ECHILD);
  }
  NothingLeftBehind(const NothingLeftBehind&) = delete;
  NothingLeftBehind& operator=(const NothingLeftBehind&) = delete;

 private:
  std::ptrdiff_t descriptors_ = openDescriptors();
};

}  // namespace bumper
