#include "read_isolated.h"

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

std::filesystem::path findProgram() {
  if (const char* given = std::getenv(programVariable); given != nullptr && *given != '\0') {
    if (access(given, X_OK) == 0) return given;
    throw Error(std::string(programVariable) + " is \"" + given + "\", which is not a program");
  }
  std::error_code error;
  // A build has its programs side by side; an installation may have been moved as a whole.
  const std::filesystem::path here =
      std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  std::filesystem::path beside = here / programName;
  if (!error && access(beside.c_str(), X_OK) == 0) return beside;
  std::filesystem::path moved = here.parent_path() / "libexec" / programName;
  if (!error && access(moved.c_str(), X_OK) == 0) return moved;
  std::filesystem::path installed = std::filesystem::path(BUMPER_LIBEXEC_DIRECTORY) / programName;
  if (access(installed.c_str(), X_OK) == 0) return installed;
  throw Error(std::string("the program ") + programName +
              ", which LoadOptions::isolate needs, is neither " + beside.string() + " nor " +
              moved.string() + " nor " + installed.string() + ": set " + programVariable +
              " to where it is");
}

std::unique_ptr<ChildProcess> start(const std::filesystem::path& program,
                                    const std::filesystem::path& file, const LoadOptions& options) {
  // In case that nobody is left to stop it.
  const auto alarm = static_cast<unsigned>(std::min(options.timeout, 1e9)) + 2U;
  const std::vector<std::string> arguments{file.string(), std::to_string(options.memoryLimit),
                                           std::to_string(alarm)};
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
  std::optional<ReadResult> result = unpack(bytes);
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
