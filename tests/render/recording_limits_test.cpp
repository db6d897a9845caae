// What a recording may not ask of its reader: each limit, and numbers that are not what they are
// taken for.

#include "bumper/render/recording_limits.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <string>

#include "bumper/render/recording_reader.h"
#include "bumper/render/recording_writer.h"
#include "bumper/response/error.h"
#include "synthetic_run.h"
#include "temporary_folder.h"
#include "text_file.h"

namespace bumper::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class RecordingLimit : public ::testing::Test {
 protected:
  /// A recording of one car, whose lines behind the header are these.
  void write(const std::string& lines) {
    {
      RecordingWriter writer(file_);
      writer.addVehicle("car", saloon());
      writer.flush();
    }
    const std::string text = readText(file_);
    header_ = text.substr(0, text.find('\n') + 1);
    writeText(file_, header_ + lines);
  }

  /// The same with a header in which some words are replaced.
  void writeHeader(const std::string& words, const std::string& others) {
    write("");
    std::string text = header_;
    text.replace(text.find(words), words.size(), others);
    writeText(file_, text + poses("0"));
  }

  static std::string poses(const std::string& time, const std::string& vehicle = "0") {
    return R"({"kind":"poses","time":)" + time + R"(,"poses":[[)" + vehicle +
           ",0,0,0.5,1,0,0,0,10,0,0,0]]}\n";
  }

  void expectError(const std::string& words, const RecordingLimits& limits = {}) const {
    EXPECT_THAT([&] { readRecording(file_, nullptr, limits); },
                ThrowsMessage<Error>(AllOf(HasSubstr(file_.string()), HasSubstr(words))))
        << words;
  }

  [[nodiscard]] std::size_t posesRead(const RecordingLimits& limits = {}) const {
    return readRecording(file_, nullptr, limits).vehicles()[0].poses.size();
  }

  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "run.jsonl";
  std::string header_;
};

TEST_F(RecordingLimit, secondsAreThoseOfThePosesThatAreRead) {
  write(poses("0") + poses("1") + poses("1e8"));
  expectError("RecordingLimits::seconds");
  EXPECT_EQ(posesRead({.seconds = 1e9}), 3U);
  EXPECT_EQ(RecordingReader(file_).read({.to = 0.5}).vehicles()[0].poses.size(), 2U);
  write(poses("1e9") + poses("1000086400"));
  EXPECT_EQ(posesRead(), 2U) << "a day, whenever it was";
}

TEST_F(RecordingLimit, timesTellStepsApart) {
  write(poses("1e17") + poses("1e17"));
  expectError("its time is 1e+17 s: RecordingLimits::latest, 1e+10 s");
  EXPECT_EQ(posesRead({.latest = 1e18}), 2U);
  write(poses("-2e10"));
  expectError("latest");
  write(poses("0") + R"({"time":1e11,"kind":"poses","poses":[]})" + '\n');
  expectError("line 3: its time is 1e+11 s");
}

TEST_F(RecordingLimit, integersAreIntegersAndInRange) {
  for (const char* number : {"1e35", "99999999999999999999999999999999990", "-1", "1.5", "0.0",
                             "\"0\"", "null", "18446744073709551616"}) {
    write(poses("0", number));
    expectError("a vehicle's index is ");
    writeHeader(R"("triangles":0)", R"("triangles":)" + std::string(number));
    expectError("triangles is ");
    writeHeader(R"("version":1)", R"("version":)" + std::string(number));
    expectError("version");
    write(poses("0") + R"({"kind":"end","index":1,"impacts":)" + number + "}\n");
    expectError("impacts is ");
  }
  write(poses("0") + R"({"kind":"end","index":1e300,"impacts":0})" + '\n');
  expectError("a byte of the file is ");
  write(poses("0", "18446744073709551615"));
  expectError("there is no vehicle 18446744073709551615");
}

TEST_F(RecordingLimit, depthIsThatOutsideOfWords) {
  const auto nested = [&](std::size_t depth) {
    return R"({"kind":"poses","x":)" + std::string(depth - 1, '[') + std::string(depth - 1, ']') +
           R"(,"time":0,"poses":[]})" + '\n' + poses("1");
  };
  write(nested(32));
  EXPECT_EQ(posesRead(), 1U);
  write(nested(33));
  expectError("RecordingLimits::depth, 32");
  write(nested(1'000'000));
  expectError("RecordingLimits::depth");
  write(R"({"kind":"poses","x":"\"[[[[{{{{\\","time":0,"poses":[]})" + std::string("\n") +
        poses("1"));
  EXPECT_EQ(posesRead({.depth = 4}), 1U);
}

TEST_F(RecordingLimit, linesAreAsLongAsAllowed) {
  const std::string line = R"({"kind":"poses","time":0,"poses":[],"x":")";
  write(line + std::string(10000 - line.size() - 2, 'x') + "\"}\n" + poses("1"));
  EXPECT_EQ(posesRead({.lineBytes = 10000}), 1U);
  expectError("RecordingLimits::lineBytes, 9999", {.lineBytes = 9999});
  writeText(file_, std::string((16U << 20U) + 1, '['));
  expectError("RecordingLimits::lineBytes");
}

TEST_F(RecordingLimit, namesAreCountedTogether) {
  {
    RecordingWriter writer(file_, {.scene = {}, .parameters = {{"a", 1.0}, {"b", "word"}}});
    writer.addVehicle("car", saloon(), {{"mesh", "car.glb"}});
    writer.addVehicle("lorry", saloon());
  }
  expectError("its 5 vehicles, parameters and settings are more than RecordingLimits::names, 4",
              {.names = 4});
  EXPECT_EQ(readRecording(file_, nullptr, {.names = 5}).vehicles().size(), 2U);
}

TEST_F(RecordingLimit, anImpactThatIsIndexedTwiceIsNoTwo) {
  writeRecording(testRailRun(), file_);
  std::string text = readText(file_);
  const std::size_t first = text.find("[[", text.find(R"("kind":"index")")) + 1;
  const std::string entry = text.substr(first, text.find(']', first) + 1 - first);
  text.insert(first, entry + ",");
  writeText(file_, text);
  EXPECT_THAT([&] { RecordingReader(file_).impacts(); },
              ThrowsMessage<Error>(HasSubstr("out of order")));
}

TEST_F(RecordingLimit, whatIsNoRegularFileIsRefusedAtOnce) {
  const auto pipe = folder_.path() / "pipe.jsonl";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  for (const auto& file : {pipe, std::filesystem::path("/dev/zero")}) {
    EXPECT_THAT([&] { const RecordingReader reader(file); },
                ThrowsMessage<Error>(HasSubstr(file.string() + ": it is no regular file")));
  }
}

}  // namespace
}  // namespace bumper::testing
