#include "fed_program.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#include "bumper/response/error.h"

namespace bumper::drawing {

namespace {

/// What posix_spawn() is told: nothing is inherited but the three standard streams, and no signal
/// is blocked or ignored.
class SpawnSettings {
 public:
  SpawnSettings(int input, int errors) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_adddup2(&actions_, input, STDIN_FILENO);
    posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&actions_, errors, STDERR_FILENO);
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

  [[nodiscard]] pid_t start(const std::string& program,
                            const std::vector<std::string>& arguments) const {
    std::vector<std::string> words{program};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    pointers.reserve(words.size() + 1);
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    pid_t id = -1;
    const int failure =
        posix_spawnp(&id, program.c_str(), &actions_, &attributes_, pointers.data(), environ);
    if (failure == 0) return id;
    throw Error("the program " + program + " cannot be started: " + std::strerror(failure));
  }

 private:
  posix_spawn_file_actions_t actions_{};
  posix_spawnattr_t attributes_{};
};

}  // namespace

FedProgram::FedProgram(const std::string& program, const std::vector<std::string>& arguments) {
  // A socket rather than a pipe: writing to one that nobody reads any more raises no signal.
  std::array<int, 2> ends{-1, -1};
  errors_ = memfd_create("standard error", MFD_CLOEXEC);
  if (errors_ < 0 || socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    const std::string reason = std::strerror(errno);
    if (errors_ >= 0) close(errors_);
    throw Error("the program " + program + " cannot be started: " + reason);
  }
  input_ = ends[1];
  try {
    id_ = SpawnSettings(ends[0], errors_).start(program, arguments);
  } catch (...) {
    close(ends[0]);
    close(input_);
    close(errors_);
    throw;
  }
  close(ends[0]);
}

FedProgram::~FedProgram() {
  if (id_ >= 0) kill(id_, SIGKILL);
  closeInput();
  wait();
  close(errors_);
}

void FedProgram::closeInput() {
  if (input_ >= 0) close(std::exchange(input_, -1));
}

int FedProgram::wait() {
  if (id_ < 0) return 0;
  int status = 0;
  pid_t waited = 0;
  do {
    waited = waitpid(id_, &status, 0);
  } while (waited < 0 && errno == EINTR);
  id_ = -1;
  return waited < 0 ? 0 : status;
}

bool FedProgram::feed(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = send(input_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(sent));
  }
  return true;
}

bool FedProgram::finish() {
  closeInput();
  const int status = wait();
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

std::string FedProgram::complaint() const {
  std::string text(4096, '\0');
  const off_t end = lseek(errors_, 0, SEEK_END);
  const off_t from = end > 4096 ? end - 4096 : 0;
  const ssize_t got = pread(errors_, text.data(), text.size(), from);
  text.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
  return text.substr(text.find_last_of("\r\n") + 1);
}

}  // namespace bumper::drawing
