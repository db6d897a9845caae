#include "bumper/render/snapshot.h"

#include <string>

#include "bumper/response/error.h"
#include "camera.h"
#include "overlay.h"
#include "picture.h"
#include "rasteriser.h"
#include "run_excerpt.h"
#include "world_painter.h"

namespace bumper {

namespace {

void requireSize(int value, int low, const char* name) {
  constexpr int most = 8192;
  if (value >= low && value <= most) return;
  throw Error(std::string("SnapshotOptions::") + name + " is " + std::to_string(value) +
              " pixels: it must lie in " + std::to_string(low) + " to " + std::to_string(most));
}

void checkInput(const Scene& scene, const SnapshotOptions& options) {
  validate(scene);
  requireSize(options.width, 160, "width");
  requireSize(options.height, 120, "height");
}

}  // namespace

Image renderSnapshot(const Scene& scene, const Recording& recording,
                     const SnapshotOptions& options) {
  checkInput(scene, options);
  const drawing::RunExcerpt run = drawing::excerptOf(recording, options);
  const drawing::Camera camera = drawing::cameraFor(scene, recording, run, options);

  drawing::Picture picture;
  drawing::WorldPainter painter(camera, picture);
  painter.addScene(scene);
  if (options.showPath) {
    for (std::size_t v = 0; v < run.paths.size(); ++v)
      painter.addPath(recording.vehicles()[v], run.paths[v], drawing::legendEnd(run));
  }
  if (options.showVehicles) painter.addVehicles(recording, run);
  drawing::addOverlay(camera, run, options, options.title.empty() ? scene.name : options.title,
                      picture);
  return drawing::rasterise(picture);
}

std::optional<Eigen::Vector2d> projectToSnapshot(const Scene& scene, const Recording& recording,
                                                 const SnapshotOptions& options,
                                                 const Eigen::Vector3d& point) {
  checkInput(scene, options);
  const drawing::RunExcerpt run = drawing::excerptOf(recording, options);
  return drawing::cameraFor(scene, recording, run, options).pixel(point);
}

}  // namespace bumper
