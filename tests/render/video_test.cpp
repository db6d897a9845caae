// Films go down a pipe to ffmpeg: what happens to it must not happen to us, nor leave half a file.

#include "bumper/render/video.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string>

#include "bumper/response/error.h"
#include "temporary_folder.h"

namespace bumper::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class Video : public ::testing::Test {
 protected:
  ~Video() override { unsetenv("BUMPER_FFMPEG"); }

  /// A program in ffmpeg's place.
  void pretend(const std::string& script) {
    const std::filesystem::path program = folder_.path() / "pretended";
    std::ofstream(program) << "#!/bin/sh\n" << script;
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    setenv("BUMPER_FFMPEG", program.c_str(), 1);
  }

  [[nodiscard]] bool nothingIsLeft() const {
    const std::filesystem::directory_iterator entries(folder_.path());
    return std::all_of(begin(entries), end(entries),
                       [](const auto& entry) { return entry.path().filename() == "pretended"; });
  }

  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "film.mp4";
};

constexpr int width = 64;
constexpr int height = 48;

/// What does `inspects` when it is asked for the frames of a film, else `encodes`; $film is the
/// film's place.
std::string script(const std::string& inspects, const std::string& encodes) {
  return "for word; do case $word in file:*) film=${word#file:};; esac; last=$word; done\n"
         "if [ \"$last\" = pipe:1 ]; then\n" +
         inspects + "\nelse\n" + encodes + "\nfi\n";
}

// What it gets is what the film holds; it names a frame for each of width × height × 3 bytes.
const std::string copies = script(R"(echo '# comment'; bytes=$(wc -c < "$film")
while [ "$bytes" -gt 0 ]; do echo 'a frame'; bytes=$((bytes - 9216)); done)",
                                  R"(exec cat > "$film")");

TEST_F(Video, EveryPictureGoesDownThePipeAsItIs) {
  pretend(copies);
  VideoWriter film(file_, width, height, 30.0);
  std::string expected;
  for (int k = 0; k < 40; ++k) {
    Image picture(width, height, {static_cast<std::uint8_t>(k), 20, 30});
    picture.at(k, 1) = {255, 0, 1};
    for (const Rgb& pixel : picture.pixels()) {
      for (const std::uint8_t level : {pixel.red, pixel.green, pixel.blue})
        expected += static_cast<char>(level);
    }
    film.add(picture);
  }
  EXPECT_FALSE(std::filesystem::exists(file_));
  film.finish();
  std::ifstream stream(file_, std::ios::binary);
  const std::string got(std::istreambuf_iterator<char>(stream), {});
  EXPECT_TRUE(got == expected);
  std::filesystem::remove(file_);
  EXPECT_TRUE(nothingIsLeft());
}

TEST_F(Video, PlacesWithOddNamesAreLeftAlone) {
  pretend(copies);
  const auto odd = folder_.path() / "-a 'b' $(touch c):d.mp4";
  VideoWriter film(odd, width, height, 30.0);
  film.add(Image(width, height));
  film.finish();
  EXPECT_TRUE(std::filesystem::exists(odd));
  EXPECT_FALSE(std::filesystem::exists("c"));
}

TEST_F(Video, SaysWhatFfmpegSaysWhenItFails) {
  pretend("echo 'first words' >&2; echo 'Unknown encoder x' >&2; cat > /dev/null; exit 3");
  VideoWriter film(file_, width, height, 30.0);
  film.add(Image(width, height));
  EXPECT_THAT([&] { film.finish(); }, ThrowsMessage<Error>(AllOf(HasSubstr(file_.string()),
                                                                 HasSubstr("Unknown encoder x"))));
}

TEST_F(Video, ItsDeathIsAnErrorAndNoSignal) {
  pretend("echo 'no room' >&2; exit 1");
  VideoWriter film(file_, 1280, 720, 30.0);
  const Image picture(1280, 720);
  EXPECT_THAT(
      [&] {
        for (int k = 0; k < 100; ++k) film.add(picture);  // more than any pipe holds
      },
      ThrowsMessage<Error>(HasSubstr("no room")));
}

TEST_F(Video, WithoutFinishNothingIsLeft) {
  pretend(copies);
  {
    VideoWriter film(file_, width, height, 30.0);
    film.add(Image(width, height));
  }
  EXPECT_TRUE(nothingIsLeft());
}

TEST_F(Video, AFailureLeavesNothingAndKeepsWhatWasThere) {
  std::ofstream(file_) << "earlier film";
  pretend("for last; do :; done; echo half > \"${last#file:}\"; exit 1");
  {
    VideoWriter film(file_, width, height, 30.0);
    EXPECT_THROW(film.finish(), Error);
  }
  std::string content;
  std::getline(std::ifstream(file_), content);
  EXPECT_EQ(content, "earlier film");
  std::filesystem::remove(file_);
  EXPECT_TRUE(nothingIsLeft());
}

TEST_F(Video, FramesThatAreMissingAreAnErrorEvenIfFfmpegIsContent) {
  std::ofstream(file_) << "earlier film";
  pretend(script("echo 'a frame'", R"(exec cat > "$film")"));
  {
    VideoWriter film(file_, width, height, 30.0);
    for (int k = 0; k < 3; ++k) film.add(Image(width, height));
    EXPECT_THAT([&] { film.finish(); }, ThrowsMessage<Error>(HasSubstr("left 1 of 3 frames")));
  }
  pretend("exit 0");
  {
    VideoWriter film(file_, width, height, 30.0);
    EXPECT_THROW(
        {
          film.add(Image(width, height));
          film.finish();
        },
        Error);
  }
  EXPECT_EQ(std::filesystem::file_size(file_), 12U);
}

TEST_F(Video, AFilmThatCannotBeReadIsAnError) {
  pretend(script("echo 'no film' >&2; exit 1", R"(exec cat > "$film")"));
  VideoWriter film(file_, width, height, 30.0);
  film.add(Image(width, height));
  EXPECT_THAT([&] { film.finish(); },
              ThrowsMessage<Error>(AllOf(HasSubstr("cannot read"), HasSubstr("no film"))));
}

TEST_F(Video, AFilmWithoutPicturesIsAnError) {
  pretend(copies);
  VideoWriter film(file_, width, height, 30.0);
  EXPECT_THAT([&] { film.finish(); }, ThrowsMessage<Error>(HasSubstr("no picture")));
}

TEST_F(Video, AnFfmpegThatHangsIsStoppedAndQuoted) {
  constexpr double patience = 0.1;
  pretend("echo 'last words' >&2; exec sleep 600");
  for (const int count : {0, 200}) {  // less and more than a pipe holds
    VideoWriter film(file_, width, height, 30.0, patience);
    EXPECT_THAT(
        [&] {
          for (int k = 0; k < count; ++k) film.add(Image(width, height));
          film.finish();
        },
        ThrowsMessage<Error>(AllOf(HasSubstr(file_.string()), HasSubstr("did nothing for 0.1 s"),
                                   HasSubstr("last words"))));
  }
  EXPECT_TRUE(nothingIsLeft());
  EXPECT_THAT([&] { VideoWriter(file_, width, height, 30.0, 0.0); },
              ThrowsMessage<Error>(HasSubstr("patience of 0 s")));
}

TEST_F(Video, SaysThatFfmpegIsMissing) {
  setenv("BUMPER_FFMPEG", "/nowhere/ffmpeg", 1);
  EXPECT_THAT([&] { VideoWriter(file_, width, height, 30.0); },
              ThrowsMessage<Error>(AllOf(HasSubstr("/nowhere/ffmpeg"), HasSubstr("BUMPER_FFMPEG"),
                                         HasSubstr(file_.string()))));
  EXPECT_TRUE(nothingIsLeft());
}

TEST_F(Video, RefusesWhatItCannotMake) {
  pretend(copies);
  EXPECT_THAT([&] { VideoWriter(folder_.path() / "film.avi", width, height, 30.0); },
              ThrowsMessage<Error>(HasSubstr(".webm")));
  EXPECT_THAT([&] { VideoWriter(file_, width, height, 0.0); },
              ThrowsMessage<Error>(HasSubstr("1 to 240")));
  EXPECT_THAT([&] { VideoWriter(folder_.path() / "film.gif", width, height, 60.0); },
              ThrowsMessage<Error>(HasSubstr("1 to 50")));
  EXPECT_THAT([&] { VideoWriter(folder_.path() / "none" / "film.mp4", width, height, 30.0); },
              ThrowsMessage<Error>(HasSubstr("writable")));
  VideoWriter film(file_, width, height, 30.0);
  EXPECT_THAT([&] { film.add(Image(width + 1, height)); },
              ThrowsMessage<Error>(HasSubstr("65 x 48")));
}

// With the real program, where it is installed.
TEST_F(Video, RealFilmsOfEveryKindAreMade) {
  if (std::system("ffmpeg -version >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "ffmpeg is not installed";
  for (const char* name : {"film.mp4", "film.webm", "film.gif", "film.apng"}) {
    VideoWriter film(folder_.path() / name, 65, 47, 25.0);
    // Twice the same, and so at the end, are frames as well.
    for (const int k : {0, 1, 2, 2, 3, 4, 5, 6, 7, 8, 9, 9})
      film.add(Image(65, 47, {static_cast<std::uint8_t>(20 * k), 90, 0}));
    film.finish();
    EXPECT_GT(std::filesystem::file_size(folder_.path() / name), 300U) << name;
  }
}

}  // namespace
}  // namespace bumper::testing
