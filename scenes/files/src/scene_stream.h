#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "bumper/base/api.h"
#include "file_scene.h"

namespace BUMPER_INTERNAL bumper {

/// What the child process returns: what it read, or the text of an error.
using ReadResult = std::variant<FileScene, std::string>;

/// As bytes for a pipe between two programs of one machine.
std::string pack(const ReadResult& result);

/// Nothing if the bytes are not exactly what pack() makes, or of more meshes than `budget` allows.
std::optional<ReadResult> unpack(std::string_view bytes, const SceneBudget& budget);

/// No scene within the budget takes more bytes.
std::size_t longestAnswer(const SceneBudget& budget);

}  // namespace bumper
