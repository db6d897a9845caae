#pragma once

#include "bumper/render/image.h"

namespace bumper {

struct ImageCompareOptions {
  /// Channel values, 0 to 255, by which a pixel may leave the range of its neighbourhood.
  int tolerance = 12;
  /// Pixels, 0 to 8, by which an edge may be shifted or smoothed otherwise.
  int reach = 1;
};

/// How two pictures of the same size differ. Two pixels differ if a channel of the one lies outside
/// the range that the other picture takes within `reach` pixels of it, by more than `tolerance`, or
/// the other way round: an edge drawn a pixel further or with other smoothing is no difference, a
/// line, a letter or a mark that is missing is one.
struct ImageComparison {
  double differingShare = 0.0;  ///< of all pixels, 0 to 1
  /// The largest share of differing pixels in any tile of 32 × 32 pixels: what is small in the
  /// picture shows here.
  double worstTileShare = 0.0;
  int worstDifference = 0;  ///< of one channel at the same pixel, 0 to 255, without any allowance
  double meanDifference = 0.0;  ///< of all channels at the same pixel, 0 to 255, likewise
  Image difference;             ///< differing pixels red on a pale grey of the first picture
};

/// Throws Error if the sizes differ or an option lies outside its range.
ImageComparison compareImages(const Image& first, const Image& second,
                              const ImageCompareOptions& options = {});

}  // namespace bumper
