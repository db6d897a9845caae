#include "folder_files.h"

#include <algorithm>
#include <system_error>

namespace bumper {

namespace {

/// Absolute and without links, as far as it exists; empty if that cannot be said.
std::filesystem::path resolved(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::path result = std::filesystem::weakly_canonical(path, error);
  return error ? std::filesystem::path() : result;
}

}  // namespace

FolderFiles::FolderFiles(const std::filesystem::path& file)
    : file_(resolved(file)), folder_(resolved(std::filesystem::absolute(file).parent_path())) {}

bool FolderFiles::isAllowed(const std::filesystem::path& file) const {
  const std::filesystem::path place = resolved(file);
  if (place.empty()) return false;
  return place == file_ ||
         std::mismatch(folder_.begin(), folder_.end(), place.begin(), place.end()).first ==
             folder_.end();
}

bool FolderFiles::Exists(const char* file) const {
  return isAllowed(file) && DefaultIOSystem::Exists(file);
}

Assimp::IOStream* FolderFiles::Open(const char* file, const char* mode) {
  if (isAllowed(file)) return DefaultIOSystem::Open(file, mode);
  if (refused_.empty()) refused_ = file;
  return nullptr;
}

}  // namespace bumper
