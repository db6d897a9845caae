#include "bumper/base/printing.h"

#include <gtest/gtest.h>

#include <string>

namespace bumper {
namespace {

TEST(Printable, wordsOfAnyLanguageStayAsTheyAre) {
  for (const char* text : {"", "saloon 1", "Straße", "車", "\xF0\x9F\x9A\x97", "a\\b"})
    EXPECT_EQ(printable(text), text);
}

TEST(Printable, whatATerminalWouldObeyIsShown) {
  EXPECT_EQ(printable("\x1B]0;owned\x07"), "\\x1B]0;owned\\x07");
  EXPECT_EQ(printable("two\nlines\r"), "two\\nlines\\x0D");
  EXPECT_EQ(printable("\u202Egnp.exe"), "\\u202Egnp.exe");
  EXPECT_EQ(printable("\u2066a\u2028"), "\\u2066a\\u2028");
  EXPECT_EQ(printable("\xC2\x9B"
                      "31m"),
            "\\x9B"
            "31m");  // CSI in one character
  EXPECT_EQ(printable("\x7F"), "\\x7F");
}

TEST(Printable, bytesThatAreNotUtf8AreShown) {
  EXPECT_EQ(printable("caf\xE9"), "caf\\xE9");
  EXPECT_EQ(printable("\xC0\x8A"), "\\xC0\\x8A");           // a line feed, overlong
  EXPECT_EQ(printable("\xED\xA0\x80"), "\\xED\\xA0\\x80");  // half a surrogate pair
  EXPECT_EQ(printable("\xF4\x90\x80\x80"), "\\xF4\\x90\\x80\\x80");
  EXPECT_EQ(printable("\xE8\xBB"), "\\xE8\\xBB");  // cut off
}

}  // namespace
}  // namespace bumper
