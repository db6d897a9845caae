// Makes pictures, films, 3D files and tables of a recording: bumper-replay --help.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "bumper/base/output_file.h"
#include "bumper/base/printing.h"
#include "bumper/render/contact_sheet.h"
#include "bumper/render/csv_export.h"
#include "bumper/render/glb_export.h"
#include "bumper/render/image.h"
#include "bumper/render/impact_close_up.h"
#include "bumper/render/replay.h"
#include "bumper/render/snapshot.h"
#include "bumper/response/error.h"
#include "impact_table.h"
#include "recorded_run.h"
#include "tool.h"
#include "vehicle_mesh_files.h"

namespace {

using namespace bumper;
using namespace bumper::tools;

constexpr const char* manual = R"(Commands begin with the recording and end with what is made:

  bumper-replay info     run.jsonl
  bumper-replay picture  run.jsonl picture.png --view three_quarter
  bumper-replay sheet    run.jsonl sheet.png
  bumper-replay closeups run.jsonl closeups/
  bumper-replay video    run.jsonl replay.mp4 --slow-motion 8
  bumper-replay frames   run.jsonl frames/ --fps 60 --from 1.2 --to 1.8
  bumper-replay glb      run.jsonl replay.glb
  bumper-replay csv      run.jsonl tables/
  bumper-replay video    run.jsonl replay.mp4 --vehicle-mesh car.glb

`bumper-replay COMMAND --help` lists a command's options.

The scene is found by the recording's own words; --scene names another file of any mesh format. A
scene that has changed since is a warning. Mesh files are read by a process of their own, so that
a broken one does no harm.

video runs the program ffmpeg, which BUMPER_FFMPEG names; without it, the one on the path. The file's
ending chooses: .mp4, .webm, .gif or .apng. Nothing half-done is left behind on an error.

)";

struct Arguments {
  RecordedRunOptions run;
  std::filesystem::path result;
  ReplayOptions replay;
  ContactSheetOptions sheet;
  GlbOptions glb;
  VehicleMeshOptions meshes;
  std::string size;
  std::string vehicle;
  std::vector<double> camera;
};

const std::map<std::string, SnapshotView> views{{"top", SnapshotView::top},
                                                {"three_quarter", SnapshotView::three_quarter},
                                                {"chase", SnapshotView::chase},
                                                {"orbit", SnapshotView::orbit},
                                                {"fixed", SnapshotView::fixed}};

VehicleMeshes meshesOf(const Arguments& arguments, const Recording& recording) {
  return loadVehicleMeshes(arguments.meshes, recording, arguments.run.recording.parent_path());
}

/// The options that became strings on the command line.
void complete(Arguments& arguments, const Recording& recording) {
  SnapshotOptions& picture = arguments.replay.picture;
  if (!arguments.size.empty()) {
    std::istringstream text(arguments.size);
    char times = 0;
    if (!(text >> picture.width >> times >> picture.height) || times != 'x' || text.peek() != EOF)
      throw Error("--size: '" + arguments.size + "' is not <width>x<height>");
  }
  if (!arguments.vehicle.empty()) {
    picture.chase.vehicle = picture.orbit.vehicle = vehicleIndex(recording, arguments.vehicle);
    picture.orbit.around = OrbitCamera::Around::vehicle;
  }
  picture.vehicleMeshes = meshesOf(arguments, recording);
  const RecordingSpan& span = arguments.run.span;
  if (std::isfinite(span.from)) arguments.replay.timing.from = span.from;
  if (std::isfinite(span.to)) arguments.replay.timing.to = span.to;
  if (!arguments.camera.empty()) {
    picture.view = SnapshotView::fixed;
    picture.fixed.eye << arguments.camera[0], arguments.camera[1], arguments.camera[2];
    picture.fixed.target << arguments.camera[3], arguments.camera[4], arguments.camera[5];
  }
}

void addPictureOptions(CLI::App& command, Arguments& arguments) {
  SnapshotOptions& picture = arguments.replay.picture;
  command.add_option("--view", picture.view, "top, three_quarter, chase, orbit or fixed")
      ->transform(CLI::CheckedTransformer(views))
      ->type_name("VIEW");
  command.add_option("--vehicle", arguments.vehicle,
                     "name of the vehicle that chase and orbit follow");
  command
      .add_option("--camera", arguments.camera,
                  "where a fixed camera stands and what it looks at, m: x,y,z,x,y,z")
      ->delimiter(',')
      ->check(numberIn(-1e9, 1e9))
      ->expected(6)
      ->type_name("M");
  command.add_option("--size", arguments.size, "pixels (default 1280x720, films 960x540)")
      ->type_name("WxH");
  command.add_option("--title", picture.title, "(default: the scene's name)");
}

constexpr double infinity = std::numeric_limits<double>::infinity();

void addTimingOptions(CLI::App& command, Arguments& arguments) {
  ReplayTiming& timing = arguments.replay.timing;
  command.add_option("--fps", timing.framesPerSecond, "frames per second")
      ->check(numberIn(1.0, 240.0))
      ->capture_default_str();
  command.add_option("--speed", timing.speed, "seconds of the run in one of the replay")
      ->check(numberIn(0.001, 1000.0))
      ->capture_default_str();
  command
      .add_option("--slow-motion", timing.slowMotion,
                  "how many times slower around impacts; 1: not at all")
      ->check(numberIn(1.0, 100.0))
      ->capture_default_str();
  command.add_option("--slow-reach", timing.slowReach, "s before and after an impact")
      ->check(numberIn(0.0, 100.0))
      ->capture_default_str();
  command.add_option("--most-frames", timing.mostFrames, "more are an error")
      ->capture_default_str();
  command.add_option("--renderers", arguments.replay.renderers, "frames in work at the same time")
      ->capture_default_str();
}

void printInfo(const Arguments& arguments) {
  RunDescription run;
  const Recording recording = readRecordedPart(arguments.run, run);
  const std::string scene = !run.scene.builtIn.empty() ? run.scene.builtIn : run.scene.file;
  std::printf("scene: %s%s%s\n", printable(run.scene.name).c_str(), scene.empty() ? "" : ", ",
              printable(scene).c_str());
  for (const auto& [name, value] : run.parameters) {
    if (const auto* number = std::get_if<double>(&value))
      std::printf("%s: %g\n", printable(name).c_str(), *number);
    else
      std::printf("%s: %s\n", printable(name).c_str(),
                  printable(std::get<std::string>(value)).c_str());
  }
  for (const RecordedVehicle& vehicle : recording.vehicles()) {
    std::printf("vehicle %s: %zu poses", printable(vehicle.name).c_str(), vehicle.poses.size());
    if (!vehicle.poses.empty()) {
      std::printf(" from %.3f to %.3f s", vehicle.poses.front().time, vehicle.poses.back().time);
    }
    std::printf(", %.2f x %.2f m, %.0f kg\n",
                vehicle.parameters.massCentreToFront + vehicle.parameters.massCentreToRear,
                vehicle.parameters.width, vehicle.parameters.mass);
  }
  printImpacts(recording);
}

void makePicture(Arguments& arguments) {
  const RecordedRun run = readRecordedRun(arguments.run);
  complete(arguments, run.recording);
  writePng(renderSnapshot(run.scene, run.recording, arguments.replay.picture), arguments.result);
}

void makeSheet(Arguments& arguments) {
  const RecordedRun run = readRecordedRun(arguments.run);
  arguments.sheet.vehicleMeshes = meshesOf(arguments, run.recording);
  writePng(contactSheet(run.scene, run.recording, arguments.sheet), arguments.result);
}

void makeCloseUps(Arguments& arguments) {
  const RecordedRun run = readRecordedRun(arguments.run);
  makeFolder(arguments.result);
  std::vector<std::pair<double, std::size_t>> hardest;
  for (std::size_t k = 0; k < run.recording.impacts().size(); ++k)
    hardest.emplace_back(-hardness(run.recording.impacts()[k].event()), k);
  std::sort(hardest.begin(), hardest.end());
  if (hardest.size() > arguments.sheet.impacts) hardest.resize(arguments.sheet.impacts);
  for (const auto& [unused, k] : hardest) {
    const std::filesystem::path png =
        arguments.result / ("impact_" + std::to_string(k + 1) + ".png");
    writePng(impactCloseUp(run.scene, run.recording, k), png);
  }
}

void makeVideo(Arguments& arguments) {
  const RecordedRun run = readRecordedRun(arguments.run);
  complete(arguments, run.recording);
  writeReplayVideo(run.scene, run.recording, arguments.result, arguments.replay,
                   ProgressLine("frame"));
}

void makeFrames(Arguments& arguments) {
  const RecordedRun run = readRecordedRun(arguments.run);
  complete(arguments, run.recording);
  writeReplayFrames(run.scene, run.recording, arguments.result, arguments.replay,
                    ProgressLine("frame"));
}

void makeGlb(Arguments& arguments) {
  const RecordedRun run = readRecordedRun(arguments.run);
  arguments.glb.vehicleMeshes = meshesOf(arguments, run.recording);
  writeGlb(run.scene, run.recording, arguments.result, arguments.glb);
}

void makeCsv(Arguments& arguments) {
  RunDescription run;
  const Recording recording = readRecordedPart(arguments.run, run);
  writeCsv(recording, arguments.result,
           arguments.vehicle.empty() ? 0 : vehicleIndex(recording, arguments.vehicle));
}

int replay(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Makes pictures, films, 3D files and tables of a recorded run.", "bumper-replay");
  app.require_subcommand(1);
  app.footer(manual + exitCodes());
  std::function<void()> job;

  const auto command = [&](const char* name, const char* what, const char* result,
                           const std::function<void(Arguments&)>& work) {
    CLI::App* added = app.add_subcommand(name, what);
    addRecordedRunOptions(*added, arguments.run);
    if (result != nullptr) added->add_option("result", arguments.result, result)->required();
    added->callback([&job, &arguments, work] { job = [&arguments, work] { work(arguments); }; });
    return added;
  };

  command("info", "what is in a recording, and its impacts", nullptr, printInfo);
  CLI::App* picture = command("picture", "one picture of the whole run", "PNG file", makePicture);
  addPictureOptions(*picture, arguments);
  CLI::App* sheet =
      command("sheet", "one picture with the moments around each impact", "PNG file", makeSheet);
  CLI::App* closeUps =
      command("closeups", "a diagram of each impact, impact_<number>.png", "folder", makeCloseUps);
  for (CLI::App* each : {sheet, closeUps}) {
    each->add_option("--impacts", arguments.sheet.impacts, "at most so many, the hardest")
        ->capture_default_str();
  }
  sheet->add_option("--instants", arguments.sheet.instants, "s from the impact, one picture each")
      ->delimiter(',')
      ->check(numberIn(-1e6, 1e6))
      ->capture_default_str();
  sheet->add_option("--title", arguments.sheet.title, "(default: the scene's name)");
  CLI::App* video =
      command("video", "a film, by the program ffmpeg", ".mp4, .webm, .gif or .apng", makeVideo);
  CLI::App* frames = command("frames", "a film as single PNG files", "folder", makeFrames);
  for (CLI::App* film : {video, frames}) {
    addPictureOptions(*film, arguments);
    addTimingOptions(*film, arguments);
  }
  CLI::App* glb = command("glb", "an animated 3D file for any glTF viewer", ".glb", makeGlb);
  glb->add_option("--reach", arguments.glb.sceneReach,
                  "m around the run: what of the scene lies beyond is left out")
      ->check(numberIn(0.0, infinity))
      ->capture_default_str();
  glb->add_option("--keys-per-second", arguments.glb.keysPerSecond, "(default: every pose)")
      ->check(numberIn(1e-9, infinity));
  addPatience(*video, arguments.replay.patience);
  for (CLI::App* each : {picture, sheet, video, frames, glb})
    addVehicleMeshOptions(*each, arguments.meshes);
  CLI::App* csv = command("csv", "events.csv and trajectory.csv", "folder", makeCsv);
  csv->add_option("--vehicle", arguments.vehicle, "whose trajectory (default: the first)");

  // A film's frames are small and follow the vehicle; a picture is neither.
  picture->preparse_callback([&](std::size_t) { arguments.replay.picture = SnapshotOptions(); });
  return runTool(app, argc, argv, [&] { job(); });
}

}  // namespace

int main(int argc, char** argv) { return runMain("bumper-replay", replay, argc, argv); }
