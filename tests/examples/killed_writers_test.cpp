// Every kind of file that the tools write, and a kill at any moment of it. KILLS is how often each.

#include <chrono>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "bumper/base/child_process.h"
#include "text_file.h"
#include "tools.h"

namespace bumper::testing {
namespace {

/// Files by their path in a folder.
using Files = std::map<std::string, std::string>;

Files filesIn(const std::filesystem::path& folder) {
  Files files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const bool isUnfinished = entry.path().extension() == ".part";
    if (entry.is_regular_file() && !isUnfinished)
      files[entry.path().lexically_relative(folder).string()] = readText(entry.path());
  }
  return files;
}

/// A tool with its arguments, of which OUT is the folder for its files.
struct Writer {
  std::string program;
  std::vector<std::string> arguments;
  const char* needs;  ///< a program that may be missing
};

const std::vector<Writer> writers{
    {"bumper-replay", {"picture", "RUN", "OUT/p.png", "--size", "320x200"}, "true"},
    {"bumper-replay", {"glb", "RUN", "OUT/run.glb"}, "true"},
    {"bumper-replay", {"csv", "RUN", "OUT/tables"}, "true"},
    {"bumper-replay",
     {"frames", "RUN", "OUT/f", "--fps", "2", "--size", "160x120", "--slow-motion", "1"},
     "true"},
    {"break_through", {"OUT/result"}, "true"},
    {"bumper-plot", {"RUN", "OUT/plots", "--only", "speed,yaw_rate"}, "gnuplot"},
    {"bumper-replay",
     {"video", "RUN", "OUT/f.gif", "--fps", "4", "--size", "160x120", "--slow-motion", "1"},
     "ffmpeg"}};

class KilledWriters : public Tools, public ::testing::WithParamInterface<std::size_t> {
 protected:
  [[nodiscard]] std::unique_ptr<ChildProcess> start(const Writer& writer,
                                                    const std::filesystem::path& out) const {
    std::vector<std::string> arguments = writer.arguments;
    for (std::string& argument : arguments) {
      if (const std::size_t place = argument.find("OUT"); place != std::string::npos)
        argument.replace(place, 3, out.string());
      if (argument == "RUN") argument = recording_.string();
    }
    return std::make_unique<ChildProcess>(TOOLS_FOLDER "/" + writer.program, arguments,
                                          ChildStreams{});
  }

  /// Kills it at random moments of its work: under every name stands what stood there before, or
  /// what it writes when it is let.
  void killAtRandom(const Writer& writer, int times, unsigned seed) const {
    using Clock = std::chrono::steady_clock;
    const TemporaryFolder whole;
    const auto begun = Clock::now();
    ASSERT_TRUE(hasSucceeded(start(writer, whole.path())->wait())) << writer.program;
    const std::chrono::duration<double> takes = Clock::now() - begun;
    const Files written = filesIn(whole.path());
    ASSERT_FALSE(written.empty());
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> moment(0.0, 1.1 * takes.count());
    for (int k = 0; k < times; ++k) {
      const TemporaryFolder out;
      for (const auto& [name, text] : written) {
        std::filesystem::create_directories((out.path() / name).parent_path());
        writeText(out.path() / name, "before");
      }
      const auto child = start(writer, out.path());
      std::this_thread::sleep_for(std::chrono::duration<double>(moment(random)));
      child->kill();
      const Files left = filesIn(out.path());
      EXPECT_EQ(left.size(), written.size());
      for (const auto& [name, text] : left) {
        const auto expected = written.find(name);
        ASSERT_NE(expected, written.end()) << name;
        EXPECT_TRUE(text == "before" || text == expected->second)
            << writer.program << ' ' << name << " is broken, kill " << k;
      }
    }
  }
};

TEST_P(KilledWriters, LeaveNothingBroken) {
  const Writer& writer = writers.at(GetParam());
  if (!haveProgram(writer.needs)) GTEST_SKIP() << writer.needs << " is missing";
  killAtRandom(writer, KILLS, static_cast<unsigned>(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Each, KilledWriters, ::testing::Range(std::size_t{0}, writers.size()));

}  // namespace
}  // namespace bumper::testing
