// What a program that a file has taken over can still do: the same calls in a child process that is
// confined as bumper-read-scene is.

#include "confinement.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <functional>
#include <string>

#include "temporary_files.h"

namespace bumper {
namespace {

long landlockVersion() { return syscall(SYS_landlock_create_ruleset, nullptr, 0, 1); }

class Confinement : public TemporaryFiles {
 protected:
  Confinement() {
    std::filesystem::create_directory(path("inside"));
    scene_ = write("inside/scene.obj", "v 0 0 0\n");
    static_cast<void>(write("inside/beside.mtl", "newmtl paint\n"));
    outside_ = write("outside.txt", "a secret\n");
    std::filesystem::create_symlink(outside_, path("inside/link.txt"));
  }

  /// Whether a call succeeds in a child process; −1 if it cannot be confined.
  [[nodiscard]] int canDo(const std::function<bool()>& call) const {
    const pid_t child = fork();
    if (child == 0) {
      std::signal(SIGXFSZ, SIG_IGN);
      limitResources(std::size_t{1} << 30U);
      if (!confineTo(scene_)) _exit(2);
      _exit(call() ? 1 : 0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status));
    return WEXITSTATUS(status) == 2 ? -1 : WEXITSTATUS(status);
  }

  static bool opens(const std::string& file, int flags) {
    return open(file.c_str(), flags, 0600) >= 0;
  }

  void SetUp() override {
    if (canDo([] { return true; }) < 0) GTEST_SKIP() << "no Landlock, or a sanitizer's build";
  }

  std::filesystem::path scene_;
  std::filesystem::path outside_;
};

TEST_F(Confinement, TheFoldersFilesCanBeRead) {
  EXPECT_TRUE(canDo([&] { return opens(scene_, O_RDONLY); }));
  EXPECT_TRUE(canDo([&] { return opens(path("inside/beside.mtl"), O_RDONLY); }));
}

TEST_F(Confinement, NothingElseCan) {
  EXPECT_FALSE(canDo([&] { return opens(outside_, O_RDONLY); }));
  EXPECT_FALSE(canDo([&] { return opens(path("inside/link.txt"), O_RDONLY); }));
  EXPECT_FALSE(canDo([] { return opens("/etc/passwd", O_RDONLY); }));
  EXPECT_FALSE(canDo([&] { return opens(path("."), O_RDONLY | O_DIRECTORY); }));
}

TEST_F(Confinement, NothingCanBeWrittenOrRemoved) {
  EXPECT_FALSE(canDo([&] { return opens(scene_, O_RDWR); }));
  EXPECT_FALSE(canDo([&] { return opens(scene_, O_RDONLY | O_TRUNC); }));
  EXPECT_FALSE(canDo([&] { return opens(path("inside/new"), O_WRONLY | O_CREAT); }));
  EXPECT_FALSE(canDo([&] { return unlink(scene_.c_str()) == 0; }));
  EXPECT_FALSE(canDo([&] { return truncate(scene_.c_str(), 0) == 0; }));
  EXPECT_TRUE(std::filesystem::file_size(scene_) > 0);
}

// Of a file that was open before nothing can be made longer.
TEST_F(Confinement, NoFileGrows) {
  const int file = open(path("open").c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  EXPECT_FALSE(canDo([&] { return ::write(file, "x", 1) == 1; }));
  close(file);
}

TEST_F(Confinement, NoProgramIsRunAndNoProcessStarted) {
  EXPECT_FALSE(canDo([] {
    execl("/bin/true", "true", nullptr);
    return false;
  }));
  if (getuid() == 0) GTEST_SKIP() << "root may start processes";
  EXPECT_FALSE(canDo([] {
    const pid_t child = fork();
    if (child == 0) _exit(0);
    return child > 0;
  }));
}

// A server that everybody may connect to, on this machine.
TEST_F(Confinement, NoPortIsConnectedTo) {
  if (landlockVersion() < 4) GTEST_SKIP() << "Landlock knows no network before Linux 6.7";
  const int server = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  auto* place = reinterpret_cast<sockaddr*>(&address);
  ASSERT_EQ(bind(server, place, size), 0);
  ASSERT_EQ(listen(server, 4), 0);
  getsockname(server, place, &size);
  const auto connects = [&] {
    return connect(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0), place, size) == 0;
  };
  EXPECT_TRUE(connects());
  EXPECT_FALSE(canDo(connects));
  close(server);
}

TEST_F(Confinement, NoOtherProcessIsSignalled) {
  if (landlockVersion() < 6) GTEST_SKIP() << "Landlock knows no signals before Linux 6.12";
  const pid_t self = getpid();
  EXPECT_FALSE(canDo([&] { return kill(self, 0) == 0; }));
}

}  // namespace
}  // namespace bumper
