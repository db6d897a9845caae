// Lines of sight in a scene of any bytes, and now and then a small picture of it.

#include <cstdlib>

#include "bumper/render/recording.h"
#include "bumper/render/snapshot.h"
#include "bumper/response/error.h"
#include "bumper/scenes/scene_budget.h"
#include "input.h"
#include "sight_lines.h"
#include "synthetic_run.h"

namespace {

void look(bumper::fuzz::Input& input) {
  const std::uint8_t kind = input.byte();
  const bumper::Scene scene = bumper::fuzz::sceneFrom(input);
  bumper::validate(scene, bumper::SceneBudget{});
  if (scene.triangles.empty()) return;
  const bumper::drawing::SightLines lines(scene);
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d from(input.number(), input.number(), input.number());
    const Eigen::Vector3d to(input.number(), input.number(), input.number());
    const double share = lines.visibleShare(from, to);
    if (!(share >= 0.0 && share <= 1.0)) std::abort();
    const int hidden = lines.hidden({from, to}, to);
    if (hidden < 0 || hidden > 2) std::abort();
  }
  // The software renderer takes a thousand times as long.
  if (kind % 128 != 0) return;
  static const bumper::Recording run = bumper::testing::cornerHits();
  bumper::SnapshotOptions options;
  options.width = 160;
  options.height = 120;
  options.view =
      (kind & 128U) != 0 ? bumper::SnapshotView::top : bumper::SnapshotView::three_quarter;
  const bumper::Image image = bumper::renderSnapshot(scene, run, options);
  if (image.width() != options.width || image.height() != options.height) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  bumper::fuzz::Input input(data, size);
  try {
    look(input);
  } catch (const bumper::Error&) {  // said so
  }
  return 0;
}
