#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>

namespace bumper {

/// The lines of a text file of any size, found from any byte. Keeps a part of the file in memory,
/// no more than the longest line needs. All throw Error, naming the file, if it cannot be read.
class LineFile {
 public:
  struct Line {
    std::uint64_t begin = 0;  ///< its first byte
    std::uint64_t end = 0;    ///< the first byte of the next line
    std::string_view text;    ///< without line break; valid until the next call
    bool hasBreak = false;    ///< false: the file ends within or right behind it
  };

  /// Of a longer line than `longest` bytes, lineAt() throws Error.
  LineFile(std::filesystem::path file, std::size_t longest);

  /// Bytes, when it was opened.
  [[nodiscard]] std::uint64_t size() const { return size_; }

  /// The line that begins at this byte; nothing at the file's end.
  std::optional<Line> lineAt(std::uint64_t begin);

  /// The first byte at or after `offset` at which a line begins; the file's size if there is none.
  std::uint64_t beginFrom(std::uint64_t offset);

  /// The byte at which the line before the one that begins at `begin` begins; `begin` > 0.
  std::uint64_t beginBefore(std::uint64_t begin);

  /// The number of the line that begins at this byte, counted from 1. Reads all that comes before.
  std::uint64_t numberOf(std::uint64_t begin);

 private:
  /// Of the bytes from `offset` on, at least one and at most `count`.
  std::string_view bytes(std::uint64_t offset, std::size_t count);

  std::filesystem::path file_;
  std::size_t longest_;
  std::ifstream stream_;
  std::uint64_t size_ = 0;
  std::string window_;             ///< the part in memory
  std::uint64_t windowBegin_ = 0;  ///< where it begins in the file
};

}  // namespace bumper
