#pragma once

#include <sys/types.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace bumper::drawing {

/// A running program that is fed through its standard input and does not outlive the object. What
/// it says on standard error is kept; its standard output goes nowhere.
class FedProgram {
 public:
  /// Looks for the program where PATH says unless its name holds a slash. Throws Error if it cannot
  /// be started.
  FedProgram(const std::string& program, const std::vector<std::string>& arguments);
  FedProgram(const FedProgram&) = delete;
  FedProgram& operator=(const FedProgram&) = delete;
  FedProgram(FedProgram&&) = delete;
  FedProgram& operator=(FedProgram&&) = delete;
  ~FedProgram();

  /// False if it takes nothing any more.
  bool feed(std::span<const std::byte> bytes);

  /// Ends its input and waits until it has ended. True if it then says that all went well.
  bool finish();

  /// The last line that it said on standard error.
  [[nodiscard]] std::string complaint() const;

 private:
  void closeInput();
  int wait();

  pid_t id_ = -1;
  int input_ = -1;
  int errors_ = -1;
};

}  // namespace bumper::drawing
