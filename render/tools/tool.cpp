#include "tool.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <sstream>
#include <utility>

#include "bumper/base/output_file.h"
#include "bumper/base/printing.h"

namespace bumper::tools {

int runMain(const char* name, int (*program)(int argc, char** argv), int argc, char** argv,
            int failed) {
  try {
    removeUnfinishedFilesOnSignals();
    const int code = program(argc, argv);
    closeStandardOutput();
    return code;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name, printable(error.what()).c_str());
    return failed;
  }
}

int runTool(CLI::App& app, int argc, char** argv, const std::function<void()>& job) {
  try {
    app.parse(argc, argv);
    job();
  } catch (const CLI::ParseError& error) {
    std::ostringstream words;
    const int code = app.exit(error, std::cout, words) == 0 ? 0 : 2;
    std::istringstream lines(words.str());
    for (std::string line; std::getline(lines, line);)
      std::fprintf(stderr, "%s\n", printable(line).c_str());
    return code;
  }
  return 0;
}

CLI::Validator numberIn(double low, double high) {
  std::ostringstream bounds;
  bounds << low << " to " << high;
  const auto check = [low, high, bounds = bounds.str()](const std::string& text) -> std::string {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    const bool isNumber = !text.empty() && *end == '\0';
    return isNumber && value >= low && value <= high ? "" : text + " is not in " + bounds;
  };
  return {check, "in [" + bounds.str() + "]", "numberIn"};
}

void addPatience(CLI::App& command, double& patience) {
  command
      .add_option("--patience", patience,
                  "how long the program that draws may do nothing before it is stopped, s")
      ->check(numberIn(0.01, 604800.0))
      ->capture_default_str();
}

std::string exitCodes() {
  return "Exit codes: 0 done, 1 failed (the reason is on standard error), 2 wrong command line.";
}

ProgressLine::ProgressLine(std::string work)
    : work_(std::move(work)), isTerminal_(isatty(STDERR_FILENO) != 0) {}

void ProgressLine::operator()(std::size_t done, std::size_t all) {
  const std::size_t parts = isTerminal_ ? 100 : 4;
  const std::size_t part = parts * done / all;
  if (part == shown_) return;
  shown_ = part;
  std::fprintf(stderr, "%s%s: %zu of %zu%s", isTerminal_ ? "\r" : "", work_.c_str(), done, all,
               isTerminal_ && done < all ? "" : "\n");
}

}  // namespace bumper::tools
