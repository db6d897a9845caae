#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "bumper/response/error.h"
#include "bumper/scenes/scene_files.h"

namespace bumper {

/// What a file holds, in its own axes and unit, nothing welded or dropped yet.
struct FileScene {
  Scene scene;
  std::string format;
  std::optional<UpAxis> up;  ///< if the file or its format states it
  double metresPerUnit = 1.0;
  std::size_t pointsAndLines = 0;
  std::size_t emptyMeshes = 0;
};

/// Reports loading; never empty.
using Progress = std::function<void(LoadStage stage, double share)>;

inline Error fileError(const std::filesystem::path& file, const std::string& what) {
  return Error("scene file \"" + file.string() + "\" " + what);
}

}  // namespace bumper
