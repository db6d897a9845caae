#include "border.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <new>
#include <string_view>

namespace bumper::c_api {

namespace {

// Has its place beforehand: there must be a message when there is no memory, too.
constinit thread_local std::array<char, 1024> lastError{};

// Cuts off what is too long, between two characters of UTF-8.
void keep(std::string_view function, std::string_view text) noexcept {
  constexpr std::string_view separator = ": ";
  char* end = lastError.data();
  std::size_t room = lastError.size() - 1;
  for (std::string_view part : {function, separator, text}) {
    std::size_t length = std::min(part.size(), room);
    const auto continuesCharacter = [&] {
      return (static_cast<unsigned char>(part[length]) & 0xC0U) == 0x80U;
    };
    while (length > 0 && length < part.size() && continuesCharacter()) --length;
    std::memcpy(end, part.data(), length);
    end += length;
    room -= length;
  }
  *end = '\0';
}

}  // namespace

int reported(const char* function) noexcept {
  try {
    throw;
  } catch (const StaleHandle& error) {
    keep(function, error.what());
    return BUMPER_STALE_HANDLE;
  } catch (const TooMany& error) {
    keep(function, error.what());
    return BUMPER_TOO_MANY;
  } catch (const Error& error) {
    keep(function, error.what());
    return BUMPER_INVALID_ARGUMENT;
  } catch (const std::bad_alloc&) {
    keep(function, "out of memory");
    return BUMPER_OUT_OF_MEMORY;
  } catch (const std::exception& error) {
    keep(function, error.what());
    return BUMPER_INTERNAL_ERROR;
  } catch (...) {
    keep(function, "an unknown defect");
    return BUMPER_INTERNAL_ERROR;
  }
}

std::string Name::full() const {
  std::string result = of != nullptr ? of->full() : std::string();
  if (!result.empty() && *text != '\0') result += '.';
  result += text;
  if (index >= 0) result += '[' + std::to_string(index) + ']';
  return result;
}

void refuse(const Name& name, const std::string& defect) {
  throw Error(name.full() + ' ' + defect);
}

extern "C" const char* bumper_last_error() { return lastError.data(); }

}  // namespace bumper::c_api
