// Makes pictures, films, 3D files and tables of a recording: bumper-replay --help.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

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
using namespace bumper::examples;

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

struct Order {
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

VehicleMeshes meshesOf(const Order& order, const Recording& recording) {
  return loadVehicleMeshes(order.meshes, recording, order.run.recording.parent_path());
}

/// The options that became strings on the command line.
void complete(Order& order, const Recording& recording) {
  SnapshotOptions& picture = order.replay.picture;
  if (!order.size.empty()) {
    std::istringstream text(order.size);
    char times = 0;
    if (!(text >> picture.width >> times >> picture.height) || times != 'x' || text.peek() != EOF)
      throw Error("--size: '" + order.size + "' is not <width>x<height>");
  }
  if (!order.vehicle.empty()) {
    picture.chase.vehicle = picture.orbit.vehicle = vehicleIndex(recording, order.vehicle);
    picture.orbit.around = OrbitCamera::Around::vehicle;
  }
  picture.vehicleMeshes = meshesOf(order, recording);
  const RecordingSpan& span = order.run.span;
  if (std::isfinite(span.from)) order.replay.timing.from = span.from;
  if (std::isfinite(span.to)) order.replay.timing.to = span.to;
  if (!order.camera.empty()) {
    picture.view = SnapshotView::fixed;
    picture.fixed.eye << order.camera[0], order.camera[1], order.camera[2];
    picture.fixed.target << order.camera[3], order.camera[4], order.camera[5];
  }
}

void addPictureOptions(CLI::App& command, Order& order) {
  SnapshotOptions& picture = order.replay.picture;
  command.add_option("--view", picture.view, "top, three_quarter, chase, orbit or fixed")
      ->transform(CLI::CheckedTransformer(views))
      ->type_name("VIEW");
  command.add_option("--vehicle", order.vehicle, "name of the vehicle that chase and orbit follow");
  command
      .add_option("--camera", order.camera,
                  "where a fixed camera stands and what it looks at, m: x,y,z,x,y,z")
      ->delimiter(',')
      ->expected(6)
      ->type_name("M");
  command.add_option("--size", order.size, "pixels (default 1280x720, films 960x540)")
      ->type_name("WxH");
  command.add_option("--title", picture.title, "(default: the scene's name)");
}

void addTimingOptions(CLI::App& command, Order& order) {
  ReplayTiming& timing = order.replay.timing;
  command.add_option("--fps", timing.framesPerSecond, "frames per second")->capture_default_str();
  command.add_option("--speed", timing.speed, "seconds of the run in one of the replay")
      ->capture_default_str();
  command
      .add_option("--slow-motion", timing.slowMotion,
                  "how many times slower around impacts; 1: not at all")
      ->capture_default_str();
  command.add_option("--slow-reach", timing.slowReach, "s before and after an impact")
      ->capture_default_str();
  command.add_option("--renderers", order.replay.renderers, "frames in work at the same time")
      ->capture_default_str();
}

void printInfo(const Order& order) {
  RunDescription run;
  const Recording recording = readRecordedPart(order.run, run);
  const std::string scene = !run.scene.builtIn.empty() ? run.scene.builtIn : run.scene.file;
  std::printf("scene: %s%s%s\n", run.scene.name.c_str(), scene.empty() ? "" : ", ", scene.c_str());
  for (const auto& [name, value] : run.parameters) {
    if (const auto* number = std::get_if<double>(&value))
      std::printf("%s: %g\n", name.c_str(), *number);
    else
      std::printf("%s: %s\n", name.c_str(), std::get<std::string>(value).c_str());
  }
  for (const RecordedVehicle& vehicle : recording.vehicles()) {
    std::printf("vehicle %s: %zu poses", vehicle.name.c_str(), vehicle.poses.size());
    if (!vehicle.poses.empty()) {
      std::printf(" from %.3f to %.3f s", vehicle.poses.front().time, vehicle.poses.back().time);
    }
    std::printf(", %.2f x %.2f m, %.0f kg\n",
                vehicle.parameters.massCentreToFront + vehicle.parameters.massCentreToRear,
                vehicle.parameters.width, vehicle.parameters.mass);
  }
  printImpacts(recording);
}

void makePicture(Order& order) {
  const RecordedRun run = readRecordedRun(order.run);
  complete(order, run.recording);
  writePng(renderSnapshot(run.scene, run.recording, order.replay.picture), order.result);
}

void makeSheet(Order& order) {
  const RecordedRun run = readRecordedRun(order.run);
  order.sheet.vehicleMeshes = meshesOf(order, run.recording);
  writePng(contactSheet(run.scene, run.recording, order.sheet), order.result);
}

void makeCloseUps(Order& order) {
  const RecordedRun run = readRecordedRun(order.run);
  makeFolder(order.result);
  std::vector<std::pair<double, std::size_t>> hardest;
  for (std::size_t k = 0; k < run.recording.impacts().size(); ++k)
    hardest.emplace_back(-run.recording.impacts()[k].event().deltaV, k);
  std::sort(hardest.begin(), hardest.end());
  if (hardest.size() > order.sheet.impacts) hardest.resize(order.sheet.impacts);
  for (const auto& [unused, k] : hardest) {
    const std::filesystem::path png = order.result / ("impact_" + std::to_string(k + 1) + ".png");
    writePng(impactCloseUp(run.scene, run.recording, k), png);
  }
}

void makeVideo(Order& order) {
  const RecordedRun run = readRecordedRun(order.run);
  complete(order, run.recording);
  writeReplayVideo(run.scene, run.recording, order.result, order.replay, ProgressLine("frame"));
}

void makeFrames(Order& order) {
  const RecordedRun run = readRecordedRun(order.run);
  complete(order, run.recording);
  writeReplayFrames(run.scene, run.recording, order.result, order.replay, ProgressLine("frame"));
}

void makeGlb(Order& order) {
  const RecordedRun run = readRecordedRun(order.run);
  order.glb.vehicleMeshes = meshesOf(order, run.recording);
  writeGlb(run.scene, run.recording, order.result, order.glb);
}

void makeCsv(Order& order) {
  RunDescription run;
  const Recording recording = readRecordedPart(order.run, run);
  writeCsv(recording, order.result,
           order.vehicle.empty() ? 0 : vehicleIndex(recording, order.vehicle));
}

int replay(int argc, char** argv) {
  Order order;
  CLI::App app("Makes pictures, films, 3D files and tables of a recorded run.", "bumper-replay");
  app.require_subcommand(1);
  app.footer(manual + exitCodes());
  std::function<void()> job;

  const auto command = [&](const char* name, const char* what, const char* result,
                           const std::function<void(Order&)>& work) {
    CLI::App* added = app.add_subcommand(name, what);
    addRecordedRunOptions(*added, order.run);
    if (result != nullptr) added->add_option("result", order.result, result)->required();
    added->callback([&job, &order, work] { job = [&order, work] { work(order); }; });
    return added;
  };

  command("info", "what is in a recording, and its impacts", nullptr, printInfo);
  CLI::App* picture = command("picture", "one picture of the whole run", "PNG file", makePicture);
  addPictureOptions(*picture, order);
  CLI::App* sheet =
      command("sheet", "one picture with the moments around each impact", "PNG file", makeSheet);
  CLI::App* closeUps =
      command("closeups", "a diagram of each impact, impact_<number>.png", "folder", makeCloseUps);
  for (CLI::App* each : {sheet, closeUps}) {
    each->add_option("--impacts", order.sheet.impacts, "at most so many, the hardest")
        ->capture_default_str();
  }
  sheet->add_option("--instants", order.sheet.instants, "s from the impact, one picture each")
      ->delimiter(',')
      ->capture_default_str();
  sheet->add_option("--title", order.sheet.title, "(default: the scene's name)");
  CLI::App* video =
      command("video", "a film, by the program ffmpeg", ".mp4, .webm, .gif or .apng", makeVideo);
  CLI::App* frames = command("frames", "a film as single PNG files", "folder", makeFrames);
  for (CLI::App* film : {video, frames}) {
    addPictureOptions(*film, order);
    addTimingOptions(*film, order);
  }
  CLI::App* glb = command("glb", "an animated 3D file for any glTF viewer", ".glb", makeGlb);
  glb->add_option("--reach", order.glb.sceneReach,
                  "m around the run: what of the scene lies beyond is left out")
      ->capture_default_str();
  glb->add_option("--keys-per-second", order.glb.keysPerSecond, "(default: every pose)");
  for (CLI::App* each : {picture, sheet, video, frames, glb})
    addVehicleMeshOptions(*each, order.meshes);
  CLI::App* csv = command("csv", "events.csv and trajectory.csv", "folder", makeCsv);
  csv->add_option("--vehicle", order.vehicle, "whose trajectory (default: the first)");

  // A film's frames are small and follow the vehicle; a picture is neither.
  picture->preparse_callback([&](std::size_t) { order.replay.picture = SnapshotOptions(); });
  return runTool(app, argc, argv, [&] { job(); });
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return replay(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bumper-replay: %s\n", error.what());
    return 1;
  }
}
