#include "bumper/base/output_file.h"

#include <fcntl.h>
#include <linux/magic.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <sys/vfs.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <set>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include "bumper/response/error.h"

namespace bumper {

namespace {

constexpr mode_t allBits = 07777;  // of a mode, without the file's kind

/// Names of files that are not in their place. Never destroyed: a thread may use it to the end.
struct UnfinishedFiles {
  std::mutex mutex;
  std::set<std::filesystem::path> names;
};

UnfinishedFiles& unfinishedFiles() {
  static auto* const files = new UnfinishedFiles;
  return *files;
}

/// Whether a link is one of those by which processes show their open files.
bool isOfProcess(const std::filesystem::path& link) {
  struct statfs system {};
  const std::filesystem::path folder = link.parent_path();
  return statfs(folder.empty() ? "." : folder.c_str(), &system) == 0 &&
         system.f_type == PROC_SUPER_MAGIC;
}

/// False, with errno, if not all could be written.
bool writeAll(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(file, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

/// False, with errno. True for what has no disk behind it.
bool reachesDisk(int file) {
  return fsync(file) == 0 || errno == EINVAL || errno == ENOTSUP || errno == EROFS;
}

/// 16 hexadecimal digits.
std::string randomDigits() {
  std::uint64_t bits = 0;
  if (getrandom(&bits, sizeof bits, 0) != sizeof bits)
    throw std::system_error(errno, std::generic_category());
  std::array<char, 17> digits{};
  std::snprintf(digits.data(), digits.size(), "%016jx", std::uintmax_t{bits});
  return digits.data();
}

/// A pipe whose reader is gone is an error of write() for the calling thread, and no signal.
class WithoutPipeSignal {
 public:
  WithoutPipeSignal() {
    sigemptyset(&pipe_);
    sigaddset(&pipe_, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
  }
  ~WithoutPipeSignal() {
    constexpr timespec now{};
    while (sigismember(&before_, SIGPIPE) == 0 && sigtimedwait(&pipe_, nullptr, &now) > 0) {
    }
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  WithoutPipeSignal(const WithoutPipeSignal&) = delete;
  WithoutPipeSignal& operator=(const WithoutPipeSignal&) = delete;
  WithoutPipeSignal(WithoutPipeSignal&&) = delete;
  WithoutPipeSignal& operator=(WithoutPipeSignal&&) = delete;

 private:
  sigset_t pipe_{};
  sigset_t before_{};
};

}  // namespace

void makeFolder(const std::filesystem::path& folder) {
  if (folder.empty()) return;
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (!failure && !std::filesystem::is_directory(folder, failure))
    failure = std::make_error_code(std::errc::not_a_directory);
  if (failure) throw Error("cannot make the folder " + folder.string() + ": " + failure.message());
}

void syncToDisk(const std::filesystem::path& file) {
  std::error_code failure;
  if (!std::filesystem::is_regular_file(file, failure)) return;
  const Descriptor opened(open(file.c_str(), O_RDONLY | O_CLOEXEC));
  if (opened.number() < 0 || !reachesDisk(opened.number()))
    throw Error("cannot write " + file.string() + " to the disk: " + std::strerror(errno));
}

OutputFile::OutputFile(std::filesystem::path place) : place_(std::move(place)), target_(place_) {
  findTarget();
  isReplaced_ ? makeBeside() : makeNameless();
  path_ = "/proc/" + std::to_string(getpid()) + "/fd/" + std::to_string(file_.number());
}

OutputFile::~OutputFile() {
  if (beside_.empty()) return;
  UnfinishedFiles& unfinished = unfinishedFiles();
  const std::lock_guard lock(unfinished.mutex);
  unlink(beside_.c_str());
  unfinished.names.erase(beside_);
}

void OutputFile::findTarget() {
  constexpr int mostLinks = 40;  // as the system follows
  for (int links = 0; links <= mostLinks; ++links) {
    struct stat status {};
    const std::filesystem::path name = target_.filename();
    if (name.empty() || name == "." || name == "..") fail("it is a folder");
    if (lstat(target_.c_str(), &status) != 0) {
      if (errno != ENOENT) require(false);
      return;
    }
    if (S_ISDIR(status.st_mode)) fail("it is a folder");
    if (!S_ISLNK(status.st_mode) || isOfProcess(target_)) {
      isReplaced_ = S_ISREG(status.st_mode);
      old_ = {status.st_mode & allBits, status.st_uid, status.st_gid};
      require(faccessat(AT_FDCWD, target_.c_str(), W_OK, AT_EACCESS) == 0);
      return;
    }
    std::error_code failure;
    const std::filesystem::path onwards = std::filesystem::read_symlink(target_, failure);
    if (failure) fail(failure.message());
    target_ = target_.parent_path() / onwards;
  }
  fail(std::strerror(ELOOP));
}

void OutputFile::makeBeside() {
  constexpr std::size_t mostOfName = 200;  // bytes: a name has 255
  const std::string name = target_.filename().string().substr(0, mostOfName);
  // What others may not read is not theirs to read meanwhile.
  const mode_t mode =
      old_ ? S_IRUSR | S_IWUSR : S_IRUSR | S_IWUSR | S_IRGRP | S_IWGRP | S_IROTH | S_IWOTH;
  UnfinishedFiles& unfinished = unfinishedFiles();
  const std::lock_guard lock(unfinished.mutex);
  do {
    beside_ = target_.parent_path() / ("." + name + "." + randomDigits() + ".part");
    file_ = Descriptor(open(beside_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, mode));
  } while (file_.number() < 0 && errno == EEXIST);
  if (file_.number() < 0) {
    beside_.clear();
    require(false);
  }
  unfinished.names.insert(beside_);
}

void OutputFile::makeNameless() {
  std::error_code failure;
  std::string name = (std::filesystem::temp_directory_path(failure) / "bumper_XXXXXX").string();
  if (failure) fail(failure.message());
  file_ = Descriptor(mkostemp(name.data(), O_CLOEXEC));
  require(file_.number() >= 0);
  unlink(name.c_str());
}

void OutputFile::write(std::initializer_list<std::string_view> parts) const {
  require(lseek(file_.number(), 0, SEEK_SET) == 0 && ftruncate(file_.number(), 0) == 0);
  for (const std::string_view part : parts) require(writeAll(file_.number(), part));
}

std::uintmax_t OutputFile::size() const {
  struct stat status {};
  require(fstat(file_.number(), &status) == 0);
  return static_cast<std::uintmax_t>(status.st_size);
}

void OutputFile::copyTo(int target) const {
  const WithoutPipeSignal quiet;
  require(lseek(file_.number(), 0, SEEK_SET) == 0);
  std::array<char, 65536> block{};
  for (;;) {
    const ssize_t got = read(file_.number(), block.data(), block.size());
    if (got < 0 && errno == EINTR) continue;
    require(got >= 0);
    if (got == 0) return;
    require(writeAll(target, {block.data(), static_cast<std::size_t>(got)}));
  }
}

void OutputFile::moveToPlace() {
  if (!isReplaced_) {
    Descriptor target(open(target_.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC | O_NOCTTY));
    require(target.number() >= 0);
    copyTo(target.number());
    require(reachesDisk(target.number()));
    require(::close(target.release()) == 0);
    return;
  }
  if (old_) {
    // Before the mode, which it changes; that it is not allowed is no failure.
    [[maybe_unused]] const int isAllowed = fchown(file_.number(), old_->owner, old_->group);
    (void)fchmod(file_.number(), old_->mode);
  }
  require(reachesDisk(file_.number()));
  struct stat status {};
  if (lstat(target_.c_str(), &status) == 0 && !S_ISREG(status.st_mode))
    fail("it is no regular file any more");
  require(rename(beside_.c_str(), target_.c_str()) == 0);
  {
    UnfinishedFiles& unfinished = unfinishedFiles();
    const std::lock_guard lock(unfinished.mutex);
    unfinished.names.erase(beside_);
  }
  beside_.clear();
  // The name too; a folder that may not be read keeps it none the less.
  const std::filesystem::path folder = target_.parent_path();
  const Descriptor opened(open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_CLOEXEC));
  if (opened.number() >= 0) (void)fsync(opened.number());
}

/// After a system call.
void OutputFile::require(bool succeeded) const {
  if (!succeeded) fail(std::strerror(errno));
}

void OutputFile::fail(std::string_view reason) const {
  throw Error("cannot write " + place_.string() + ": " + std::string(reason) +
              "; its folder must exist, be writable and have room");
}

void removeUnfinishedFilesOnSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGHUP, SIGINT, SIGTERM}) {
    struct sigaction action {};
    sigaction(signal, nullptr, &action);
    if (action.sa_handler != SIG_IGN) sigaddset(&signals, signal);
  }
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::thread([signals] {
    int signal = 0;
    if (sigwait(&signals, &signal) != 0) return;
    // Held to the end: no file is made any more.
    UnfinishedFiles& unfinished = unfinishedFiles();
    unfinished.mutex.lock();
    for (const std::filesystem::path& name : unfinished.names) unlink(name.c_str());
    std::signal(signal, SIG_DFL);
    sigset_t mine = signals;
    pthread_sigmask(SIG_UNBLOCK, &mine, nullptr);
    raise(signal);
  }).detach();
}

}  // namespace bumper
