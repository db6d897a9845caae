#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "bumper/render/image.h"
#include "bumper/render/recording.h"
#include "bumper/scenes/scene.h"

namespace bumper {

/// Where the camera stands. Both views frame the run, not the scene.
enum class SnapshotView {
  /// Straight from above, to scale. The frame is the rectangle along the world's axes around all
  /// drawn mass centres and contact points, grown on every side by 1.5 times the longest vehicle,
  /// at least by 6 m; its centre is the picture's centre. It is scaled to the largest size at which
  /// it takes at most 92 % of the picture's width and 76 % of its height. World x points right and
  /// y up; if that lays the frame's longer side along the picture's shorter, y points right and x
  /// down. Nothing higher than 8 m above the run's highest mass centre is drawn.
  top,
  /// From behind, beside and above, on the open side of the wall: frames the hardest impact and
  /// what happened within 15 m of it; without impacts the last 30 m of the run.
  three_quarter
};

/// What a picture shows. The defaults make one that needs no editing.
struct SnapshotOptions {
  int width = 1280;  ///< pixels, 160 to 8192 and what the driver allows
  int height = 720;  ///< pixels, 120 to 8192 and what the driver allows
  SnapshotView view = SnapshotView::top;
  /// s: when vehicles are drawn, all but the last as ghosts. The run is drawn from the first to the
  /// last of them. Empty: the whole run, with the end and the hardest impact, and as far as there
  /// is room the start, the other impacts, and instants at even distances between them; in a
  /// three-quarter view the start and the end of what it frames.
  std::vector<double> instants;
  std::string title;  ///< empty: the scene's name. ASCII; other letters appear as '?'
  bool showVehicles = true;
  bool showPath = true;      ///< a ribbon coloured by speed, with its legend
  bool showImpacts = true;   ///< marks; the strong with number, the wall's normal and Δv
  bool showScaleBar = true;  ///< top view only
  bool showTitle = true;     ///< with the span of time, the hardest impact and the marks' legend
};

/// Draws a scene and what happened in it. Impacts are numbered from 1 in the recording's order. The
/// eight with the largest Δv, without those below a tenth of the hardest's, have a label with
/// number and Δv, and an arrow along the wall's normal; the others are small dots. The arrow's
/// length is proportional to Δv: full at the hardest impact's or at 5 m/s, whichever is more; one
/// that points to or from the camera is drawn shorter. A label that would not fit into the picture
/// is left out, its mark is not. In the top view walls have a colour of their own. A recording
/// without poses shows the scene alone.
///
/// The same input gives the same picture on one machine; other processors and drivers differ in
/// single pixels. May be called from several threads at once; the calling thread is left without a
/// current OSMesa context. Throws Error on an invalid scene, a size or an instant outside its range
/// (no vehicle was recorded at it), or if the driver fails.
Image renderSnapshot(const Scene& scene, const Recording& recording,
                     const SnapshotOptions& options = {});

/// Where a point of the world lies in the picture that renderSnapshot() makes of the same input:
/// pixels from the left and from the top edge; the centre of the first pixel is (0.5, 0.5). May lie
/// outside the picture; nothing for a point behind the camera. Throws Error as renderSnapshot does.
std::optional<Eigen::Vector2d> projectToSnapshot(const Scene& scene, const Recording& recording,
                                                 const SnapshotOptions& options,
                                                 const Eigen::Vector3d& point);

}  // namespace bumper
