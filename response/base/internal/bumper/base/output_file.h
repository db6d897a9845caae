#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string_view>

#include "bumper/base/api.h"
#include "bumper/base/descriptor.h"

namespace BUMPER_INTERNAL bumper {

/// Makes a folder and those above it unless they exist; does nothing for an empty path. Throws
/// Error, naming the folder, if that fails.
void makeFolder(const std::filesystem::path& folder);

/// Waits until a file's contents have reached the disk; does nothing for what is no regular file.
/// Throws Error, naming the file, if they cannot.
void syncToDisk(const std::filesystem::path& file);

/// A file that takes its place when it is complete: what stood there before is whole until then,
/// and nothing half-written is ever found there. All that this project writes at once is written
/// so.
///
/// Until then it is a file beside the place, under a name that nobody else has, so that two writers
/// do not meet. It replaces regular files alone, and keeps their mode and, where that is allowed,
/// their owner; other hard links keep the old contents. Symbolic links stay: what they lead to is
/// written. Into a device, a pipe or another process's open file (/dev/stdout) the contents are
/// copied in the end, as a shell would write there.
///
/// All throw Error, naming the place and the reason.
class OutputFile {
 public:
  /// Makes the file, so that a place that cannot be written is known before the work.
  explicit OutputFile(std::filesystem::path place);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  OutputFile(OutputFile&&) = delete;
  OutputFile& operator=(OutputFile&&) = delete;
  /// Removes what was written unless it was moved to its place.
  ~OutputFile();

  /// Under which this process and its children open it until then: plain characters, whatever the
  /// place is called.
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// Writes the parts one after the other, in place of anything written before.
  void write(std::initializer_list<std::string_view> parts) const;

  /// Bytes, so far.
  [[nodiscard]] std::uintmax_t size() const;

  /// When it returns, all of it has reached the disk.
  void moveToPlace();

 private:
  /// What is in the place.
  struct Old {
    mode_t mode;
    uid_t owner;
    gid_t group;
  };

  void findTarget();
  void makeBeside();
  void makeNameless();
  void copyTo(int target) const;
  void require(bool succeeded) const;
  [[noreturn]] void fail(std::string_view reason) const;

  std::filesystem::path place_;
  std::filesystem::path target_;  ///< where symbolic links lead
  bool isReplaced_ = true;        ///< false: copied into what is there
  std::optional<Old> old_;
  std::filesystem::path beside_;  ///< empty: it has no name
  Descriptor file_;
  std::filesystem::path path_;
};

/// For the beginning of a program's main(): SIGHUP, SIGINT and SIGTERM, unless they are ignored,
/// end it as ever, but remove unfinished files first. They reach threads that are started later no
/// more.
void removeUnfinishedFilesOnSignals();

}  // namespace bumper
