#include "bumper/render/video.h"

#include <chrono>
#include <cstddef>
#include <cstdlib>
#include <locale>
#include <optional>
#include <span>
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

class BUMPER_HIDDEN VideoWriter::Implementation {
 public:
  Implementation(const std::filesystem::path& file, int width, int height, double framesPerSecond,
                 double patience)
      : file_(file), width_(width), height_(height) {
    const Kind kind = kindOf(file);
    if (!(framesPerSecond >= 1.0 && framesPerSecond <= kind.fastest)) {
      throw Error("cannot write " + file.string() + " with " + textOf(framesPerSecond) +
                  " frames per second: they must lie in 1 to " + textOf(kind.fastest));
    }
    constexpr double week = 7 * 86400.0;
    if (!(patience > 0.0 && patience <= week)) {
      throw Error("cannot write " + file.string() + " with a patience of " + textOf(patience) +
                  " s: it must lie above 0 and up to " + textOf(week));
    }
    patience_ =
        std::chrono::ceil<std::chrono::milliseconds>(std::chrono::duration<double>(patience));
    output_.emplace(file);
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
    arguments.insert(arguments.end(), {"-f", kind.format, filmName()});
    start(ffmpeg_, arguments, {.input = true, .errors = true});
  }

  void add(const Image& picture) {
    if (picture.width() != width_ || picture.height() != height_) {
      throw Error("cannot write " + file_.string() + ": a picture is " +
                  std::to_string(picture.width()) + " x " + std::to_string(picture.height()) +
                  " pixels, the film " + std::to_string(width_) + " x " + std::to_string(height_));
    }
    if (!ffmpeg_->write(std::as_bytes(std::span(picture.pixels())), patience_)) {
      // One that has closed its input ends by itself and says why; a deaf one does not.
      ffmpeg_->hasStalled() ? ffmpeg_->kill() : ffmpeg_->wait(patience_);
      fail(*ffmpeg_, "failed");
    }
    ++frames_;
  }

  void finish() {
    if (!hasSucceeded(ffmpeg_->wait(patience_))) fail(*ffmpeg_, "failed");
    if (frames_ == 0) throw Error("cannot write " + file_.string() + ": no picture was added");
    checkFrames();
    output_->moveToPlace();
  }

 private:
  using Patience = ChildProcess::Patience;

  [[nodiscard]] std::string filmName() const { return "file:" + output_->path().string(); }

  void start(std::optional<ChildProcess>& child, const std::vector<std::string>& arguments,
             ChildStreams streams) const {
    const char* given = std::getenv(programVariable);
    const std::string program = given != nullptr && *given != '\0' ? given : "ffmpeg";
    try {
      child.emplace(program, arguments, streams);
    } catch (const std::system_error& error) {
      throw Error("cannot write " + file_.string() + ": the program " + program +
                  " cannot be started: " + error.code().message() + "; install ffmpeg or set " +
                  programVariable + " to where it is");
    }
  }

  /// ffmpeg may say nothing of what it could not write. Its list of the film's packets, each a
  /// frame, has a line for each besides comments; nothing is decoded for it.
  void checkFrames() const {
    std::optional<ChildProcess> reader;
    start(reader,
          {"-loglevel", "error", "-i", filmName(), "-map", "0:v", "-c", "copy", "-f", "framecrc",
           "pipe:1"},
          {.output = true, .errors = true});
    std::size_t found = 0;
    char before = '\n';
    for (std::string text; reader->read(text, patience_);) {
      for (const char c : text) {
        if (before == '\n' && c != '#' && c != '\n') ++found;
        before = c;
      }
    }
    const bool isRead =
        hasSucceeded(reader->hasStalled() ? reader->kill() : reader->wait(patience_));
    if (!isRead) fail(*reader, "cannot read what it wrote");
    if (found != frames_) {
      fail(*ffmpeg_,
           "left " + std::to_string(found) + " of " + std::to_string(frames_) + " frames in it");
    }
  }

  [[noreturn]] void fail(const ChildProcess& child, const std::string& what) const {
    const std::string words = child.lastErrorLine();
    throw Error("cannot write " + file_.string() + ": ffmpeg " +
                (child.hasStalled()
                     ? "did nothing for " +
                           textOf(std::chrono::duration<double>(*patience_).count()) +
                           " s and was stopped"
                     : what) +
                (words.empty() ? "" : ", saying \"" + words + "\""));
  }

  std::filesystem::path file_;
  int width_;
  int height_;
  Patience patience_;
  std::optional<OutputFile> output_;
  std::optional<ChildProcess> ffmpeg_;  // ends before what it writes is removed
  std::size_t frames_ = 0;
};

VideoWriter::VideoWriter(const std::filesystem::path& file, int width, int height,
                         double framesPerSecond, double patience)
    : implementation_(
          std::make_unique<Implementation>(file, width, height, framesPerSecond, patience)) {}

VideoWriter::~VideoWriter() = default;

void VideoWriter::add(const Image& picture) { implementation_->add(picture); }

void VideoWriter::finish() { implementation_->finish(); }

}  // namespace bumper
