#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <functional>
#include <string>

namespace bumper::tools {

/// The whole of a main(): what `program` throws is printed on standard error after the name, with
/// exit code `failed`; so is it if standard output cannot be written. A signal leaves no unfinished
/// file.
int runMain(const char* name, int (*program)(int argc, char** argv), int argc, char** argv,
            int failed = 1);

/// Reads the command line and runs the job. Returns the exit code: 0, or 2 if the command line is
/// wrong. Throws what the job throws.
int runTool(CLI::App& app, int argc, char** argv, const std::function<void()>& job);

/// For an option whose numbers lie within these bounds, which may be infinite; NaN never does.
CLI::Validator numberIn(double low, double high);

/// Adds --patience, s.
void addPatience(CLI::App& command, double& patience);

/// The end of a tool's --help.
std::string exitCodes();

/// Prints on standard error how far a long job is, in one line on a terminal, else in quarters.
class ProgressLine {
 public:
  explicit ProgressLine(std::string work);
  void operator()(std::size_t done, std::size_t all);

 private:
  std::string work_;
  bool isTerminal_;
  std::size_t shown_ = 0;
};

}  // namespace bumper::tools
