#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>

#include "bumper/render/recording_reader.h"
#include "bumper/render/recording_writer.h"
#include "long_run.h"
#include "temporary_folder.h"

namespace bumper {
namespace {

constexpr std::uint64_t megabyte = std::uint64_t{1} << 20U;

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// An hour of ten cars at 200 Hz: 7.2 million poses. Says what it took; only memory is asserted.
TEST(RecordingHour, isWrittenAndOpenedWithBoundedMemory) {
  const testing::TemporaryFolder folder;
  const auto file = folder.path() / "hour.jsonl";
  constexpr std::size_t vehicles = 10;
  constexpr int hour = 3600;  // s
  constexpr int rate = 200;   // Hz

  const std::uint64_t before = testing::peakMemory();
  auto start = std::chrono::steady_clock::now();
  {
    RecordingWriter writer(file);
    testing::addLongRun(writer, vehicles, hour, rate);
  }
  const double writing = secondsSince(start);
  const std::uint64_t writingMemory = testing::peakMemory() - before;
  const std::uint64_t size = std::filesystem::file_size(file);

  start = std::chrono::steady_clock::now();
  RecordingReader reader(file);
  const Recording instant = reader.read({.from = 2718.2818, .to = 2718.2818});
  const double opening = secondsSince(start);
  const auto impacts = reader.impacts();
  const double withImpacts = secondsSince(start);
  const std::uint64_t memory = testing::peakMemory() - before;

  std::filesystem::resize_file(file, size * 2 / 3);
  start = std::chrono::steady_clock::now();
  RecordingReader cut(file);
  const std::size_t impactsLeft = cut.impacts().size();
  const double cutOpening = secondsSince(start);

  std::printf(
      "%.0f MB, written in %.1f s with %.1f MB of memory; opened at 2718.2818 s in %.1f ms, with "
      "all impacts %.1f ms, %.1f MB; cut at two thirds with its impacts %.1f ms\n",
      static_cast<double>(size) / 1e6, writing, static_cast<double>(writingMemory) / 1e6,
      1e3 * opening, 1e3 * withImpacts, static_cast<double>(memory) / 1e6, 1e3 * cutOpening);

  EXPECT_EQ(impacts.size(), hour + 1U);
  for (const RecordedVehicle& vehicle : instant.vehicles()) {
    ASSERT_EQ(vehicle.poses.size(), 2U);
    EXPECT_NEAR(poseAt(vehicle, 2718.2818)->position.x(), 27182.818, 1e-6);
  }
  EXPECT_FALSE(cut.isComplete());
  EXPECT_NEAR(cut.lastTime().value(), 2400.0, 20.0);
  EXPECT_NEAR(static_cast<double>(impactsLeft), cut.lastTime().value(), 2.0);
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer's allocator keeps what was freed";
#endif
  EXPECT_LT(writingMemory, 2 * megabyte);
  EXPECT_LT(memory, 8 * megabyte);
}

}  // namespace
}  // namespace bumper
