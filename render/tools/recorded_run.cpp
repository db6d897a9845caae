#include "recorded_run.h"

#include <cstdio>
#include <optional>

#include "bumper/base/printing.h"
#include "bumper/response/error.h"
#include "bumper/scenes/paper_scenes.h"
#include "scene_loading.h"
#include "tool.h"

namespace bumper::tools {

namespace {

LoadOptions loadOptions(const RecordedRunOptions& options, const SceneReference& reference) {
  return {.up = upAxis(options.up.empty() ? reference.up : options.up),
          .scale = options.scale > 0.0 ? options.scale : reference.scale};
}

Scene sceneOf(const RecordedRunOptions& options, const SceneReference& reference) {
  if (!options.scene.empty())
    return loadScene(options.scene, "--up", loadOptions(options, reference));
  if (reference.builtIn == "test_rail") return testRail();
  if (reference.builtIn == "course") return course();
  const std::string recording = options.recording.string();
  if (reference.file.empty())
    throw Error(recording + " does not say which scene it took place in: name it with --scene");
  const std::filesystem::path file = options.recording.parent_path() / reference.file;
  if (!std::filesystem::exists(file)) {
    throw Error(recording + " took place in " + file.string() +
                ", which is not there: say where it is with --scene");
  }
  return loadScene(file, "--up", loadOptions(options, reference));
}

}  // namespace

void addRecordedRunOptions(CLI::App& command, RecordedRunOptions& options) {
  command.add_option("recording", options.recording, "recording file (.jsonl)")->required();
  command.add_option("--scene", options.scene,
                     "mesh file of the scene, instead of the one that the recording names");
  command.add_option("--up", options.up, "that file's up axis")
      ->check(CLI::IsMember({"x", "y", "z"}));
  command.add_option("--scale", options.scale, "that file's metres per unit")
      ->check(numberIn(1e-9, 1e9));
  const CLI::Validator times = numberIn(-options.limits.latest, options.limits.latest);
  command.add_option("--from", options.span.from, "s: begin there")->check(times);
  command.add_option("--to", options.span.to, "s: end there")->check(times);
  command
      .add_option("--most-seconds", options.limits.seconds,
                  "that a recording may reach over, s; a longer one is refused")
      ->check(numberIn(0.0, options.limits.latest))
      ->capture_default_str();
}

Recording readRecordedPart(const RecordedRunOptions& options, RunDescription& description) {
  RecordingReader reader(options.recording, options.limits);
  description = reader.run();
  if (!reader.isComplete()) {
    std::fprintf(stderr, "%s was not completed or is cut off: what there is of it is taken\n",
                 printable(options.recording.string()).c_str());
  }
  return reader.read(options.span);
}

std::size_t vehicleIndex(const Recording& recording, const std::string& name) {
  std::string known;
  for (std::size_t v = 0; v < recording.vehicles().size(); ++v) {
    if (recording.vehicles()[v].name == name) return v;
    known += (known.empty() ? "'" : ", '") + recording.vehicles()[v].name + "'";
  }
  throw Error("--vehicle: there is no '" + name + "' in the recording, only " + known);
}

RecordedRun readRecordedRun(const RecordedRunOptions& options) {
  RecordedRun run;
  run.recording = readRecordedPart(options, run.description);
  run.scene = sceneOf(options, run.description.scene);
  if (!run.description.scene.name.empty()) run.scene.name = run.description.scene.name;
  if (!isSameScene(run.description.scene, run.scene)) {
    std::fprintf(stderr,
                 "warning: the scene is not the one that %s was made in: the file has changed, or "
                 "--scene, --up or --scale name another\n",
                 printable(options.recording.string()).c_str());
  }
  return run;
}

}  // namespace bumper::tools
