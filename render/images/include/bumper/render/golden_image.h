#pragma once

#include <filesystem>
#include <string>

#include "bumper/base/api.h"
#include "bumper/render/image.h"
#include "bumper/render/image_compare.h"

namespace BUMPER_API bumper {

struct GoldenOptions {
  ImageCompareOptions compare{};
  /// Where the actual and the difference picture are left; made if it does not exist.
  std::filesystem::path output = "golden_differences";
};

struct GoldenResult {
  bool matches = false;
  std::string explanation;  ///< how far the pictures differ, and which files to look at
};

/// Whether a picture is what a golden file holds. If not, `<golden's name>_actual.png` and
/// `<golden's name>_difference.png` are left in the output folder; if it is, such files of an
/// earlier run are removed. A golden file that is missing is not matched, nor is one of another
/// size. Throws Error, naming the file, if the golden file is damaged or a picture cannot be
/// written.
///
/// If the environment variable BUMPER_UPDATE_GOLDEN is set, and neither empty nor "0", the picture
/// becomes the golden file instead, and matches.
GoldenResult compareWithGolden(const Image& actual, const std::filesystem::path& golden,
                               const GoldenOptions& options = {});

}  // namespace bumper
