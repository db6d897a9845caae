#include "bumper/base/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <system_error>
#include <thread>
#include <utility>

#include "bumper/base/descriptor.h"

namespace bumper {

namespace {

void require(bool succeeded) {
  if (!succeeded) throw std::system_error(errno, std::generic_category());
}

/// Whether a descriptor is ready, or its other end gone, within the time.
bool isReadyIn(int descriptor, short events, std::chrono::milliseconds time) {
  const auto until = std::chrono::steady_clock::now() + time;
  for (;;) {
    const auto left =
        std::chrono::ceil<std::chrono::milliseconds>(until - std::chrono::steady_clock::now());
    pollfd waited{descriptor, events, 0};
    const int ready = poll(&waited, 1, static_cast<int>(std::max<std::int64_t>(left.count(), 0)));
    if (ready >= 0 || errno != EINTR) return ready > 0;
  }
}

/// Leaves its status to be waited for. True for one of which nothing is known.
bool hasEnded(pid_t child) {
  siginfo_t state{};
  return waitid(P_PID, static_cast<id_t>(child), &state, WEXITED | WNOHANG | WNOWAIT) != 0 ||
         state.si_pid != 0;
}

/// What posix_spawn() is given.
class SpawnSettings {
 public:
  SpawnSettings() {
    posix_spawn_file_actions_init(&actions_);
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
  SpawnSettings(SpawnSettings&&) = delete;
  SpawnSettings& operator=(SpawnSettings&&) = delete;

  /// The child's standard stream is this descriptor, or /dev/null if it is none.
  void connect(int stream, const Descriptor& descriptor) {
    if (descriptor.number() >= 0) {
      posix_spawn_file_actions_adddup2(&actions_, descriptor.number(), stream);
    } else {
      const int mode = stream == STDIN_FILENO ? O_RDONLY : O_WRONLY;
      posix_spawn_file_actions_addopen(&actions_, stream, "/dev/null", mode, 0);
    }
  }

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
    if (failure != 0) throw std::system_error(failure, std::generic_category());
    return id;
  }

 private:
  posix_spawn_file_actions_t actions_{};
  posix_spawnattr_t attributes_{};
};

}  // namespace

ChildProcess::ChildProcess(const std::string& program, const std::vector<std::string>& arguments,
                           ChildStreams streams) {
  Descriptor input;
  Descriptor output;
  Descriptor errors;
  Descriptor childInput;
  Descriptor childOutput;
  std::array<int, 2> ends{-1, -1};
  if (streams.input) {
    // A socket rather than a pipe: writing to one without a reader raises no signal.
    require(socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) == 0);
    childInput = Descriptor(ends[0]);
    input = Descriptor(ends[1]);
  }
  if (streams.output) {
    require(pipe2(ends.data(), O_CLOEXEC) == 0);
    output = Descriptor(ends[0]);
    childOutput = Descriptor(ends[1]);
  }
  if (streams.errors) {
    errors = Descriptor(memfd_create("standard error", MFD_CLOEXEC));
    require(errors.number() >= 0);
  }
  SpawnSettings settings;
  settings.connect(STDIN_FILENO, childInput);
  settings.connect(STDOUT_FILENO, childOutput);
  settings.connect(STDERR_FILENO, errors);
  id_ = settings.start(program, arguments);
  input_ = input.release();
  output_ = output.release();
  errors_ = errors.release();
}

ChildProcess::~ChildProcess() {
  kill();
  for (const int descriptor : {input_, output_, errors_})
    if (descriptor >= 0) close(descriptor);
}

bool ChildProcess::write(std::span<const std::byte> bytes, Patience patience) {
  while (!bytes.empty()) {
    const ssize_t sent =
        send(input_, bytes.data(), bytes.size(), MSG_NOSIGNAL | (patience ? MSG_DONTWAIT : 0));
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0 && errno == EAGAIN) {
      if (isReadyIn(input_, POLLOUT, *patience)) continue;
      hasStalled_ = true;
      return false;
    }
    if (sent < 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(sent));
  }
  return true;
}

bool ChildProcess::read(std::string& text, Patience patience) {
  std::array<char, 65536> block{};
  for (;;) {
    if (patience && !isReadyIn(output_, POLLIN, *patience)) {
      hasStalled_ = true;
      return false;
    }
    const ssize_t got = ::read(output_, block.data(), block.size());
    if (got < 0 && errno == EINTR) continue;
    text.assign(block.data(), got > 0 ? static_cast<std::size_t>(got) : 0);
    return got > 0;
  }
}

int ChildProcess::wait(Patience patience) {
  if (input_ >= 0) close(std::exchange(input_, -1));
  if (id_ < 0) return status_;
  if (patience) {
    // Ever less often: most end at once.
    constexpr std::chrono::milliseconds longest{50};
    const auto until = std::chrono::steady_clock::now() + *patience;
    for (std::chrono::milliseconds pause{1}; !hasEnded(id_); pause = std::min(2 * pause, longest)) {
      if (std::chrono::steady_clock::now() >= until) {
        hasStalled_ = true;
        return kill();
      }
      std::this_thread::sleep_for(pause);
    }
  }
  pid_t waited = 0;
  do {
    waited = waitpid(id_, &status_, 0);
  } while (waited < 0 && errno == EINTR);
  if (waited < 0) status_ = 0;
  id_ = -1;
  return status_;
}

int ChildProcess::kill() {
  if (id_ >= 0) ::kill(id_, SIGKILL);
  return wait({});
}

std::string ChildProcess::lastErrorLine() const {
  if (errors_ < 0) return "";
  constexpr off_t most = 4096;  // bytes
  const off_t end = lseek(errors_, 0, SEEK_END);
  std::string text(most, '\0');
  const ssize_t got = pread(errors_, text.data(), text.size(), end > most ? end - most : 0);
  text.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
  return text.substr(text.find_last_of("\r\n") + 1);
}

bool hasSucceeded(int status) { return WIFEXITED(status) && WEXITSTATUS(status) == 0; }

}  // namespace bumper
