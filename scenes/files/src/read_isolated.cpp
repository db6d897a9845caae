#include "read_isolated.h"

#include <dlfcn.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "bumper/base/child_process.h"
#include "scene_stream.h"

namespace bumper {

namespace {

constexpr const char* programName = "bumper-read-scene";
constexpr double progressInterval = 100.0;  // ms
constexpr const char* programVariable = "BUMPER_READ_SCENE";

/// Where the program may stand, in the order of the search. A build has its programs side by side;
/// an installation may be in another place than was configured, but is so as a whole.
std::vector<std::filesystem::path> programFolders() {
  std::vector<std::filesystem::path> folders;
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  if (!error) {
    folders.push_back(self.parent_path());
    folders.push_back(self.parent_path() / BUMPER_LIBEXEC_FROM_BIN);
  }
  // This code may be in a shared library, of which the running program knows nothing else.
  Dl_info library{};
  if (dladdr(&programName, &library) != 0 && library.dli_fname != nullptr) {
    const std::filesystem::path file = std::filesystem::canonical(library.dli_fname, error);
    if (!error && file != self) folders.push_back(file.parent_path() / BUMPER_LIBEXEC_FROM_LIB);
  }
  folders.emplace_back(BUMPER_LIBEXEC_DIRECTORY);
  return folders;
}

std::filesystem::path findProgram() {
  if (const char* given = std::getenv(programVariable); given != nullptr && *given != '\0') {
    if (access(given, X_OK) == 0) return given;
    throw Error(std::string(programVariable) + " is \"" + given + "\", which is not a program");
  }
  std::string tried;
  for (const std::filesystem::path& folder : programFolders()) {
    std::filesystem::path program = (folder / programName).lexically_normal();
    if (access(program.c_str(), X_OK) == 0) return program;
    tried += (tried.empty() ? "" : " nor ") + program.string();
  }
  throw Error(std::string("the program ") + programName + ", which loadScene() needs, is neither " +
              tried + ": set " + programVariable + " to where it is");
}

std::unique_ptr<ChildProcess> start(const std::filesystem::path& program,
                                    const std::filesystem::path& file, const LoadOptions& options) {
  // In case that nobody is left to stop it.
  const auto alarm = static_cast<unsigned>(std::min(options.timeout, 1e9)) + 2U;
  const SceneBudget& budget = options.budget;
  std::vector<std::string> arguments{file.string()};
  for (const std::size_t number : {options.memoryLimit, std::size_t{alarm}, budget.triangles,
                                   budget.nodes, budget.names, budget.nameLength}) {
    arguments.push_back(std::to_string(number));
  }
  try {
    // Absolute, so that it is not looked for in PATH.
    return std::make_unique<ChildProcess>(std::filesystem::absolute(program).string(), arguments,
                                          ChildStreams{.output = true});
  } catch (const std::system_error& error) {
    throw fileError(file, "cannot be read: starting \"" + program.string() +
                              "\" failed: " + error.code().message());
  }
}

/// Everything that comes out of the pipe, to its end.
std::string readToEnd(int pipe, const std::filesystem::path& file, const LoadOptions& options,
                      const Progress& progress) {
  using Clock = std::chrono::steady_clock;
  const auto deadline =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(
                         std::chrono::duration<double>(std::min(options.timeout, 1e9)));
  const std::size_t longest = longestAnswer(options.budget);
  std::string bytes;
  std::array<char, 65536> block{};
  for (;;) {
    const std::chrono::duration<double, std::milli> left = deadline - Clock::now();
    if (left.count() <= 0.0) {
      throw fileError(file, "cannot be read: it takes longer than LoadOptions::timeout, " +
                                std::to_string(options.timeout) + " s");
    }
    pollfd waitFor{pipe, POLLIN, 0};
    const int wait = static_cast<int>(std::min(std::ceil(left.count()), progressInterval));
    if (poll(&waitFor, 1, wait) <= 0) {
      progress(LoadStage::reading, 0.0);
      continue;
    }
    const ssize_t got = read(pipe, block.data(), block.size());
    if (got == 0) return bytes;
    if (got < 0) {
      if (errno == EINTR) continue;
      throw fileError(file, std::string("cannot be read: ") + std::strerror(errno));
    }
    bytes.append(block.data(), static_cast<std::size_t>(got));
    if (bytes.size() > options.memoryLimit) {
      throw fileError(file, "cannot be read: it needs more than LoadOptions::memoryLimit, " +
                                std::to_string(options.memoryLimit) + " bytes");
    }
    if (bytes.size() > longest) {
      throw fileError(file,
                      "cannot be read: the answer is longer than any within "
                      "LoadOptions::budget, " +
                          std::to_string(longest) + " bytes");
    }
  }
}

}  // namespace

FileScene readIsolated(const std::filesystem::path& file, const LoadOptions& options,
                       const Progress& progress) {
  progress(LoadStage::reading, 0.0);
  const std::filesystem::path program = findProgram();
  const std::unique_ptr<ChildProcess> reader = start(program, file, options);
  const std::string bytes = readToEnd(reader->output(), file, options, progress);
  const int status = reader->kill();

  if (WIFSIGNALED(status) && WTERMSIG(status) != SIGKILL) {
    throw fileError(file, std::string("cannot be read: it crashes the reader (") +
                              strsignal(WTERMSIG(status)) + ")");
  }
  std::optional<ReadResult> result = unpack(bytes, options.budget);
  if (!result) {
    throw fileError(
        file, "cannot be read: " + program.string() + " ended without an answer that makes sense");
  }
  if (const auto* message = std::get_if<std::string>(&*result)) throw Error(*message);
  // The program has read and converted.
  progress(LoadStage::reading, 1.0);
  progress(LoadStage::converting, 0.0);
  auto& read = std::get<FileScene>(*result);
  try {
    validate(read.scene);
  } catch (const Error& error) {
    throw fileError(file, std::string("cannot be read: ") + error.what());
  }
  return std::move(read);
}

}  // namespace bumper
