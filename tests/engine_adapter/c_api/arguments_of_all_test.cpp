// No call of the C interface is without a test of its arguments.

#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <string>

#include "text_file.h"

namespace bumper::tests {
namespace {

std::set<std::string> found(const std::string& text, const char* pattern) {
  const std::regex expression(pattern);
  std::set<std::string> result;
  for (std::sregex_iterator match(text.begin(), text.end(), expression), end; match != end;
       ++match) {
    result.insert((*match)[1]);
  }
  return result;
}

TEST(CInterface, HasNoCallWhoseArgumentsAreNotTried) {
  const std::set<std::string> declared =
      found(testing::readText(C_API_HEADER), R"re((?:^|\n)(?:int|const char\*) (bumper_\w+)\()re");
  const std::string folder = C_API_TESTS;
  const std::set<std::string> tried =
      found(testing::readText(folder + "/arguments_of_setup_test.cpp") +
                testing::readText(folder + "/arguments_of_steps_test.cpp"),
            R"re("?(bumper_\w+)(?:"|\(|,))re");
  EXPECT_GE(declared.size(), 56U);
  for (const std::string& each : declared) {
    // Neither can fail, and neither has an argument.
    if (each == "bumper_last_error" || each == "bumper_preset_count") continue;
    EXPECT_TRUE(tried.contains(each)) << each;
  }
}

}  // namespace
}  // namespace bumper::tests
