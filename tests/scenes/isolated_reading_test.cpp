// Reading in isolation, seen from the caller: whatever the reading program does, loadScene() throws
// one Error and leaves nothing behind. Shell scripts stand in for the program.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "bumper/response/error.h"
#include "bumper/scenes/paper_scenes.h"
#include "bumper/scenes/scene_files.h"
#include "left_behind.h"
#include "temporary_files.h"

namespace bumper {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class IsolatedReading : public TemporaryFiles {
 protected:
  IsolatedReading() { saveScene(testRail(), path("rail.obj")); }
  ~IsolatedReading() override { unsetenv("BUMPER_READ_SCENE"); }

  /// Has a script take the reading program's place.
  void replaceProgram(const std::string& script) {
    const std::filesystem::path program = write("reader", "#!/bin/sh\n" + script + '\n');
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    setenv("BUMPER_READ_SCENE", program.c_str(), 1);
  }

  [[nodiscard]] Scene load(double timeout = 10.0) const {
    return loadScene(path("rail.obj"), {.up = UpAxis::z, .timeout = timeout});
  }

  template <typename Matcher>
  void expectError(Matcher message, double timeout = 10.0) {
    const NothingLeftBehind check;
    EXPECT_THAT([&] { static_cast<void>(load(timeout)); },
                ThrowsMessage<Error>(AllOf(HasSubstr(path("rail.obj").string()), message)));
  }
};

TEST_F(IsolatedReading, Works) {
  const NothingLeftBehind check;
  EXPECT_EQ(load().triangles.size(), 612U);
}

TEST_F(IsolatedReading, TellsThatItStillWaits) {
  replaceProgram("sleep 1");
  int told = 0;
  EXPECT_THROW(loadScene(path("rail.obj"),
                         {.up = UpAxis::z, .progress = [&](LoadStage, double) { ++told; }}),
               Error);
  EXPECT_GE(told, 3);
}

TEST_F(IsolatedReading, ProgramIsTakenFromTheEnvironment) {
  setenv("BUMPER_READ_SCENE", path("nowhere").c_str(), 1);
  EXPECT_THAT([&] { static_cast<void>(load()); },
              ThrowsMessage<Error>(
                  AllOf(HasSubstr("BUMPER_READ_SCENE"), HasSubstr(path("nowhere").string()))));
}

TEST_F(IsolatedReading, ProgramThatCannotBeStarted) {
  setenv("BUMPER_READ_SCENE",
         write("reader",
               "\x7f"
               "ELF nonsense")
             .c_str(),
         1);
  std::filesystem::permissions(path("reader"), std::filesystem::perms::owner_all);
  expectError(HasSubstr("failed"));
}

TEST_F(IsolatedReading, ProgramThatDies) {
  replaceProgram("kill -ABRT $$");
  expectError(HasSubstr("crashes the reader (Aborted)"));
  replaceProgram("kill -SEGV $$");
  expectError(HasSubstr("crashes the reader (Segmentation fault)"));
  replaceProgram("kill -KILL $$");
  expectError(HasSubstr("without an answer"));
}

TEST_F(IsolatedReading, ProgramThatSaysNothing) {
  replaceProgram("exit 0");
  expectError(HasSubstr("without an answer"));
  replaceProgram("exit 3");
  expectError(HasSubstr("without an answer"));
}

TEST_F(IsolatedReading, ProgramThatSaysNonsense) {
  replaceProgram("echo hello");
  expectError(HasSubstr("without an answer"));
  replaceProgram("head -c 100000 /dev/urandom");
  expectError(HasSubstr("without an answer"));
}

TEST_F(IsolatedReading, AnswerCutShortOrTooLongOrDamaged) {
  // The true program's answer, kept by a script, then spoilt.
  const std::string real =
      (std::filesystem::read_symlink("/proc/self/exe").parent_path() / "bumper-read-scene")
          .string();
  const std::string answer = '"' + real + "\" \"$@\"";
  replaceProgram(answer);
  EXPECT_EQ(load().triangles.size(), 612U);
  replaceProgram(answer + " | head -c 10000");
  expectError(HasSubstr("without an answer"));
  replaceProgram(answer + "; echo");
  expectError(HasSubstr("without an answer"));
  // Bytes 17 to 24 are the length of the scene's name, here and in the next the answer's first.
  replaceProgram(answer +
                 " | (head -c 16; printf '\\377\\377\\377\\377\\377\\377\\377\\377'; cat)");
  expectError(HasSubstr("without an answer"));
  // Every corner index becomes 0x20202020.
  replaceProgram(answer + " | tr '\\000-\\010' ' '");
  expectError(HasSubstr("without an answer"));
}

TEST_F(IsolatedReading, ProgramThatTakesTooLong) {
  replaceProgram("exec sleep 60");
  expectError(HasSubstr("LoadOptions::timeout"), 0.2);
  replaceProgram("while :; do printf .; done");
  expectError(HasSubstr("LoadOptions::timeout"), 0.2);
}

TEST_F(IsolatedReading, ProgramThatClosesItsOutputAndStays) {
  replaceProgram("exec sleep 1000 >&-");
  expectError(HasSubstr("without an answer"));
}

TEST_F(IsolatedReading, ProgramThatNeverStopsTalking) {
  replaceProgram("exec cat /dev/zero");
  const NothingLeftBehind check;
  EXPECT_THAT(
      [&] {
        loadScene(path("rail.obj"),
                  {.up = UpAxis::z, .timeout = 60.0, .memoryLimit = std::size_t{64} << 20U});
      },
      ThrowsMessage<Error>(HasSubstr("LoadOptions::memoryLimit")));
}

TEST_F(IsolatedReading, ProgramInheritsNothingOfTheCallers) {
  // Ignored signals, blocked signals and open descriptors would all be handed down.
  const auto previous = std::signal(SIGALRM, SIG_IGN);
  sigset_t all;
  sigset_t mask;
  sigfillset(&all);
  sigprocmask(SIG_SETMASK, &all, &mask);
  replaceProgram("kill -ALRM $$; exec sleep 60");
  expectError(HasSubstr("Alarm clock"));
  sigprocmask(SIG_SETMASK, &mask, nullptr);
  static_cast<void>(std::signal(SIGALRM, previous));
}

TEST_F(IsolatedReading, WorksWithoutStandardStreams) {
  // A daemon's descriptors 0 to 2 may be closed: the pipe then gets their numbers.
  EXPECT_EXIT(
      {
        for (const int stream : {0, 1, 2}) close(stream);
        _exit(load().triangles.size() == 612U ? 0 : 1);
      },
      ::testing::ExitedWithCode(0), "");
}

TEST_F(IsolatedReading, WorksWhereTheApplicationReapsChildrenItself) {
  const auto previous = std::signal(SIGCHLD, SIG_IGN);
  EXPECT_EQ(load().triangles.size(), 612U);
  static_cast<void>(std::signal(SIGCHLD, previous));
}

TEST_F(IsolatedReading, WorksFromSeveralThreads) {
  const NothingLeftBehind check;
  std::array<std::size_t, 4> counts{};
  {
    std::vector<std::thread> threads;
    threads.reserve(counts.size());
    for (std::size_t& count : counts) {
      threads.emplace_back([&] { count = load().triangles.size(); });
    }
    for (std::thread& thread : threads) thread.join();
  }
  for (const std::size_t count : counts) EXPECT_EQ(count, 612U);
}

TEST_F(IsolatedReading, PrintsNothing) {
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  static_cast<void>(load());
  EXPECT_ANY_THROW(loadScene(write("bad.ac", "AC3Db\nOBJECT world\nkids 9\n"), {.up = UpAxis::z}));
  EXPECT_ANY_THROW(loadTrustedScene(write("bad.obj", "v 0 0\nf 1 2 3 4 5\n"), {.up = UpAxis::z}));
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace bumper
