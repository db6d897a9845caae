#include "tool.h"

#include <unistd.h>

#include <cstdio>
#include <exception>
#include <utility>

namespace bumper::tools {

int runMain(const char* name, int (*program)(int argc, char** argv), int argc, char** argv) {
  try {
    return program(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name, error.what());
    return 1;
  }
}

int runTool(CLI::App& app, int argc, char** argv, const std::function<void()>& job) {
  try {
    app.parse(argc, argv);
    job();
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  return 0;
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
