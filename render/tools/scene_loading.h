#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>

#include "bumper/scenes/scene_files.h"

namespace bumper::tools {

/// The options --up and --scale, of how a scene file is to be read.
void addUpAndScale(CLI::App& app, std::string& up, double& scale);

/// The axis that "x", "y" or "z" names; empty for anything else.
std::optional<UpAxis> upAxis(const std::string& name);

/// Reads a scene file and prints its warnings on standard error. `upOption` is the command line's
/// name of LoadOptions::up, which warnings and errors about it name too. `report`, if it is not
/// null, is what loadScene() said.
Scene loadScene(const std::filesystem::path& file, const std::string& upOption,
                const LoadOptions& options, LoadReport* report = nullptr);

}  // namespace bumper::tools
