#pragma once

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>

namespace bumper {

/// With the dot, in small letters.
inline std::string lowerCaseEnding(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

}  // namespace bumper
