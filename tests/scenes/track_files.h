#pragma once

#include <algorithm>
#include <filesystem>
#include <vector>

namespace bumper::tests {

/// The race tracks in a folder of torcs-data: of each track's own folder the file named like it.
inline std::vector<std::filesystem::path> trackFiles(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  if (!std::filesystem::exists(folder)) return files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::filesystem::path& file = entry.path();
    const bool isMesh = file.extension() == ".ac" || file.extension() == ".acc";
    if (isMesh && file.stem() == file.parent_path().filename()) files.push_back(file);
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace bumper::tests
