#pragma once

#include "bumper/base/api.h"
#include "bumper/render/image.h"

namespace BUMPER_API bumper {

/// When two pictures count as the same. The defaults detect an edge that moved by a pixel, a car
/// that turned by as much at its ends, or a missing mark, but not another processor's
/// anti-aliasing.
struct ImageCompareOptions {
  /// Channel values, 0 to 255, by which a pixel may differ.
  int tolerance = 12;
  /// Pixels, 0 to 8: radius of the box filter that both pictures pass first, which removes noise
  /// along edges and keeps their place.
  int smoothing = 1;
  /// Pixels, 0 to 8, by which an edge may be shifted: a pixel may have any value that the other
  /// picture takes so near to it. For pictures of two drivers that place edges differently.
  int reach = 0;
  double mostDiffering = 0.001;       ///< share of differing pixels, 0 to 1
  double mostDifferingInTile = 0.02;  ///< the same in any tile of 32 × 32 pixels
};

/// How two pictures of the same size differ. Two pixels differ if a channel of the one, smoothed,
/// lies outside the range that the other picture, smoothed, takes within `reach` pixels of it, by
/// more than `tolerance`, or the other way round.
struct ImageComparison {
  bool isSame = false;          ///< both shares are within the options' limits
  double differingShare = 0.0;  ///< of all pixels, 0 to 1
  /// The largest share of differing pixels in any tile of 32 × 32 pixels: what is small in the
  /// picture shows here.
  double worstTileShare = 0.0;
  int worstDifference = 0;  ///< of one channel at the same pixel, 0 to 255, without any allowance
  double meanDifference = 0.0;  ///< of all channels at the same pixel, 0 to 255, likewise
  Image difference;             ///< differing pixels red on a pale grey of the first picture
};

/// Throws Error if the sizes differ, there are no pixels or an option lies outside its range.
ImageComparison compareImages(const Image& first, const Image& second,
                              const ImageCompareOptions& options = {});

}  // namespace bumper
