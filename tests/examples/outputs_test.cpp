// What the tools leave behind whatever happens: to their names, their disk, the programs that they
// run, and themselves.

#include <algorithm>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "bumper/render/image.h"
#include "bumper/render/recording_reader.h"
#include "text_file.h"
#include "tools.h"

namespace bumper::testing {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

class Outputs : public Tools {
 protected:
  /// What the folder holds besides the recording, in order.
  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
      const std::string name = entry.path().filename().string();
      if (name != "run.jsonl") names.push_back(name);
    }
    std::sort(names.begin(), names.end());
    return names;
  }

  /// A program that is found before the real one of its name, by the setting that it returns.
  std::string pretend(const std::string& program, const std::string& script) {
    const auto file = programs_.path() / program;
    std::ofstream(file) << "#!/bin/sh\n" << script << '\n';
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
    return "PATH=" + programs_.path().string() + ":$PATH";
  }

  TemporaryFolder programs_;
};

constexpr const char* plotNothing = "bumper-plot run.jsonl plots --only speed ";

TEST_F(Outputs, NoWordOfAFoldersNameIsACommand) {
  if (!haveProgram("gnuplot")) GTEST_SKIP() << "gnuplot is missing";
  const std::vector<std::string> folders{"|touch pwned; cat>x;#", "nl\n!touch pwned\n#",
                                         "it's \"a\" `touch pwned` $(touch pwned)",
                                         "system('touch pwned')", "caf\xE9 \x1B[31m"};
  for (const std::string& folder : folders) {
    std::ofstream(folder_.path() / "name") << folder;
    const Outcome outcome =
        run("bumper-plot run.jsonl \"$(cat name)\" --only speed; code=$?; rm name; exit $code");
    EXPECT_EQ(outcome.code, done) << outcome.words;
    EXPECT_EQ(std::count(outcome.words.begin(), outcome.words.end(), '\n'), 1) << outcome.words;
    EXPECT_THAT(outcome.words, AllOf(Not(HasSubstr("\x1B")), Not(HasSubstr("\xE9"))));
    EXPECT_THAT(names(), ElementsAre(folder));
    EXPECT_GT(readPng(folder_.path() / folder / "speed.png").width(), 800);
    std::filesystem::remove_all(folder_.path() / folder);
  }
}

TEST_F(Outputs, NamesThatAreNotUtf8AreWritten) {
  const std::string name = "caf\xE9 'a'";
  for (const char* command :
       {"picture run.jsonl \"$N.png\" --size 160x120", "glb run.jsonl \"$N.glb\"",
        "csv run.jsonl \"$N\"", "closeups run.jsonl \"$N\" --impacts 1"}) {
    const Outcome outcome =
        run(std::string("bumper-replay ") + command, "N=\"$(printf \"caf\\351 'a'\")\"; export N;");
    EXPECT_EQ(outcome.code, done) << outcome.words;
  }
  EXPECT_THAT(names(), ElementsAre(name, name + ".glb", name + ".png"));
}

TEST_F(Outputs, AGnuplotThatFailsHangsOrLeavesNothingIsAnError) {
  std::filesystem::create_directory(folder_.path() / "plots");
  writeText(folder_.path() / "plots" / "speed.png", "before");
  const std::string version = "[ \"$1\" = --version ] && exit 0\n";
  Outcome outcome = run(plotNothing, pretend("gnuplot", version + "cat > /dev/null"));
  EXPECT_EQ(outcome.code, failed);
  EXPECT_THAT(outcome.words, AllOf(HasSubstr("plots/speed.png"), HasSubstr("no whole picture")));
  outcome = run(plotNothing, pretend("gnuplot", version + "echo last words >&2; kill -SEGV $$"));
  EXPECT_EQ(outcome.code, failed);
  EXPECT_THAT(outcome.words, AllOf(HasSubstr("plots/speed.png"), HasSubstr("last words")));
  outcome = run(std::string(plotNothing) + " --patience 0.1",
                pretend("gnuplot", version + "echo last words >&2; exec sleep 600"));
  EXPECT_EQ(outcome.code, failed);
  EXPECT_THAT(outcome.words, AllOf(HasSubstr("did nothing"), HasSubstr("last words")));
  EXPECT_EQ(readText(folder_.path() / "plots" / "speed.png"), "before");
  std::filesystem::remove_all(folder_.path() / "plots");
  EXPECT_TRUE(names().empty());
}

TEST_F(Outputs, StandardOutputOnAFullDeviceIsAnError) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
  for (const char* command : {"bumper-replay info run.jsonl", "bumper-replay --help",
                              "bumper-drive --help", "bumper-plot --help"}) {
    const Outcome outcome =
        run(std::string(command) + " 2>words >/dev/full; code=$?; cat words; exit $code");
    EXPECT_EQ(outcome.code, failed) << command;
    EXPECT_THAT(outcome.words, HasSubstr("cannot write standard output")) << command;
  }
  EXPECT_EQ(run("bumper-replay glb run.jsonl run.glb 2>words >&-; exit $?").code, done)
      << "nothing was printed";
  EXPECT_EQ(run("bumper-replay info run.jsonl 2>words >&-; exit $?").code, failed);
}

TEST_F(Outputs, DevicesAndLinksStayWhatTheyAre) {
  create_symlink("target", folder_.path() / "link.glb");
  EXPECT_EQ(run("bumper-replay glb run.jsonl link.glb").words, "");
  EXPECT_TRUE(is_symlink(folder_.path() / "link.glb"));
  const std::string whole = readText(folder_.path() / "target");
  EXPECT_EQ(run("bumper-replay glb run.jsonl /dev/stdout | cmp - target").words, "");
  EXPECT_EQ(run("bumper-replay glb run.jsonl /dev/null").words, "");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
  expectError("bumper-replay glb run.jsonl /dev/full", "No space left on device");
}

TEST_F(Outputs, NumbersThatMakeNoSenseAreRefusedByTheirOption) {
  const std::map<std::string, std::vector<std::string>> options{
      {"bumper-drive run.jsonl", {"step", "heading", "speed", "duration", "scale"}},
      {"bumper-replay frames run.jsonl f",
       {"fps", "speed", "slow-motion", "slow-reach", "from", "to", "scale", "most-seconds",
        "vehicle-mesh-turn"}},
      {"bumper-replay glb run.jsonl f.glb", {"reach", "keys-per-second"}},
      {"bumper-replay sheet run.jsonl f.png", {"instants"}},
      {"bumper-plot run.jsonl f", {"from", "patience"}}};
  for (const auto& [command, names] : options) {
    for (const std::string& name : names) {
      for (const char* value : {"nan", "-nan", "1e308", "-1e308", "1e999"}) {
        const bool isAllowed =
            std::string(value).front() == '1' && (name == "reach" || name == "keys-per-second");
        if (isAllowed) continue;
        expectError(command + " --" + name + " " + value, "--" + name, wrongCommandLine);
      }
    }
  }
  expectError("bumper-replay picture run.jsonl p.png --camera 0,0,nan,1,1,1", "--camera",
              wrongCommandLine);
  expectError("bumper-drive run.jsonl --start 0,nan", "--start", wrongCommandLine);
  EXPECT_TRUE(names().empty());
}

/// Terminal escapes, a mark that turns writing around, and a line that looks like the tool's own.
constexpr const char* evil = "\x1B]0;owned\x07\x1B[2J\u202Egnp.exe\nfake line";

TEST_F(Outputs, NamesOfARecordingAreShownAndNotSentToTheTerminal) {
  Recording recording;
  const Recording run = testRailRun();
  const RecordedVehicle& saloon = run.vehicles()[0];
  const std::size_t car = recording.addVehicle(evil, saloon.parameters, {{"mesh", evil}});
  for (const RecordedPose& pose : saloon.poses) recording.addPose(car, pose);
  for (const RecordedImpact& impact : run.impacts()) {
    ImpactEvent event = impact.event();
    event.vehicle = event.barrier = event.material = evil;
    recording.addImpact(event);
  }
  RunDescription about{.scene = {.name = evil, .builtIn = "test_rail"},
                       .parameters = {{evil, evil}}};
  writeRecording(recording, recording_, about);
  std::string words = Tools::run("bumper-replay info run.jsonl").words;
  words += Tools::run("bumper-replay glb run.jsonl run.glb").words;
  about.scene.builtIn = "";
  about.scene.file = evil;
  writeRecording(recording, recording_, about);
  words += Tools::run("bumper-replay glb run.jsonl run.glb").words;
  words += Tools::run("bumper-replay csv run.jsonl t --vehicle x").words;
  words +=
      Tools::run("bumper-replay info \"$N\"", "N=\"$(printf '\\033[31m\\n')x\"; export N;").words;
  EXPECT_THAT(words, HasSubstr("\\x1B]0;owned\\x07\\x1B[2J\\u202Egnp.exe\\nfake line"));
  for (const char* raw : {"\x1B", "\x07", "\u202E", "\nfake"})
    EXPECT_THAT(words, Not(HasSubstr(raw)));
}

TEST_F(Outputs, LongRecordingsAreRefusedByEveryTool) {
  {
    RecordingWriter writer(recording_);
    const std::size_t car = writer.addVehicle("car", saloon());
    for (const double time : {0.0, 1e8}) writer.addPose(car, {.time = time});
  }
  for (const char* command :
       {"bumper-replay video run.jsonl f.mp4", "bumper-replay frames run.jsonl f",
        "bumper-plot run.jsonl f", "bumper-replay glb run.jsonl f.glb"})
    expectError(command, "1e+08 s are more than RecordingLimits::seconds, 86400");
  EXPECT_TRUE(names().empty());
  EXPECT_THAT(run("bumper-replay info run.jsonl --most-seconds 1e9").words, HasSubstr("2 poses"));
  expectError("bumper-replay frames run.jsonl f --scene run.jsonl --most-seconds 1e9", "run.jsonl");
}

TEST_F(Outputs, ASignalLeavesNothingUnfinished) {
  // An ffmpeg that never ends: the film is begun and stays so.
  const std::string setting =
      pretend("ffmpeg", "touch started; cat > /dev/null; exec sleep 600") + " BUMPER_FFMPEG=ffmpeg";
  for (const char* signal : {"TERM", "HUP"}) {  // a shell ignores INT for its background
    const Outcome outcome =
        run("bumper-replay video run.jsonl film.mp4 --size 160x120 & pid=$!; "
            "until [ -e started ]; do sleep 0.02; done; ls -A | grep -c part; "
            "kill -" +
                std::string(signal) + " $pid; wait $pid; echo \"ended by $?\"; rm started",
            setting + " export PATH BUMPER_FFMPEG;");
    EXPECT_THAT(outcome.words, HasSubstr("1\n")) << signal;
    EXPECT_THAT(outcome.words, HasSubstr("ended by 1")) << signal;  // 128 and the signal
    EXPECT_TRUE(names().empty()) << signal;
  }
}

}  // namespace
}  // namespace bumper::testing
