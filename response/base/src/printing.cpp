#include "bumper/base/printing.h"

#include <stdio_ext.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "bumper/response/error.h"

namespace bumper {

namespace {

/// A character and its bytes; no bytes where there is none.
struct Character {
  char32_t code = 0;
  std::size_t bytes = 0;
};

/// Of text that is not empty: UTF-8 as RFC 3629 has it.
Character firstOf(std::string_view text) {
  const auto byte = [&](std::size_t k) {
    return k < text.size() ? static_cast<unsigned char>(text[k]) : 0U;
  };
  const unsigned lead = byte(0);
  if (lead < 0x80) return {lead, 1};
  if (lead < 0xC2 || lead > 0xF4) return {};
  const std::size_t bytes = lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
  char32_t code = lead & (0x7FU >> bytes);
  for (std::size_t k = 1; k < bytes; ++k) {
    if ((byte(k) & 0xC0U) != 0x80U) return {};
    code = (code << 6U) | (byte(k) & 0x3FU);
  }
  constexpr std::array<char32_t, 5> least{0, 0, 0x80, 0x800, 0x10000};
  const bool isSurrogate = code >= 0xD800 && code <= 0xDFFF;
  if (code < least.at(bytes) || isSurrogate || code > 0x10FFFF) return {};
  return {code, bytes};
}

bool isHarmless(char32_t code) {
  const bool isControl = code < 0x20 || (code >= 0x7F && code < 0xA0);
  const bool breaksLine = code == 0x2028 || code == 0x2029;
  const bool turnsWriting = code == 0x061C || code == 0x200E || code == 0x200F ||
                            (code >= 0x202A && code <= 0x202E) ||
                            (code >= 0x2066 && code <= 0x2069);
  return !isControl && !breaksLine && !turnsWriting;
}

std::string escaped(const char* format, unsigned value) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

}  // namespace

std::string printable(std::string_view text) {
  std::string shown;
  while (!text.empty()) {
    const Character character = firstOf(text);
    const std::size_t bytes = character.bytes == 0 ? 1 : character.bytes;
    if (character.bytes == 0)
      shown += escaped("\\x%02X", static_cast<unsigned char>(text.front()));
    else if (isHarmless(character.code))
      shown += text.substr(0, bytes);
    else if (character.code == '\n')
      shown += "\\n";
    else
      shown += escaped(character.code < 0x100 ? "\\x%02X" : "\\u%04X", character.code);
    text.remove_prefix(bytes);
  }
  return shown;
}

void closeStandardOutput() {
  const bool isUsed = __fpending(stdout) > 0;
  const bool hadFailed = std::ferror(stdout) != 0;
  errno = 0;
  const bool isClosed = std::fclose(stdout) == 0;
  if (isClosed && !hadFailed) return;
  if (!hadFailed && !isUsed && errno == EBADF) return;
  throw Error(std::string("cannot write standard output") +
              (errno != 0 ? std::string(": ") + std::strerror(errno) : ""));
}

}  // namespace bumper
