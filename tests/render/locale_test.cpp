// An application's locale, with a comma for the decimal point and dots between thousands, changes
// nothing in files.

#include <gtest/gtest.h>

#include <clocale>
#include <cstdlib>
#include <filesystem>
#include <locale>
#include <map>
#include <string>

#include "bumper/render/csv_export.h"
#include "bumper/render/glb_export.h"
#include "bumper/render/recording_reader.h"
#include "bumper/render/recording_writer.h"
#include "bumper/scenes/paper_scenes.h"
#include "synthetic_run.h"
#include "temporary_folder.h"
#include "text_file.h"

namespace bumper::testing {
namespace {

/// The C++ library's side of it.
class Comma : public std::numpunct<char> {
 protected:
  [[nodiscard]] char do_decimal_point() const override { return ','; }
  [[nodiscard]] char do_thousands_sep() const override { return '.'; }
  [[nodiscard]] std::string do_grouping() const override { return "\3"; }
};

/// The C library's side of it: of a system that has its sources, a German one is made.
bool setGermanLocale(const std::filesystem::path& folder) {
  const std::string made = (folder / "de_DE.UTF-8").string();
  const std::string command = "localedef -i de_DE -f UTF-8 '" + made + "' >/dev/null 2>&1";
  if (std::system(command.c_str()) != 0) return false;
  setenv("LOCPATH", folder.c_str(), 1);
  const bool isSet = std::setlocale(LC_ALL, "de_DE.UTF-8") != nullptr;
  unsetenv("LOCPATH");
  return isSet && *std::localeconv()->decimal_point == ',';
}

std::map<std::string, std::string> filesOf(const Recording& run) {
  const TemporaryFolder folder;
  RunDescription about{.scene = referenceTo(testRail()), .parameters = {{"step", 0.005}}};
  writeRecording(run, folder.path() / "run.jsonl", about);
  writeCsv(readRecording(folder.path() / "run.jsonl"), folder.path());
  writeGlb(testRail(), run, folder.path() / "run.glb");
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    files[entry.path().filename().string()] = readText(entry.path());
  return files;
}

TEST(Locale, ofTheCLibraryChangesNothing) {
  const TemporaryFolder folder;
  const auto expected = filesOf(testRailRun());
  if (!setGermanLocale(folder.path())) GTEST_SKIP() << "no German locale can be made";
  const auto files = filesOf(testRailRun());
  std::setlocale(LC_ALL, "C");
  ASSERT_EQ(files.size(), 4U);
  for (const auto& [name, text] : files) EXPECT_TRUE(text == expected.at(name)) << name;
}

TEST(Locale, ofTheCppLibraryChangesNothing) {
  const auto expected = filesOf(testRailRun());
  const std::locale before = std::locale::global(std::locale(std::locale(), new Comma));
  const auto files = filesOf(testRailRun());
  std::locale::global(before);
  ASSERT_EQ(files.size(), 4U);
  for (const auto& [name, text] : files) EXPECT_TRUE(text == expected.at(name)) << name;
}

}  // namespace
}  // namespace bumper::testing
