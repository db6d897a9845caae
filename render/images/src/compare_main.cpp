// Compares two PNG files and says how they differ.
//
//   bumper-compare actual.png golden.png --diff difference.png
//
// Ends with 0 if they count as the same, 1 if they differ, 2 if a file cannot be read or written or
// an argument is wrong.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <string>

#include "bumper/base/output_file.h"
#include "bumper/base/printing.h"
#include "bumper/render/image.h"
#include "bumper/render/image_compare.h"

namespace {

using namespace bumper;

enum Outcome { same = 0, different = 1, unreadable = 2 };

struct Arguments {
  std::string actual;
  std::string golden;
  std::string difference;
  std::size_t mostPixels = usualMostPixels;
  ImageCompareOptions compare;
};

int compare(const Arguments& arguments) {
  const Image actual = readPng(arguments.actual, arguments.mostPixels);
  const Image golden = readPng(arguments.golden, arguments.mostPixels);
  if (actual.width() != golden.width() || actual.height() != golden.height()) {
    std::printf("different: %d x %d pixels instead of %d x %d\n", actual.width(), actual.height(),
                golden.width(), golden.height());
    return different;
  }
  const ImageComparison comparison = compareImages(golden, actual, arguments.compare);
  if (!arguments.difference.empty()) writePng(comparison.difference, arguments.difference);
  std::printf(
      "%s\n"
      "differing pixels  %8.4f %%  of all, allowed %g %%\n"
      "                  %8.4f %%  in the worst tile, allowed %g %%\n"
      "worst difference  %8d    of 255\n"
      "mean difference   %8.4f    of 255\n",
      comparison.isSame ? "same" : "different", 100.0 * comparison.differingShare,
      100.0 * arguments.compare.mostDiffering, 100.0 * comparison.worstTileShare,
      100.0 * arguments.compare.mostDifferingInTile, comparison.worstDifference,
      comparison.meanDifference);
  return comparison.isSame ? same : different;
}

}  // namespace

int main(int argc, char** argv) try {
  removeUnfinishedFilesOnSignals();
  Arguments arguments;
  CLI::App app(
      "Compares two pictures of the same size, edges' smoothing aside.\n"
      "Ends with 0 if they are the same, 1 if they differ, 2 if one cannot be read.");
  app.option_defaults()->always_capture_default();
  app.add_option("actual", arguments.actual, "PNG file")->required();
  app.add_option("golden", arguments.golden, "PNG file that it should be like")->required();
  app.add_option("--diff", arguments.difference,
                 "PNG file to write: what differs in red on the golden picture in grey");
  app.add_option("--tolerance", arguments.compare.tolerance,
                 "channel values by which a pixel may differ, 0 to 255");
  app.add_option("--smoothing", arguments.compare.smoothing,
                 "pixels around each of which the mean is compared, 0 to 8");
  app.add_option("--reach", arguments.compare.reach,
                 "pixels by which an edge may be shifted, 0 to 8");
  app.add_option("--most-differing", arguments.compare.mostDiffering,
                 "share of differing pixels that is allowed, 0 to 1");
  app.add_option("--most-differing-in-tile", arguments.compare.mostDifferingInTile,
                 "the same for any 32 x 32 pixels");
  app.add_option("--most-pixels", arguments.mostPixels,
                 "of a picture that is read, whatever its file says");
  int outcome = same;
  try {
    app.parse(argc, argv);
    outcome = compare(arguments);
  } catch (const CLI::ParseError& error) {
    outcome = app.exit(error) == 0 ? same : unreadable;
  }
  closeStandardOutput();
  return outcome;
} catch (const std::exception& error) {
  std::fprintf(stderr, "bumper-compare: %s\n", printable(error.what()).c_str());
  return unreadable;
}
