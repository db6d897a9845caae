#pragma once

#include <assimp/DefaultIOSystem.h>

#include <filesystem>
#include <string>

namespace bumper {

/// A file and those in its folder or below: whatever else it refers to does not exist. Links are
/// followed, and must not lead out of the folder; the file itself may be one that does.
class FolderFiles : public Assimp::DefaultIOSystem {
 public:
  explicit FolderFiles(const std::filesystem::path& file);

  [[nodiscard]] bool Exists(const char* file) const override;
  // NOLINTNEXTLINE(google-default-arguments): assimp's
  Assimp::IOStream* Open(const char* file, const char* mode = "rb") override;

  /// The first other file that was to be opened; empty if there was none.
  [[nodiscard]] const std::string& refused() const { return refused_; }

 private:
  [[nodiscard]] bool isAllowed(const std::filesystem::path& file) const;

  std::filesystem::path file_;
  std::filesystem::path folder_;
  std::string refused_;
};

}  // namespace bumper
