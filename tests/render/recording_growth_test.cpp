// A recording's size, and the work of writing and of reading it, grow as the number of poses, up to
// a million. Work is counted as the bytes that are allocated. A program of its own, because
// operator new is replaced in it.

#include <gtest/gtest.h>

#include <filesystem>

#include "allocated_bytes.h"
#include "bumper/render/recording.h"
#include "bumper/render/recording_reader.h"
#include "bumper/render/recording_writer.h"
#include "synthetic_run.h"
#include "temporary_folder.h"

namespace bumper {
namespace {

TEST(RecordingGrowth, IsInProportionToTheNumberOfPoses) {
  const testing::TemporaryFolder folder;
  const auto file = folder.path() / "run.jsonl";
  constexpr double mostInFile = 400.0;  // bytes a pose
  constexpr double mostWritten = 4e3;   // bytes allocated a pose
  constexpr double mostRead = 1e4;      // likewise
  constexpr double around = 1e6;        // bytes, whatever the number
  for (const int poses : {1'000, 10'000, 100'000, 1'000'000}) {
    std::size_t before = tests::allocatedBytes();
    {
      RecordingWriter writer(file);
      const std::size_t car = writer.addVehicle("car", testing::saloon());
      for (int i = 0; i < poses; ++i) {
        RecordedPose pose;
        pose.time = 0.01 * i;
        pose.position = {0.123456789 * i, 0.987654321, 0.55};
        writer.addPose(car, pose);
      }
    }
    EXPECT_LE(static_cast<double>(tests::allocatedBytes() - before), around + mostWritten * poses)
        << poses;
    EXPECT_LE(static_cast<double>(std::filesystem::file_size(file)), around + mostInFile * poses);

    before = tests::allocatedBytes();
    const Recording recording = readRecording(file);
    EXPECT_EQ(recording.vehicles()[0].poses.size(), static_cast<std::size_t>(poses));
    EXPECT_LE(static_cast<double>(tests::allocatedBytes() - before), around + mostRead * poses)
        << poses;

    // An instant costs no more than what lies between two places of the index.
    before = tests::allocatedBytes();
    RecordingReader(file).read({.from = 0.004 * poses, .to = 0.004 * poses});
    EXPECT_LE(static_cast<double>(tests::allocatedBytes() - before), 2e7 + 100.0 * poses) << poses;
  }
}

}  // namespace
}  // namespace bumper
