#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>

namespace bumper::examples {

/// Reads the command line and runs the job. Returns the exit code: 0, or 2 if the command line is
/// wrong; what the job throws is main's to report, with exit code 1.
int runTool(CLI::App& app, int argc, char** argv, const std::function<void()>& job);

/// The end of a tool's --help.
std::string exitCodes();

/// Makes a folder for results unless it exists. Throws Error, naming it, if that fails.
void makeFolder(const std::filesystem::path& folder);

/// Tells on standard error how far a long work is, in one line on a terminal, else in quarters.
class ProgressLine {
 public:
  explicit ProgressLine(std::string work);
  void operator()(std::size_t done, std::size_t all);

 private:
  std::string work_;
  bool isTerminal_;
  std::size_t shown_ = 0;
};

}  // namespace bumper::examples
