#include "bumper/render/snapshot.h"

#include "bumper/render/snapshot_renderer.h"
#include "camera.h"
#include "run_excerpt.h"
#include "sight_lines.h"
#include "snapshot_input.h"

namespace bumper {

Image renderSnapshot(const Scene& scene, const Recording& recording, const SnapshotOptions& options,
                     OffscreenBackend backend) {
  return SnapshotRenderer(scene, backend).draw(recording, options);
}

std::optional<Eigen::Vector2d> projectToSnapshot(const Scene& scene, const Recording& recording,
                                                 const SnapshotOptions& options,
                                                 const Eigen::Vector3d& point) {
  validate(scene);
  drawing::checkOptions(recording, options);
  const drawing::RunExcerpt run = drawing::excerptOf(recording, options);
  return drawing::cameraFor(drawing::SightLines(scene), recording, run, options).pixel(point);
}

}  // namespace bumper
