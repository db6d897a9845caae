#include "bumper/render/golden_image.h"

#include <cstdlib>
#include <sstream>
#include <string_view>
#include <system_error>

#include "bumper/base/output_file.h"

namespace bumper {

namespace {

bool isUpdateAsked() {
  const char* value = std::getenv("BUMPER_UPDATE_GOLDEN");
  return value != nullptr && *value != '\0' && std::string_view(value) != "0";
}

std::string sizeOf(const Image& image) {
  return std::to_string(image.width()) + " x " + std::to_string(image.height());
}

}  // namespace

GoldenResult compareWithGolden(const Image& actual, const std::filesystem::path& golden,
                               const GoldenOptions& options) {
  if (isUpdateAsked()) {
    makeFolder(golden.parent_path());
    writePng(actual, golden);
    return {.matches = true, .explanation = "which was written to " + golden.string()};
  }
  const std::string name = golden.stem().string();
  const std::filesystem::path folder = std::filesystem::absolute(options.output);
  const std::filesystem::path actualFile = folder / (name + "_actual.png");
  const std::filesystem::path differenceFile = folder / (name + "_difference.png");
  std::error_code absent;
  std::filesystem::remove(actualFile, absent);
  std::filesystem::remove(differenceFile, absent);

  std::ostringstream explanation;
  if (!std::filesystem::exists(golden, absent)) {
    explanation << "but there is no file " << golden;
  } else {
    const Image expected = readPng(golden);
    if (expected.width() != actual.width() || expected.height() != actual.height()) {
      explanation << "which is of " << sizeOf(actual) << " pixels instead of " << sizeOf(expected);
    } else {
      const ImageComparison comparison = compareImages(expected, actual, options.compare);
      explanation << "of which " << 100.0 * comparison.differingShare
                  << " % of the pixels differ, in the worst tile "
                  << 100.0 * comparison.worstTileShare << " %";
      if (comparison.isSame) return {.matches = true, .explanation = explanation.str()};
      makeFolder(folder);
      writePng(comparison.difference, differenceFile);
      explanation << "; see " << differenceFile;
    }
  }
  makeFolder(folder);
  writePng(actual, actualFile);
  explanation << "; the picture is in " << actualFile
              << ". If it is right, run again with BUMPER_UPDATE_GOLDEN=1.";
  return {.matches = false, .explanation = explanation.str()};
}

}  // namespace bumper
