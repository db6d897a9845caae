#include "bumper/base/output_file.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <future>
#include <string>
#include <vector>

#include "bumper/base/child_process.h"
#include "bumper/response/error.h"
#include "temporary_folder.h"
#include "text_file.h"

namespace bumper {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::namesIn;
using testing::readText;
using testing::TemporaryFolder;
using ::testing::ThrowsMessage;

void writeTo(const std::filesystem::path& place, std::string_view text) {
  OutputFile file(place);
  file.write({text});
  file.moveToPlace();
}

mode_t modeOf(const std::filesystem::path& file) {
  struct stat status {};
  lstat(file.c_str(), &status);
  return status.st_mode;
}

/// A program of its own, since a signal ends it: one file is done, another begun.
[[noreturn]] void writeUntilASignal(const std::filesystem::path& folder, int signal) {
  removeUnfinishedFilesOnSignals();
  writeTo(folder / "done", "whole");
  const OutputFile begun(folder / "begun");
  begun.write({"half"});
  ::kill(getpid(), signal);
  for (;;) pause();
}

TEST(OutputFile, standsInItsPlaceOnceItIsMovedThere) {
  const TemporaryFolder folder;
  const auto place = folder.path() / "table.csv";
  testing::writeText(place, "before");
  OutputFile file(place);
  file.write({"one,", "two"});
  EXPECT_EQ(readText(place), "before");
  EXPECT_EQ(readText(file.path()), "one,two");
  EXPECT_EQ(file.size(), 7U);
  file.moveToPlace();
  EXPECT_EQ(readText(place), "one,two");
  EXPECT_THAT(namesIn(folder.path()), ElementsAre("table.csv"));
}

TEST(OutputFile, withoutThatNothingIsLeftAndNothingLost) {
  const TemporaryFolder folder;
  const auto place = folder.path() / "table.csv";
  testing::writeText(place, "before");
  {
    const OutputFile file(place);
    file.write({"half"});
    EXPECT_EQ(namesIn(folder.path()).size(), 2U);
  }
  EXPECT_EQ(readText(place), "before");
  EXPECT_THAT(namesIn(folder.path()), ElementsAre("table.csv"));
}

TEST(OutputFile, twoWritersOfOnePlaceDoNotMeet) {
  const TemporaryFolder folder;
  const auto place = folder.path() / "film";
  OutputFile first(place);
  OutputFile second(place);
  first.write({"the first one"});
  second.write({"two"});
  first.moveToPlace();
  EXPECT_EQ(readText(place), "the first one");
  second.moveToPlace();
  EXPECT_EQ(readText(place), "two");
}

TEST(OutputFile, childrenReachItWhateverThePlaceIsCalled) {
  const TemporaryFolder folder;
  const auto place = folder.path() / "'$(touch pwned)`\"\n\xFF|;#";
  OutputFile file(place);
  ChildProcess child("sh", {"-c", "printf text > " + file.path().string()}, {});
  EXPECT_TRUE(hasSucceeded(child.wait()));
  file.moveToPlace();
  EXPECT_EQ(readText(place), "text");
  EXPECT_EQ(namesIn(folder.path()).size(), 1U);
}

TEST(OutputFile, theLongestNamesAreWritten) {
  const TemporaryFolder folder;
  const std::string name(255, 'n');
  writeTo(folder.path() / name, "text");
  EXPECT_THAT(namesIn(folder.path()), ElementsAre(name));
}

TEST(OutputFile, keepsTheModeOfWhatWasThereAndGivesNewFilesThatOfTheMask) {
  const TemporaryFolder folder;
  const auto place = folder.path() / "file";
  testing::writeText(place, "before");
  for (const mode_t mode : {0600U, 0640U, 0755U, 0666U}) {
    chmod(place.c_str(), mode);
    writeTo(place, "after");
    EXPECT_EQ(modeOf(place) & 07777U, mode);
  }
  const mode_t mask = umask(0027);
  writeTo(folder.path() / "new", "text");
  umask(mask);
  EXPECT_EQ(modeOf(folder.path() / "new") & 07777U, 0640U);
}

// For as long as it lives root, who may write everything, acts as nobody.
class AsOneOfMany {
 public:
  AsOneOfMany() {
    if (isRoot_) {
      EXPECT_EQ(seteuid(nobody), 0);
    }
  }
  ~AsOneOfMany() {
    if (isRoot_) {
      EXPECT_EQ(seteuid(0), 0);
    }
  }
  AsOneOfMany(const AsOneOfMany&) = delete;
  AsOneOfMany& operator=(const AsOneOfMany&) = delete;
  AsOneOfMany(AsOneOfMany&&) = delete;
  AsOneOfMany& operator=(AsOneOfMany&&) = delete;

 private:
  static constexpr uid_t nobody = 65534;
  bool isRoot_ = geteuid() == 0;
};

TEST(OutputFile, whatMayNotBeWrittenIsNotReplaced) {
  const TemporaryFolder folder;
  const auto place = folder.path() / "file";
  testing::writeText(place, "before");
  chmod(folder.path().c_str(), 0777);
  chmod(place.c_str(), 0444);
  const AsOneOfMany user;
  EXPECT_THAT([&] { writeTo(place, "after"); }, ThrowsMessage<Error>(HasSubstr(place.string())));
  EXPECT_EQ(readText(place), "before");
}

TEST(OutputFile, linksStayAndWhatTheyLeadToIsWritten) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "inside");
  testing::writeText(folder.path() / "inside" / "old", "before");
  create_symlink("second", folder.path() / "first");
  create_symlink("inside/old", folder.path() / "second");
  create_symlink("inside/new", folder.path() / "hanging");
  create_symlink("round", folder.path() / "round");
  writeTo(folder.path() / "first", "after");
  writeTo(folder.path() / "hanging", "new");
  for (const char* link : {"first", "second", "hanging"})
    EXPECT_TRUE(is_symlink(folder.path() / link)) << link;
  EXPECT_EQ(readText(folder.path() / "inside" / "old"), "after");
  EXPECT_EQ(readText(folder.path() / "inside" / "new"), "new");
  EXPECT_THAT(namesIn(folder.path() / "inside"), ElementsAre("new", "old"));
  EXPECT_THAT([&] { writeTo(folder.path() / "round", "text"); },
              ThrowsMessage<Error>(HasSubstr("links")));
}

TEST(OutputFile, devicesAndPipesAreWrittenAndStay) {
  writeTo("/dev/null", "text");
  EXPECT_TRUE(S_ISCHR(modeOf("/dev/null")));
  EXPECT_THAT([] { writeTo("/dev/full", "text"); },
              ThrowsMessage<Error>(AllOf(HasSubstr("/dev/full"), HasSubstr("No space left"))));
  EXPECT_TRUE(S_ISCHR(modeOf("/dev/full")));

  const TemporaryFolder folder;
  const auto pipe = folder.path() / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const std::string text(300000, 'x');  // more than it holds
  auto reader = std::async(std::launch::async, [&] { return readText(pipe); });
  writeTo(pipe, text);
  EXPECT_EQ(reader.get(), text);
  EXPECT_TRUE(S_ISFIFO(modeOf(pipe)));
}

TEST(OutputFile, aReaderThatLeavesIsAnErrorAndNoSignal) {
  const TemporaryFolder folder;
  const auto pipe = folder.path() / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  auto reader = std::async(std::launch::async, [&] {
    std::ifstream stream(pipe);
    stream.get();
  });
  EXPECT_THAT([&] { writeTo(pipe, std::string(10'000'000, 'x')); },
              ThrowsMessage<Error>(HasSubstr("Broken pipe")));
  reader.get();
}

TEST(OutputFile, anOpenFileOfAProcessIsWrittenAndKeepsItsName) {
  const TemporaryFolder folder;
  const auto log = folder.path() / "log";
  const int opened = open(log.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  struct stat before {};
  fstat(opened, &before);
  writeTo("/dev/fd/" + std::to_string(opened), "text");
  struct stat after {};
  stat(log.c_str(), &after);
  EXPECT_EQ(before.st_ino, after.st_ino);
  EXPECT_EQ(readText(log), "text");
  close(opened);
}

TEST(OutputFile, namesAPlaceThatCannotBeWritten) {
  const TemporaryFolder folder;
  const auto absent = folder.path() / "absent" / "table.csv";
  EXPECT_THAT([&] { OutputFile(absent).write({"text"}); },
              ThrowsMessage<Error>(HasSubstr("cannot write " + absent.string() + ":")));
  const auto inTheWay = folder.path() / "folder.csv";
  makeFolder(inTheWay / "not empty");
  for (const auto& place : {inTheWay, inTheWay / "", inTheWay / "."}) {
    EXPECT_THAT([&] { writeTo(place, "text"); },
                ThrowsMessage<Error>(HasSubstr("cannot write " + place.string() + ":")));
  }
  EXPECT_THAT(namesIn(folder.path()), ElementsAre("folder.csv"));
}

TEST(OutputFile, signalsRemoveWhatIsUnfinishedAndEndTheProgram) {
  for (const int signal : {SIGHUP, SIGINT, SIGTERM}) {
    const TemporaryFolder folder;
    EXPECT_EXIT(writeUntilASignal(folder.path(), signal), ::testing::KilledBySignal(signal), "");
    EXPECT_THAT(namesIn(folder.path()), ElementsAre("done"));
  }
}

TEST(OutputFile, aFolderIsMadeWithThoseAboveIt) {
  const TemporaryFolder folder;
  makeFolder(folder.path() / "a" / "b");
  makeFolder(folder.path() / "a" / "b");
  makeFolder("");
  EXPECT_TRUE(is_directory(folder.path() / "a" / "b"));
  testing::writeText(folder.path() / "file", "");
  EXPECT_THAT([&] { makeFolder(folder.path() / "file" / "b"); },
              ThrowsMessage<Error>(HasSubstr((folder.path() / "file" / "b").string())));
}

}  // namespace
}  // namespace bumper
