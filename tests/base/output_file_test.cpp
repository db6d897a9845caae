#include "bumper/base/output_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bumper/response/error.h"
#include "temporary_folder.h"
#include "text_file.h"

namespace bumper {
namespace {

using ::testing::HasSubstr;
using testing::readText;
using testing::TemporaryFolder;
using ::testing::ThrowsMessage;

TEST(OutputFile, standsInItsPlaceOnceItIsMovedThere) {
  const TemporaryFolder folder;
  const auto place = folder.path() / "table.csv";
  testing::writeText(place, "before");
  OutputFile file(place);
  file.write({"one,", "two"});
  EXPECT_EQ(readText(place), "before");
  EXPECT_EQ(readText(file.beside()), "one,two");
  file.moveToPlace();
  EXPECT_EQ(readText(place), "one,two");
  EXPECT_FALSE(exists(file.beside()));
}

TEST(OutputFile, withoutThatNothingIsLeftAndNothingLost) {
  const TemporaryFolder folder;
  const auto place = folder.path() / "table.csv";
  testing::writeText(place, "before");
  {
    const OutputFile file(place);
    file.write({"half"});
  }
  EXPECT_EQ(readText(place), "before");
  EXPECT_FALSE(exists(folder.path() / "table.csv.part"));
}

TEST(OutputFile, namesAPlaceThatCannotBeWritten) {
  const TemporaryFolder folder;
  const auto absent = folder.path() / "absent" / "table.csv";
  EXPECT_THAT([&] { OutputFile(absent).write({"text"}); },
              ThrowsMessage<Error>(HasSubstr("cannot write " + absent.string() + ":")));
  const auto inTheWay = folder.path() / "folder.csv";
  makeFolder(inTheWay / "not empty");
  EXPECT_THAT(
      [&] {
        OutputFile file(inTheWay);
        file.write({"text"});
        file.moveToPlace();
      },
      ThrowsMessage<Error>(HasSubstr("cannot replace " + inTheWay.string() + ":")));
  EXPECT_FALSE(exists(folder.path() / "folder.csv.part"));
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
