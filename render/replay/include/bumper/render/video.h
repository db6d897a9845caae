#pragma once

#include <filesystem>
#include <memory>

#include "bumper/base/api.h"
#include "bumper/render/image.h"

namespace BUMPER_API bumper {

/// Encodes pictures as a film through the program ffmpeg, which the environment variable
/// BUMPER_FFMPEG names; without it, the one that PATH finds. It runs as a child process, to which
/// the pictures are piped as they are added; no shell takes part.
///
/// The file's ending chooses the kind: .mp4 (H.264), .webm (VP9), .gif or .apng (both in a loop).
/// In mp4 and webm an odd width or height is padded to an even one. The film is written beside its
/// place and moved there by finish(), once ffmpeg has found as many frames in it as were added;
/// without finish() nothing remains.
class VideoWriter {
 public:
  /// framesPerSecond: 1 to 240, in a GIF up to 50. patience, s, up to a week: how long ffmpeg may
  /// take for one step, which is some of a picture, or all that comes after the last. Throws Error,
  /// naming the file, if its ending, the rate or the patience is not allowed, if it cannot be
  /// written or if there is no ffmpeg.
  VideoWriter(const std::filesystem::path& file, int width, int height, double framesPerSecond,
              double patience = 120.0);
  VideoWriter(const VideoWriter&) = delete;
  VideoWriter& operator=(const VideoWriter&) = delete;
  VideoWriter(VideoWriter&&) = delete;
  VideoWriter& operator=(VideoWriter&&) = delete;
  ~VideoWriter();

  /// Waits while ffmpeg is busy. Throws Error, naming the file, if the picture is of another size
  /// than the film, or with ffmpeg's last words if it has failed or tried the patience.
  void add(const Image& picture);

  /// Waits until the film stands in its place. Throws Error as add() does, if no picture was added,
  /// or if the film does not have them all.
  void finish();

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace bumper
