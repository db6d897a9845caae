#include "bumper/render/snapshot_renderer.h"

#include <optional>
#include <string>

#include "camera.h"
#include "offscreen_context.h"
#include "overlay.h"
#include "picture.h"
#include "rasteriser.h"
#include "run_excerpt.h"
#include "scene_model.h"
#include "sight_lines.h"
#include "snapshot_input.h"
#include "text_renderer.h"
#include "world_painter.h"

namespace bumper {

class BUMPER_HIDDEN SnapshotRenderer::Parts {
 public:
  Parts(const Scene& scene, OffscreenBackend backend)
      : name(scene.name), sight(scene), context(drawing::makeOffscreenContext(backend)) {
    const drawing::ContextInUse use(*context);
    rasteriser.emplace(*context, drawing::sceneModel(scene));
  }

  std::string name;  ///< of the scene
  drawing::SightLines sight;
  std::unique_ptr<drawing::OffscreenContext> context;
  std::optional<drawing::Rasteriser> rasteriser;
  drawing::TextRenderer textRenderer;
};

SnapshotRenderer::SnapshotRenderer(const Scene& scene, OffscreenBackend backend) {
  validate(scene);
  parts_ = std::make_unique<Parts>(scene, backend);
}

SnapshotRenderer::SnapshotRenderer(SnapshotRenderer&& other) noexcept = default;
SnapshotRenderer& SnapshotRenderer::operator=(SnapshotRenderer&& other) noexcept = default;
SnapshotRenderer::~SnapshotRenderer() = default;

OffscreenBackend SnapshotRenderer::backend() const { return parts_->context->backend(); }

Image SnapshotRenderer::draw(const Recording& recording, const SnapshotOptions& options) {
  drawing::checkOptions(recording, options);
  const drawing::RunExcerpt run = drawing::excerptOf(recording, options);
  const drawing::Camera camera = drawing::cameraFor(parts_->sight, recording, run, options);

  drawing::Picture picture;
  picture.mostOverdraw = options.mostOverdraw;
  drawing::WorldPainter painter(camera, picture);
  if (options.showPath) {
    for (std::size_t v = 0; v < run.trails.size(); ++v)
      painter.addPath(recording.vehicles()[v], run.trails[v], drawing::legendEnd(run));
  }
  if (options.showVehicles) painter.addVehicles(recording, run, options);
  drawing::addOverlay(camera, run, options, options.title.empty() ? parts_->name : options.title,
                      picture);
  const drawing::ContextInUse use(*parts_->context);
  Image image = parts_->rasteriser->draw(picture);
  parts_->textRenderer.write(picture.textLines, image);
  return image;
}

std::optional<Eigen::Vector2d> SnapshotRenderer::project(const Recording& recording,
                                                         const SnapshotOptions& options,
                                                         const Eigen::Vector3d& point) const {
  drawing::checkOptions(recording, options);
  const drawing::RunExcerpt run = drawing::excerptOf(recording, options);
  return drawing::cameraFor(parts_->sight, recording, run, options).pixel(point);
}

}  // namespace bumper
