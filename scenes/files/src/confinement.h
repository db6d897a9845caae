#pragma once

#include <cstddef>
#include <filesystem>

namespace bumper {

/// No core dump, no more than so much memory, bytes; no file may grow, and no process be started
/// unless this one is root's.
void limitResources(std::size_t memory);

/// Gives up all that reading a file does not need, for good: this process gains no privileges any
/// more, and where the kernel has Landlock it can only open the file, and read what is in its
/// folder. Whether it has. What is open stays open.
bool confineTo(const std::filesystem::path& file);

}  // namespace bumper
