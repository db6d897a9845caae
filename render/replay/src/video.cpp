#include "bumper/render/video.h"

#include <cstdlib>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

#include "bumper/base/child_process.h"
#include "bumper/base/output_file.h"
#include "bumper/response/error.h"

namespace bumper {

namespace {

constexpr const char* programVariable = "BUMPER_FFMPEG";

struct Kind {
  const char* ending;
  const char* format;
  double fastest;  ///< frames per second
  std::vector<std::string> arguments;
};

// Colours as players take them where nothing is said; half as many of them as pixels each way.
const std::string evenAndBroadcast =
    "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv,format=yuv420p";

// The fastest preset, and of what it leaves out that which makes films of still backgrounds small:
// less time than "veryfast" takes, and no larger files.
const std::string fastAndSmall =
    "mbtree=1:rc-lookahead=10:bframes=3:cabac=1:deblock=1,0,0:scenecut=40";

std::vector<Kind> kinds() {
  return {{".mp4",
           "mp4",
           240.0,
           {"-vf", evenAndBroadcast, "-colorspace", "bt709", "-c:v", "libx264", "-preset",
            "ultrafast", "-x264-params", fastAndSmall, "-crf", "20", "-movflags", "+faststart"}},
          {".webm",
           "webm",
           240.0,
           {"-vf", evenAndBroadcast, "-colorspace", "bt709", "-c:v", "libvpx-vp9", "-deadline",
            "realtime", "-cpu-used", "7", "-row-mt", "1", "-crf", "30", "-b:v", "0"}},
          // A palette for each frame: one for all would need all of them in memory.
          {".gif",
           "gif",
           50.0,
           {"-filter_complex",
            "split[a][b];[a]palettegen=stats_mode=single[p];[b][p]paletteuse=new=1", "-loop", "0"}},
          {".apng", "apng", 240.0, {"-plays", "0"}}};
}

Kind kindOf(const std::filesystem::path& file) {
  for (Kind& kind : kinds()) {
    if (file.extension() == kind.ending) return kind;
  }
  throw Error("cannot write " + file.string() +
              ": allowed endings are .mp4, .webm, .gif and .apng");
}

std::string textOf(double number) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(9);
  text << number;
  return text.str();
}

}  // namespace

class VideoWriter::Implementation {
 public:
  Implementation(const std::filesystem::path& file, int width, int height, double framesPerSecond)
      : file_(file), output_(file), width_(width), height_(height) {
    const Kind kind = kindOf(file);
    if (!(framesPerSecond >= 1.0 && framesPerSecond <= kind.fastest)) {
      throw Error("cannot write " + file.string() + " with " + textOf(framesPerSecond) +
                  " frames per second: they must lie in 1 to " + textOf(kind.fastest));
    }
    // Tried here, so that a folder that is missing is not ffmpeg's to explain.
    output_.write({});
    std::vector<std::string> arguments{"-loglevel",
                                       "error",
                                       "-y",
                                       "-f",
                                       "rawvideo",
                                       "-pixel_format",
                                       "rgb24",
                                       "-video_size",
                                       std::to_string(width) + "x" + std::to_string(height),
                                       "-framerate",
                                       textOf(framesPerSecond),
                                       "-i",
                                       "pipe:0"};
    arguments.insert(arguments.end(), kind.arguments.begin(), kind.arguments.end());
    arguments.insert(arguments.end(), {"-f", kind.format, "file:" + output_.beside().string()});
    const char* given = std::getenv(programVariable);
    const std::string program = given != nullptr && *given != '\0' ? given : "ffmpeg";
    try {
      ffmpeg_.emplace(program, arguments, ChildStreams{.input = true, .errors = true});
    } catch (const std::system_error& error) {
      throw Error("cannot write " + file.string() + ": the program " + program +
                  " cannot be started: " + error.code().message() + "; install ffmpeg or set " +
                  programVariable + " to where it is");
    }
  }

  void add(const Image& picture) {
    if (picture.width() != width_ || picture.height() != height_) {
      throw Error("cannot write " + file_.string() + ": a picture is " +
                  std::to_string(picture.width()) + " x " + std::to_string(picture.height()) +
                  " pixels, the film " + std::to_string(width_) + " x " + std::to_string(height_));
    }
    if (!ffmpeg_->write(std::as_bytes(std::span(picture.pixels())))) {
      ffmpeg_->wait();
      fail();
    }
  }

  void finish() {
    if (!hasSucceeded(ffmpeg_->wait())) fail();
    output_.moveToPlace();
  }

 private:
  [[noreturn]] void fail() const {
    const std::string words = ffmpeg_->lastErrorLine();
    throw Error("cannot write " + file_.string() + ": ffmpeg failed" +
                (words.empty() ? "" : ", saying \"" + words + "\""));
  }

  std::filesystem::path file_;
  OutputFile output_;
  int width_;
  int height_;
  std::optional<ChildProcess> ffmpeg_;  // ends before what it writes is removed
};

VideoWriter::VideoWriter(const std::filesystem::path& file, int width, int height,
                         double framesPerSecond)
    : implementation_(std::make_unique<Implementation>(file, width, height, framesPerSecond)) {}

VideoWriter::~VideoWriter() = default;

void VideoWriter::add(const Image& picture) { implementation_->add(picture); }

void VideoWriter::finish() { implementation_->finish(); }

}  // namespace bumper
