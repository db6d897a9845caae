// A replay's frames: when they are, what they show, and that they come in order.

#include "bumper/render/replay.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "bumper/render/contact_sheet.h"
#include "bumper/response/error.h"
#include "bumper/scenes/paper_scenes.h"
#include "find_in_image.h"
#include "synthetic_run.h"
#include "temporary_folder.h"

namespace bumper::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double nextTo = 1e-9;  // s: rounding

TEST(ReplayTimes, WithoutSlowMotionGoByTheClock) {
  const Recording run = testRailRun();
  const std::vector<double> times = replayTimes(run, {.framesPerSecond = 25.0, .slowMotion = 1.0});
  ASSERT_EQ(times.size(), 105U);  // 0 to 4.19 s
  for (std::size_t k = 0; k < times.size(); ++k)
    EXPECT_NEAR(times[k], 0.04 * static_cast<double>(k), nextTo);
  EXPECT_EQ(replayTimes(run, {.framesPerSecond = 25.0, .speed = 2.0, .slowMotion = 1.0}).size(),
            53U);
}

TEST(ReplayTimes, GoSlowlyAroundHardImpactsAlone) {
  Recording run = testRailRun();  // impacts at 1.50, 1.60 and 2.45 s
  ImpactEvent weak = run.impacts()[2].event();
  weak.time = 3.7;
  weak.deltaV = 0.09 * 26.4;
  run.addImpact(weak);
  const ReplayTiming timing{.framesPerSecond = 30.0, .slowMotion = 5.0, .slowReach = 0.1};
  const std::vector<double> times = replayTimes(run, timing);
  const auto stepAt = [&](double time) {
    const auto next = std::ranges::upper_bound(times, time);
    return *next - *std::prev(next);
  };
  for (const double time : {1.45, 1.5, 1.55, 1.6, 1.65, 2.4, 2.5})
    EXPECT_NEAR(stepAt(time), 1.0 / 150.0, 1e-6) << time;
  for (const double time : {0.5, 2.0, 3.0, 3.7, 4.0})
    EXPECT_NEAR(stepAt(time), 1.0 / 30.0, 1e-6) << time;
  EXPECT_TRUE(std::ranges::is_sorted(times));
  // As much slow motion before an impact as after it.
  const auto before = std::ranges::count_if(times, [](double t) { return t > 2.2 && t < 2.45; });
  const auto after = std::ranges::count_if(times, [](double t) { return t > 2.45 && t < 2.7; });
  EXPECT_NEAR(static_cast<double>(before), static_cast<double>(after), 2.0);
}

/// Two poses, some time apart.
Recording standingFor(double from, double to) {
  Recording run;
  const std::size_t car = run.addVehicle("car", saloon());
  for (const double time : {from, to}) run.addPose(car, {.time = time});
  return run;
}

TEST(ReplayTimes, AreNoMoreThanAllowed) {
  EXPECT_THAT([] { replayTimes(standingFor(0.0, 1e8)); },
              ThrowsMessage<Error>(HasSubstr("from 0 to 1e+08 s has more than "
                                             "ReplayTiming::mostFrames, 216000")));
  ReplayTiming timing{.framesPerSecond = 10.0, .slowMotion = 1.0, .mostFrames = 11};
  EXPECT_EQ(replayTimes(standingFor(0.0, 1.05), timing).size(), 11U);
  timing.mostFrames = 10;
  EXPECT_THAT([&] { replayTimes(standingFor(0.0, 1.05), timing); },
              ThrowsMessage<Error>(HasSubstr("mostFrames, 10")));
  // Slow motion counts too.
  timing = {.framesPerSecond = 10.0, .slowMotion = 10.0, .slowReach = 0.5, .mostFrames = 60};
  EXPECT_THAT([&] { replayTimes(testRailRun(), timing); },
              ThrowsMessage<Error>(HasSubstr("mostFrames, 60")));
}

TEST(ReplayTimes, EndWhereTimeIsNotToldApart) {
  for (const double end : {1e17, 1e17 + 64.0})
    EXPECT_THAT([&] { replayTimes(standingFor(1e17, end)); },
                ThrowsMessage<Error>(HasSubstr("lost in the rounding")));
}

TEST(ReplayTimes, KeepToTheSpan) {
  const Recording run = testRailRun();
  const std::vector<double> times = replayTimes(run, {.from = 1.0, .to = 2.0});
  EXPECT_NEAR(times.front(), 1.0, nextTo);
  EXPECT_LE(times.back(), 2.0);
  EXPECT_GT(times.back(), 1.95);
  EXPECT_EQ(replayTimes(standingVehicle({0.0, 0.0}, 0.0)).size(), 1U);
}

TEST(ReplayTimes, RefuseWhatIsOutOfRange) {
  const Recording run = testRailRun();
  EXPECT_THAT([&] { replayTimes(run, {.framesPerSecond = 0.0}); },
              ThrowsMessage<Error>(HasSubstr("framesPerSecond")));
  EXPECT_THAT([&] { replayTimes(run, {.speed = std::nan("")}); },
              ThrowsMessage<Error>(HasSubstr("speed")));
  EXPECT_THAT([&] { replayTimes(run, {.slowMotion = 0.5}); },
              ThrowsMessage<Error>(HasSubstr("slowMotion")));
  EXPECT_THAT([&] { replayTimes(run, {.from = 9.0}); }, ThrowsMessage<Error>(HasSubstr("4.19")));
  EXPECT_THAT([] { replayTimes(Recording()); }, ThrowsMessage<Error>(HasSubstr("no pose")));
}

ReplayOptions smallFrames() {
  ReplayOptions options;
  options.picture.width = 240;
  options.picture.height = 160;
  options.timing.framesPerSecond = 10.0;
  options.timing.slowMotion = 1.0;
  options.timing.from = 1.4;
  options.timing.to = 2.3;
  return options;
}

TEST(Replay, FramesAreThePicturesOfTheirMomentsInOrder) {
  const Scene scene = testRail();
  const Recording run = testRailRun();
  ReplayOptions options = smallFrames();
  options.renderers = 3;
  std::vector<Image> frames;
  drawReplay(scene, run, options, [&](const Image& frame) { frames.push_back(frame); });
  const std::vector<double> times = replayTimes(run, options.timing);
  ASSERT_EQ(frames.size(), times.size());
  for (std::size_t k = 0; k < times.size(); k += 3) {
    SnapshotOptions picture = options.picture;
    picture.moment = times[k];
    EXPECT_TRUE(frames[k] == renderSnapshot(scene, run, picture)) << k;
  }
}

TEST(Replay, WritesNumberedFrames) {
  const TemporaryFolder folder;
  const auto place = folder.path() / "new";
  std::size_t told = 0;
  writeReplayFrames(testRail(), testRailRun(), place, smallFrames(),
                    [&](std::size_t done, std::size_t all) {
                      EXPECT_EQ(done, ++told);
                      EXPECT_EQ(all, 10U);
                    });
  EXPECT_EQ(told, 10U);
  EXPECT_EQ(readPng(place / "frame_00001.png").width(), 240);
  EXPECT_TRUE(std::filesystem::exists(place / "frame_00010.png"));
}

TEST(Replay, StopsWithWhatTheTakerThrows) {
  int taken = 0;
  EXPECT_THAT(
      [&] {
        drawReplay(testRail(), testRailRun(), smallFrames(), [&](const Image&) {
          if (++taken == 2) throw Error("enough");
        });
      },
      ThrowsMessage<Error>("enough"));
  EXPECT_EQ(taken, 2);
}

TEST(ContactSheet, HasARowForEachImpactButNotForItsFollowers) {
  const Scene scene = testRail();
  const Recording run = testRailRun();  // impacts at 1.50, 1.60 and 2.45 s
  ContactSheetOptions options{.pictureWidth = 200, .pictureHeight = 140};
  const int all = contactSheet(scene, run, options).height();
  const int withoutFollower = contactSheet(scene, withoutImpact(run, 1), options).height();
  options.impacts = 1;
  const int oneRow = contactSheet(scene, run, options).height();
  EXPECT_GT(withoutFollower - oneRow, 140);  // a row of pictures
  EXPECT_GT(all - withoutFollower, 0);       // a line of text
  EXPECT_LT(all - withoutFollower, 50);
}

TEST(ContactSheet, LooksPastWhatHidesTheVehicle) {
  // A car that stands at a wall on its left, which faces −y.
  Recording run = standingVehicle({20.0, 30.0}, 0.0);
  ImpactEvent event;
  event.vehicle = "saloon";
  event.barrier = "wall";
  event.contact = {22.05, 30.85, 0.56};
  event.normal = {0.0, -1.0, 0.0};
  event.arm = {2.05, 0.85};
  event.deltaV = event.approachSpeed = 4.0;
  run.addImpact(event);
  const Scene open = straightWall({0.0, 30.85}, {60.0, 30.85}, 1.0);
  // A bridge over the ground before it, which lies in the way at 42° above the horizontal.
  Scene bridged = open;
  const auto first = static_cast<std::uint32_t>(bridged.vertices.size());
  for (const auto& [x, y] : {std::pair(0.0, 24.0), {45.0, 24.0}, {45.0, 28.0}, {0.0, 28.0}})
    bridged.vertices.emplace_back(x, y, 4.0);
  bridged.triangles.push_back({{first, first + 1, first + 2}, 0});
  bridged.triangles.push_back({{first, first + 2, first + 3}, 0});

  const ContactSheetOptions options{.instants = {0.0}};
  const auto paintIn = [&](const Scene& scene) {
    const Image sheet = contactSheet(scene, run, options);
    // The row's picture stands below the overview.
    const auto begin =
        static_cast<std::ptrdiff_t>(sheet.width()) * (sheet.height() - options.pictureHeight - 40);
    return std::count_if(sheet.pixels().begin() + begin, sheet.pixels().end(), isPaint);
  };
  const auto seen = paintIn(open);
  ASSERT_GT(seen, 1000);
  EXPECT_GT(paintIn(bridged), seen / 2);
}

TEST(ContactSheet, PlacesOutsideTheRunAreEmpty) {
  const Scene scene = testRail();
  const Recording run = testRailRun();  // the last impact at 2.45 s, the end at 4.19 s
  ContactSheetOptions options{
      .pictureWidth = 200, .pictureHeight = 140, .impacts = 1, .instants = {0.0, 3.0}};
  const Image sheet = contactSheet(scene, run, options);
  const auto coloursIn = [&](int left) {
    std::vector<int> seen;
    for (int x = left; x < left + 200; ++x) {
      const Rgb& pixel = sheet.at(x, sheet.height() - 110);
      seen.push_back(pixel.red << 16 | pixel.green << 8 | pixel.blue);
    }
    std::ranges::sort(seen);
    return std::unique(seen.begin(), seen.end()) - seen.begin();
  };
  EXPECT_GT(coloursIn(12), 5);
  EXPECT_EQ(coloursIn(12 + 200 + 12), 1);
}

TEST(ContactSheet, RefusesWhatItCannotDraw) {
  const Scene scene = testRail();
  EXPECT_THAT([&] { contactSheet(scene, Recording()); }, ThrowsMessage<Error>(HasSubstr("poses")));
  EXPECT_THAT([&] { contactSheet(scene, testRailRun(), {.impacts = 0}); },
              ThrowsMessage<Error>(HasSubstr("impacts")));
  EXPECT_THAT(
      [&] {
        contactSheet(scene, testRailRun(), {.instants = {1.0, 0.0}});
      },
      ThrowsMessage<Error>(HasSubstr("ascending")));
  EXPECT_THAT([&] { contactSheet(scene, testRailRun(), {.pictureWidth = 10}); },
              ThrowsMessage<Error>(HasSubstr("pictureWidth")));
}

}  // namespace
}  // namespace bumper::testing
