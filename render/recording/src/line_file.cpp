#include "line_file.h"

#include <algorithm>
#include <utility>

#include "bumper/response/error.h"

namespace bumper {

namespace {

constexpr std::size_t windowSize = std::size_t{64} << 10U;

}  // namespace

LineFile::LineFile(std::filesystem::path file, std::size_t longest)
    : file_(std::move(file)), longest_(longest) {
  std::error_code failure;
  if (!std::filesystem::is_regular_file(file_, failure)) {
    const bool isSpecial = std::filesystem::is_other(file_, failure);
    throw Error("cannot read " + file_.string() +
                (isSpecial ? ": it is no regular file" : ": there is no such file"));
  }
  stream_.open(file_, std::ios::binary);
  size_ = std::filesystem::file_size(file_, failure);
  if (!stream_ || failure) throw Error("cannot read " + file_.string());
}

std::string_view LineFile::bytes(std::uint64_t offset, std::size_t count) {
  count = static_cast<std::size_t>(std::min<std::uint64_t>(count, size_ - offset));
  if (offset < windowBegin_ || offset + count > windowBegin_ + window_.size()) {
    window_.resize(count);
    windowBegin_ = offset;
    stream_.seekg(static_cast<std::streamoff>(offset));
    stream_.read(window_.data(), static_cast<std::streamsize>(count));
    if (!stream_) {
      window_.clear();
      stream_.clear();
      throw Error("cannot read " + file_.string() + " at byte " + std::to_string(offset));
    }
  }
  return std::string_view(window_).substr(static_cast<std::size_t>(offset - windowBegin_));
}

std::optional<LineFile::Line> LineFile::lineAt(std::uint64_t begin) {
  if (begin >= size_) return {};
  // What is left of the window may do; else ever longer pieces are read.
  std::string_view text = bytes(begin, 1);
  for (std::size_t count = windowSize;; count *= 2) {
    const std::size_t length = text.find('\n');
    if (std::min(length, text.size()) > longest_) {
      throw Error(file_.string() + ", byte " + std::to_string(begin) +
                  ": a line is longer than RecordingLimits::lineBytes, " +
                  std::to_string(longest_) + ", allows");
    }
    if (length != std::string_view::npos) {
      return Line{.begin = begin,
                  .end = begin + length + 1,
                  .text = text.substr(0, length),
                  .hasBreak = true};
    }
    if (begin + text.size() == size_)
      return Line{.begin = begin, .end = size_, .text = text, .hasBreak = false};
    text = bytes(begin, count);
  }
}

std::uint64_t LineFile::beginFrom(std::uint64_t offset) {
  if (offset == 0) return 0;
  const auto line = lineAt(offset - 1);  // the rest of the line that this byte belongs to
  return line ? line->end : size_;
}

std::uint64_t LineFile::beginBefore(std::uint64_t begin) {
  std::uint64_t end = begin - 1;  // the line break before
  while (end > 0) {
    const bool isInside = windowBegin_ < end && end < windowBegin_ + window_.size();
    if (!isInside) {  // with the byte at `end`, so that the line found is whole in the window
      const std::uint64_t from = end > windowSize ? end - windowSize : 0;
      bytes(from, static_cast<std::size_t>(end - from) + 1);
    }
    const auto length = static_cast<std::size_t>(end - windowBegin_);
    const std::size_t found = std::string_view(window_).substr(0, length).rfind('\n');
    if (found != std::string_view::npos) return windowBegin_ + found + 1;
    end = windowBegin_;
  }
  return 0;
}

std::uint64_t LineFile::numberOf(std::uint64_t begin) {
  std::uint64_t number = 1;
  for (std::uint64_t from = 0; from < begin; from += windowSize) {
    const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(windowSize, begin - from));
    number +=
        static_cast<std::uint64_t>(std::ranges::count(bytes(from, count).substr(0, count), '\n'));
  }
  return number;
}

}  // namespace bumper
