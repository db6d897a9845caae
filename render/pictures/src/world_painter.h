#pragma once

#include <Eigen/Core>
#include <array>
#include <map>

#include "bumper/render/recording.h"
#include "bumper/render/snapshot.h"
#include "camera.h"
#include "picture.h"
#include "run_excerpt.h"

namespace bumper::drawing {

/// Fills a picture's lists with what stands in the world.
class WorldPainter {
 public:
  /// Sets camera, light and haze.
  WorldPainter(const Camera& camera, Picture& picture);

  /// Ghosts and solid vehicles in their paint, or as their own meshes.
  void addVehicles(const Recording& recording, const RunExcerpt& run,
                   const SnapshotOptions& options);
  /// A path on the ground below the mass centre, coloured by speed from 0 to `fastest`, m/s.
  void addPath(const RecordedVehicle& vehicle, const std::vector<RecordedPose>& path,
               double fastest);

 private:
  void addBackground();
  void setSun();
  [[nodiscard]] FlatVertex vertexAt(const Eigen::Vector3d& point, const Colour& colour) const;
  void addFarMarker(const DrawnPose& drawn, const Colour& colour);
  [[nodiscard]] Range addBody(const RecordedVehicle& vehicle, std::size_t index,
                              const SnapshotOptions& options);

  const Camera& camera_;
  Picture& picture_;
};

}  // namespace bumper::drawing
