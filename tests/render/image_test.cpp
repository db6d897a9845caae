#include "bumper/render/image.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>
#include <sys/stat.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <utility>

#include "bumper/render/image_compare.h"
#include "bumper/response/error.h"
#include "temporary_folder.h"

namespace bumper {
namespace {

using ::testing::HasSubstr;
using testing::TemporaryFolder;
using ::testing::ThrowsMessage;

Image noise(int width, int height) {
  std::mt19937 random(3);
  Image image(width, height);
  for (Rgb& pixel : image.pixels()) {
    const auto bits = random();
    pixel = {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8U),
             static_cast<std::uint8_t>(bits >> 16U)};
  }
  return image;
}

std::string readBytes(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void writeBytes(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

void expectUnreadable(const std::filesystem::path& file, const std::string& what) {
  try {
    readPng(file);
    ADD_FAILURE() << what << ": no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr(file.string())) << what;
  }
}

TEST(Image, hasItsOriginAtTheUpperLeft) {
  Image image(3, 2, {1, 2, 3});
  image.at(2, 1) = {9, 8, 7};
  EXPECT_EQ(image.pixels().size(), 6U);
  EXPECT_EQ(image.pixels()[5], (Rgb{9, 8, 7}));
  EXPECT_EQ(image.pixels()[4], (Rgb{1, 2, 3}));
}

TEST(Image, rejectsSizesThatCannotBe) {
  EXPECT_THROW(Image(0, 5), Error);
  EXPECT_THROW(Image(5, -1), Error);
  EXPECT_THROW(Image(Image::maxSide + 1, 1), Error);
}

TEST(Image, thatWasMovedFromHasNoPixels) {
  Image first = noise(7, 5);
  const Image copy = first;
  Image second = std::move(first);
  EXPECT_EQ(second, copy);
  EXPECT_EQ(first.width() * first.height(), 0);  // NOLINT(bugprone-use-after-move): what it is for
  EXPECT_TRUE(first.pixels().empty());
  EXPECT_THROW(compareImages(first, first), Error);
  const TemporaryFolder folder;
  EXPECT_THROW(writePng(first, folder.path() / "none.png"), Error);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  first = std::move(second);
  EXPECT_EQ(first, copy);
  EXPECT_EQ(second.width() * second.height(), 0);  // NOLINT(bugprone-use-after-move)
}

TEST(Png, roundTripKeepsEveryPixel) {
  const TemporaryFolder folder;
  for (const auto& [width, height] : {std::pair{1, 1}, {3, 5}, {257, 64}}) {
    const Image image = noise(width, height);
    writePng(image, folder.path() / "noise.png");
    EXPECT_EQ(readPng(folder.path() / "noise.png"), image);
  }
}

TEST(Png, readsTransparencyOnWhite) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "transparent.png";
  const std::array<std::uint8_t, 8> pixels = {10, 20, 30, 255, 10, 20, 30, 0};
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = 2;
  png.height = 1;
  png.format = PNG_FORMAT_RGBA;
  ASSERT_NE(png_image_write_to_file(&png, file.c_str(), 0, pixels.data(), 0, nullptr), 0);
  const Image image = readPng(file);
  EXPECT_EQ(image.at(0, 0), (Rgb{10, 20, 30}));
  EXPECT_EQ(image.at(1, 0), (Rgb{255, 255, 255}));
}

TEST(Png, namesAFileThatIsNoPicture) {
  const TemporaryFolder folder;
  expectUnreadable(folder.path() / "absent.png", "absent");
  expectUnreadable(folder.path(), "a folder");
  writeBytes(folder.path() / "empty.png", "");
  expectUnreadable(folder.path() / "empty.png", "empty");
  writeBytes(folder.path() / "text.png", "this is no picture, though long enough to be one");
  expectUnreadable(folder.path() / "text.png", "text");
}

TEST(Png, refusesAFileCutOffAnywhere) {
  const TemporaryFolder folder;
  const auto whole = folder.path() / "whole.png";
  writePng(noise(6, 5), whole);
  const std::string bytes = readBytes(whole);
  const auto cut = folder.path() / "cut.png";
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    writeBytes(cut, bytes.substr(0, size));
    expectUnreadable(cut, "the first " + std::to_string(size) + " bytes");
  }
}

TEST(Png, refusesDamagedPixels) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "damaged.png";
  writePng(noise(40, 40), file);
  std::string bytes = readBytes(file);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 0x10);
  writeBytes(file, bytes);
  expectUnreadable(file, "a flipped bit");
}

TEST(Png, refusesAHugePictureBeforeItTakesItsMemory) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "huge.png";
  // Signature, then a header of 900,000 × 900,000 pixels with its checksum, then the end.
  std::string bytes("\x89PNG\r\n\x1a\n\0\0\0\x0DIHDR\x00\x0D\xBB\xA0\x00\x0D\xBB\xA0\x08\x02\0\0\0",
                    29);
  std::uint32_t crc = 0xFFFFFFFFU;
  for (std::size_t k = 12; k < bytes.size(); ++k) {
    crc ^= static_cast<std::uint8_t>(bytes[k]);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
  }
  crc = ~crc;
  for (const unsigned shift : {24U, 16U, 8U, 0U}) bytes += static_cast<char>(crc >> shift);
  bytes += std::string("\0\0\0\0IDAT\x35\xAF\x06\x1E\0\0\0\0IEND\xAE\x42\x60\x82", 24);
  writeBytes(file, bytes);
  try {
    readPng(file);
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("900000 x 900000"));
  }
}

TEST(Png, refusesMorePixelsThanAllowed) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "picture.png";
  writePng(noise(40, 30), file);
  EXPECT_EQ(readPng(file, 1200).width(), 40);
  EXPECT_THAT([&] { readPng(file, 1199); },
              ThrowsMessage<Error>(HasSubstr("40 x 30 pixels, allowed are 1199 in all")));
  writePng(Image(16384, 4097), file);
  expectUnreadable(file, "67 million pixels");
}

TEST(Png, refusesMoreBytesThanItsPixelsCanTake) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "picture.png";
  writePng(noise(40, 30), file);
  std::filesystem::resize_file(file, std::uintmax_t{1} << 40U);  // takes no room
  expectUnreadable(file, "a terabyte");
}

TEST(Png, refusesWhatIsNoRegularFileAtOnce) {
  const TemporaryFolder folder;
  const auto pipe = folder.path() / "pipe.png";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  for (const auto& file : {pipe, std::filesystem::path("/dev/zero")}) {
    EXPECT_THAT([&] { readPng(file); },
                ThrowsMessage<Error>(HasSubstr(file.string() + ": it is no regular file")));
  }
}

TEST(Png, namesAFileThatCannotBeWritten) {
  const TemporaryFolder folder;
  const auto inTheWay = folder.path() / "folder.png";
  std::filesystem::create_directories(inTheWay / "not empty");
  for (const auto& file : {folder.path() / "absent" / "picture.png", inTheWay}) {
    try {
      writePng(Image(2, 2), file);
      ADD_FAILURE() << "no error";
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr(file.string()));
    }
  }
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    EXPECT_EQ(entry.path().filename(), "folder.png");
}

}  // namespace
}  // namespace bumper
