#include "bumper/base/child_process.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <span>
#include <string>
#include <string_view>
#include <system_error>

namespace bumper {
namespace {

std::span<const std::byte> bytesOf(std::string_view text) { return std::as_bytes(std::span(text)); }

std::string readAll(int descriptor) {
  std::string text;
  std::array<char, 256> block{};
  for (ssize_t got = 0; (got = read(descriptor, block.data(), block.size())) > 0;)
    text.append(block.data(), static_cast<std::size_t>(got));
  return text;
}

TEST(ChildProcess, takesItsInputAndGivesItsOutput) {
  ChildProcess child("tr", {"a-z", "A-Z"}, {.input = true, .output = true});
  EXPECT_TRUE(child.write(bytesOf("bumper")));
  EXPECT_TRUE(hasSucceeded(child.wait()));
  EXPECT_EQ(readAll(child.output()), "BUMPER");
}

TEST(ChildProcess, argumentsReachItAsTheyAre) {
  ChildProcess child("printf", {"%s|", "a b", "$HOME", "'\"", ""}, {.output = true});
  EXPECT_EQ(readAll(child.output()), "a b|$HOME|'\"||");
}

TEST(ChildProcess, streamsThatAreNotConnectedAreEmpty) {
  ChildProcess child("sh", {"-c", "cat; echo to nobody; echo to nobody >&2"}, {});
  EXPECT_TRUE(hasSucceeded(child.wait()));
  EXPECT_EQ(child.output(), -1);
  EXPECT_EQ(child.lastErrorLine(), "");
}

TEST(ChildProcess, keepsTheLastLineOfItsErrors) {
  ChildProcess child("sh", {"-c", "echo first >&2; echo last >&2; exit 3"}, {.errors = true});
  const int status = child.wait();
  EXPECT_FALSE(hasSucceeded(status));
  EXPECT_EQ(WEXITSTATUS(status), 3);
  EXPECT_EQ(child.lastErrorLine(), "last");
  EXPECT_EQ(child.wait(), status) << "it has ended once and for all";
}

TEST(ChildProcess, writingToOneThatHasEndedRaisesNoSignal) {
  ChildProcess child("true", {}, {.input = true});
  const std::string much(1U << 20U, 'x');
  EXPECT_FALSE(child.write(bytesOf(much)));
}

TEST(ChildProcess, isKilledWithTheObject) {
  const auto start = std::chrono::steady_clock::now();
  {
    ChildProcess child("sleep", {"600"}, {});
    EXPECT_EQ(WTERMSIG(child.kill()), SIGKILL);
    const ChildProcess another("sleep", {"600"}, {});
  }
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60));
}

TEST(ChildProcess, signalsThatTheApplicationIgnoresEndIt) {
  const auto handler = std::signal(SIGTERM, SIG_IGN);
  ChildProcess child("sh", {"-c", "kill -TERM $$; sleep 600"}, {});
  const int status = child.wait();
  std::signal(SIGTERM, handler);
  EXPECT_EQ(WTERMSIG(status), SIGTERM);
}

TEST(ChildProcess, doesNotHoldTheStreamsOfAnother) {
  ChildProcess first("cat", {}, {.input = true, .output = true});
  const ChildProcess second("sleep", {"600"}, {.input = true, .output = true});
  first.wait();  // would never return if the second held the first one's input open
  EXPECT_EQ(readAll(first.output()), "");
}

TEST(ChildProcess, oneThatDoesNothingIsNotWaitedForForEver) {
  constexpr std::chrono::milliseconds patience{50};
  ChildProcess deaf("sh", {"-c", "echo last words >&2; exec sleep 600"},
                    {.input = true, .output = true, .errors = true});
  EXPECT_FALSE(deaf.hasStalled());
  const std::string much(1U << 22U, 'x');
  EXPECT_FALSE(deaf.write(bytesOf(much), patience));
  EXPECT_TRUE(deaf.hasStalled());
  std::string text;
  EXPECT_FALSE(deaf.read(text, patience));
  EXPECT_EQ(WTERMSIG(deaf.wait(patience)), SIGKILL);
  EXPECT_EQ(deaf.lastErrorLine(), "last words");
}

TEST(ChildProcess, patienceIsNotTriedByOneThatWorks) {
  constexpr std::chrono::seconds patience{60};
  ChildProcess child("tr", {"a-z", "A-Z"}, {.input = true, .output = true});
  EXPECT_TRUE(child.write(bytesOf("bumper"), patience));
  EXPECT_TRUE(hasSucceeded(child.wait(patience)));
  std::string text;
  EXPECT_TRUE(child.read(text, patience));
  EXPECT_EQ(text, "BUMPER");
  EXPECT_FALSE(child.read(text, patience));
  EXPECT_FALSE(child.hasStalled());
}

TEST(ChildProcess, oneThatIsMissingIsAnError) {
  try {
    const ChildProcess child("/nowhere/program", {}, {.input = true, .output = true});
    ADD_FAILURE() << "no error";
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.code().value(), ENOENT);
  }
}

}  // namespace
}  // namespace bumper
