#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bumper/base/api.h"
#include "bumper/render/image.h"
#include "bumper/render/offscreen_backend.h"
#include "bumper/render/recording.h"
#include "bumper/render/vehicle_meshes.h"
#include "bumper/scenes/scene.h"

namespace BUMPER_API bumper {

/// Where the camera stands. The first two frame the run, not the scene, by themselves.
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
  three_quarter,
  chase,  ///< from behind and above a vehicle: ChaseCamera
  fixed,  ///< from one point to another: FixedCamera
  orbit   ///< on a circle around a point: OrbitCamera
};

/// Follows a vehicle at the last instant that the picture shows, as if towed on a rope: it looks
/// along the vehicle's path rather than its heading, so that it turns gently where the vehicle
/// spins. Where a wall would stand between the two, it moves up to the vehicle. Vertical field of
/// view 52°.
struct ChaseCamera {
  std::size_t vehicle = 0;  ///< index in the recording
  double distance = 10.0;   ///< m behind the mass centre, 2 to 1000
  double height = 3.8;      ///< m above the mass centre, 0 to 1000
};

/// World frame, m. `up` is the world's z, or y for a camera that looks straight down or up.
struct FixedCamera {
  Eigen::Vector3d eye{-20.0, -20.0, 15.0};
  Eigen::Vector3d target{0.0, 0.0, 0.0};  ///< in the middle of the picture; not at the eye
  double fieldOfView = 40.0;              ///< vertical, degrees, 1 to 120
};

/// On a circle around a point, looking at it, with the light from its side. Vertical field of view
/// 32°.
struct OrbitCamera {
  enum class Around {
    hardest_impact,  ///< of all that the picture frames; without impacts the vehicle
    vehicle          ///< its mass centre at the last instant that the picture shows
  };
  Around around = Around::hardest_impact;
  std::optional<Eigen::Vector3d> centre;  ///< m, world: this point instead
  std::size_t vehicle = 0;                ///< index in the recording
  double angle = -135.0;    ///< degrees from the world's x axis to the camera, to the left
  double elevation = 25.0;  ///< degrees above the horizontal, 1 to 89
  double distance = 24.0;   ///< m from the centre, 1 to 10000
};

/// What a picture shows. The defaults make one that needs no editing.
struct SnapshotOptions {
  int width = 1280;  ///< pixels, 160 to 8192 and what the driver allows
  int height = 720;  ///< pixels, 120 to 8192 and what the driver allows
  SnapshotView view = SnapshotView::top;
  /// s: when vehicles are drawn, all but the last as ghosts. The run is drawn from the first to the
  /// last of them. Empty: the whole run, with the end and the hardest impact, and as far as there
  /// is room the start, the other impacts, and instants at even distances between them, a vehicle
  /// that stays only once, and with more than eight vehicles the end alone; in a three-quarter view
  /// the start and the end of what it frames.
  std::vector<double> instants;
  /// s: a frame of a replay. Vehicles stand where they are then, solid; impacts and the path are
  /// shown up to then, and ghosts at those of `instants` that lie before it, none if there are
  /// none. The frame of the top and the three-quarter view, the legend and the length of arrows are
  /// those of the same picture without a moment: they do not change from frame to frame. Must lie
  /// within what is drawn without it.
  std::optional<double> moment;
  ChaseCamera chase;
  FixedCamera fixed;
  OrbitCamera orbit;
  VehicleMeshes vehicleMeshes;  ///< of the vehicles that are not drawn as a car-like body
  std::string title;            ///< empty: the scene's name
  bool showVehicles = true;
  bool showPath = true;     ///< a ribbon coloured by speed, with its legend
  bool showImpacts = true;  ///< marks; the strong with number, the wall's normal and Δv
  bool showTimes = true;    ///< beside vehicles where there is room; not with a moment
  /// With the world's axes; in other views than the top, the axes and the spacing of the grid.
  bool showScaleBar = true;
  /// More are an Error: layers of triangles, one behind the other, over the whole picture, as
  /// estimated from boxes around some 400 of them each. A layer of 1280 × 720 pixels takes about
  /// 2 ms, hidden or not; real scenes have some hundreds near the camera.
  double mostOverdraw = 10000.0;
  bool showTitle = true;  ///< with the span of time, the hardest impact and the marks' legend
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
/// current OpenGL context. Throws Error on an invalid scene or vehicle mesh, a size, a camera or an
/// instant outside its range (no vehicle was recorded at it), a vehicle that the recording does not
/// have, or if the driver fails.
///
/// For many pictures of one scene use SnapshotRenderer: this makes one for every picture.
Image renderSnapshot(const Scene& scene, const Recording& recording,
                     const SnapshotOptions& options = {},
                     OffscreenBackend backend = OffscreenBackend::automatic);

/// Where a point of the world lies in the picture that renderSnapshot() makes of the same input:
/// pixels from the left and from the top edge; the centre of the first pixel is (0.5, 0.5). May lie
/// outside the picture; nothing for a point behind the camera. Throws Error as renderSnapshot does.
std::optional<Eigen::Vector2d> projectToSnapshot(const Scene& scene, const Recording& recording,
                                                 const SnapshotOptions& options,
                                                 const Eigen::Vector3d& point);

}  // namespace bumper
