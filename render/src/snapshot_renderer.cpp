#include "bumper/render/snapshot_renderer.h"

#include <utility>

#include "camera.h"
#include "offscreen_context.h"
#include "overlay.h"
#include "picture.h"
#include "rasteriser.h"
#include "run_excerpt.h"
#include "sight_lines.h"
#include "snapshot_input.h"
#include "world_painter.h"

namespace bumper {

class SnapshotRenderer::Parts {
 public:
  Parts(const Scene& drawn, OffscreenBackend backend)
      : scene(drawn), sight(drawn), context(drawing::makeOffscreenContext(backend)) {}

  Scene scene;
  drawing::SightLines sight;
  std::unique_ptr<drawing::OffscreenContext> context;
};

SnapshotRenderer::SnapshotRenderer(const Scene& scene, OffscreenBackend backend) {
  validate(scene);
  parts_ = std::make_unique<Parts>(scene, backend);
}

SnapshotRenderer::SnapshotRenderer(SnapshotRenderer&&) noexcept = default;
SnapshotRenderer& SnapshotRenderer::operator=(SnapshotRenderer&&) noexcept = default;
SnapshotRenderer::~SnapshotRenderer() = default;

OffscreenBackend SnapshotRenderer::backend() const { return parts_->context->backend(); }

Image SnapshotRenderer::draw(const Recording& recording, const SnapshotOptions& options) {
  drawing::checkOptions(recording, options);
  const drawing::RunExcerpt run = drawing::excerptOf(recording, options);
  const drawing::Camera camera = drawing::cameraFor(parts_->sight, recording, run, options);

  drawing::Picture picture;
  drawing::WorldPainter painter(camera, picture);
  painter.addScene(parts_->scene);
  if (options.showPath) {
    for (std::size_t v = 0; v < run.trails.size(); ++v)
      painter.addPath(recording.vehicles()[v], run.trails[v], drawing::legendEnd(run));
  }
  if (options.showVehicles) painter.addVehicles(recording, run);
  drawing::addOverlay(camera, run, options,
                      options.title.empty() ? parts_->scene.name : options.title, picture);
  return drawing::rasterise(picture, *parts_->context);
}

std::optional<Eigen::Vector2d> SnapshotRenderer::project(const Recording& recording,
                                                         const SnapshotOptions& options,
                                                         const Eigen::Vector3d& point) const {
  drawing::checkOptions(recording, options);
  const drawing::RunExcerpt run = drawing::excerptOf(recording, options);
  return drawing::cameraFor(parts_->sight, recording, run, options).pixel(point);
}

}  // namespace bumper
