#pragma once

#include <filesystem>
#include <initializer_list>
#include <string_view>

namespace bumper {

/// Makes a folder and those above it unless they exist; does nothing for an empty path. Throws
/// Error, naming the folder, if that fails.
void makeFolder(const std::filesystem::path& folder);

/// A file that is written beside its place, as `<place>.part`, and moved there when it is complete:
/// what stood in the place before is whole until then, and nothing half-written remains.
class OutputFile {
 public:
  explicit OutputFile(std::filesystem::path place);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  OutputFile(OutputFile&&) = delete;
  OutputFile& operator=(OutputFile&&) = delete;
  /// Removes what was written unless it was moved to its place.
  ~OutputFile();

  /// Where to write until then.
  [[nodiscard]] const std::filesystem::path& beside() const { return beside_; }

  /// Writes the parts one after the other, in place of anything written before. Throws Error,
  /// naming the place, if the folder is not writable or has no room.
  void write(std::initializer_list<std::string_view> parts) const;

  /// Replaces a file of that name. Throws Error, naming the place, if that fails.
  void moveToPlace();

 private:
  std::filesystem::path place_;
  std::filesystem::path beside_;
  bool isInPlace_ = false;
};

}  // namespace bumper
