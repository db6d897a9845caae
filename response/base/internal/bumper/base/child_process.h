#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bumper/base/api.h"

namespace BUMPER_INTERNAL bumper {

/// Which of a child's standard streams are connected to this process. The others are /dev/null.
struct ChildStreams {
  bool input = false;   ///< for ChildProcess::write()
  bool output = false;  ///< to be read from ChildProcess::output()
  bool errors = false;  ///< kept for ChildProcess::lastErrorLine()
};

/// A child process that does not outlive the object. No signal is blocked or ignored in it, it
/// holds no other child's streams, and no shell takes part.
class ChildProcess {
 public:
  /// Looks for the program where PATH says unless its name holds a slash. Throws std::system_error
  /// if it cannot be started.
  ChildProcess(const std::string& program, const std::vector<std::string>& arguments,
               ChildStreams streams);
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ChildProcess(ChildProcess&&) = delete;
  ChildProcess& operator=(ChildProcess&&) = delete;
  /// Kills it if it still runs.
  ~ChildProcess();

  /// How long it may take for each step; nothing: for ever. Not more than a week.
  using Patience = std::optional<std::chrono::milliseconds>;

  /// Blocks while it is busy. False if it reads no more, or nothing for so long.
  bool write(std::span<const std::byte> bytes, Patience patience = {});

  /// Puts the next of its output in place of the text. False, and the text is empty, at the
  /// output's end, or if nothing comes for so long.
  bool read(std::string& text, Patience patience = {});

  /// Descriptor of a pipe's end, which the object closes. −1 if the output is not connected.
  [[nodiscard]] int output() const { return output_; }

  // How it ended, as waitpid() gives it; 0 if the application ignores SIGCHLD, so that it is
  // unknown.

  /// Closes its input and waits until it has ended; one that takes longer is killed.
  int wait(Patience patience = {});
  /// Kills it unless it has ended already.
  int kill();

  /// Whether it has tried someone's patience.
  [[nodiscard]] bool hasStalled() const { return hasStalled_; }

  /// The last line that it wrote to standard error; empty if these are not kept.
  [[nodiscard]] std::string lastErrorLine() const;

 private:
  pid_t id_ = -1;
  int status_ = 0;
  int input_ = -1;
  int output_ = -1;
  int errors_ = -1;
  bool hasStalled_ = false;
};

/// Whether a status of waitpid() is that of a program that ended by itself, with exit code 0.
bool hasSucceeded(int status);

}  // namespace bumper
