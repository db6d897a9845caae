#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "bumper/render/recording_writer.h"
#include "bumper/scenes/paper_scenes.h"
#include "synthetic_run.h"
#include "temporary_folder.h"

namespace bumper::testing {

inline constexpr int done = 0;
inline constexpr int failed = 1;
inline constexpr int wrongCommandLine = 2;

struct Outcome {
  int code = -1;
  std::string words;  ///< standard output and standard error
};

/// The tools as a user runs them, in a folder with the recording run.jsonl.
class Tools : public ::testing::Test {
 protected:
  Tools() {
    RunDescription run{.scene = referenceTo(testRail())};
    run.scene.builtIn = "test_rail";
    writeRecording(testRailRun(), recording_, run);
  }

  /// `setting`: NAME=value for the program.
  [[nodiscard]] Outcome run(const std::string& command, const std::string& setting = "") const {
    const std::string line = "cd '" + folder_.path().string() +
                             "' && MESA_SHADER_CACHE_DISABLE=true " + setting +
                             " " TOOLS_FOLDER "/" + command + " 2>&1";
    std::FILE* pipe = popen(line.c_str(), "r");
    Outcome outcome;
    std::array<char, 4096> part{};
    while (const std::size_t got = std::fread(part.data(), 1, part.size(), pipe))
      outcome.words.append(part.data(), got);
    const int status = pclose(pipe);
    outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return outcome;
  }

  void expectError(const std::string& command, const std::string& words, int code = failed) const {
    const Outcome outcome = run(command);
    EXPECT_EQ(outcome.code, code) << command << '\n' << outcome.words;
    EXPECT_THAT(outcome.words, ::testing::HasSubstr(words)) << command;
  }

  [[nodiscard]] bool exists(const char* name) const {
    return std::filesystem::exists(folder_.path() / name);
  }

  static bool haveProgram(const std::string& name) {
    return std::system(("command -v " + name + " >/dev/null 2>&1").c_str()) == 0;
  }

  TemporaryFolder folder_;
  std::filesystem::path recording_ = folder_.path() / "run.jsonl";
};

}  // namespace bumper::testing
