#include "read_isolated.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
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
#include <optional>
#include <string>
#include <utility>

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

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  [[nodiscard]] int number() const { return number_; }
  void close() {
    if (number_ >= 0) ::close(std::exchange(number_, -1));
  }

 private:
  int number_;
};

/// A running program, which does not outlive the object.
class Process {
 public:
  explicit Process(pid_t id) : id_(id) {}
  ~Process() { end(); }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// Kills it unless it has ended already, and gives its status as waitpid() does; 0 if the
  /// application has arranged for its children's ends to go unnoticed.
  int end() {
    if (id_ < 0) return status_;
    kill(id_, SIGKILL);
    pid_t waited = 0;
    do {
      waited = waitpid(id_, &status_, 0);
    } while (waited < 0 && errno == EINTR);
    if (waited < 0) status_ = 0;
    id_ = -1;
    return status_;
  }

 private:
  pid_t id_;
  int status_ = 0;
};

/// What posix_spawn() is told: standard output goes into the pipe, nothing else is inherited that
/// the program could disturb or be disturbed by.
class SpawnSettings {
 public:
  explicit SpawnSettings(int output) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_adddup2(&actions_, output, STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions_, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawnattr_init(&attributes_);
    sigset_t signals;
    sigemptyset(&signals);
    posix_spawnattr_setsigmask(&attributes_, &signals);
    sigfillset(&signals);
    posix_spawnattr_setsigdefault(&attributes_, &signals);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  }
  ~SpawnSettings() {
    posix_spawn_file_actions_destroy(&actions_);
    posix_spawnattr_destroy(&attributes_);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;

  [[nodiscard]] const posix_spawn_file_actions_t* actions() const { return &actions_; }
  [[nodiscard]] const posix_spawnattr_t* attributes() const { return &attributes_; }

 private:
  posix_spawn_file_actions_t actions_{};
  posix_spawnattr_t attributes_{};
};

pid_t start(const std::filesystem::path& program, const std::filesystem::path& file,
            const LoadOptions& options, int output) {
  std::string programText = program.string();
  std::string fileText = file.string();
  std::string memory = std::to_string(options.memoryLimit);
  // In case that nobody is left to stop it.
  std::string alarm = std::to_string(static_cast<unsigned>(std::min(options.timeout, 1e9)) + 2U);
  const std::array<char*, 5> arguments{programText.data(), fileText.data(), memory.data(),
                                       alarm.data(), nullptr};
  const SpawnSettings settings(output);
  pid_t id = -1;
  const int failure = posix_spawn(&id, program.c_str(), settings.actions(), settings.attributes(),
                                  arguments.data(), environ);
  if (failure == 0) return id;
  throw fileError(
      file, "cannot be read: starting \"" + programText + "\" failed: " + std::strerror(failure));
}

/// Everything that comes out of the pipe, to its end.
std::string readToEnd(const Descriptor& pipe, const std::filesystem::path& file,
                      const LoadOptions& options, const Progress& progress) {
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
    pollfd waitFor{pipe.number(), POLLIN, 0};
    const int wait = static_cast<int>(std::min(std::ceil(left.count()), progressInterval));
    if (poll(&waitFor, 1, wait) <= 0) {
      progress(LoadStage::reading, 0.0);
      continue;
    }
    const ssize_t got = read(pipe.number(), block.data(), block.size());
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
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw fileError(file, std::string("cannot be read: no pipe: ") + std::strerror(errno));
  }
  const Descriptor output(ends[0]);
  Descriptor input(ends[1]);
  Process process(start(program, file, options, input.number()));
  input.close();
  const std::string bytes = readToEnd(output, file, options, progress);
  const int status = process.end();

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
