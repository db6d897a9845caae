#pragma once

#include <Eigen/Core>
#include <array>

#include "bumper/render/recording.h"
#include "bumper/scenes/scene.h"
#include "camera.h"
#include "picture.h"
#include "run_excerpt.h"

namespace bumper::drawing {

/// Turns things of the world into the picture's triangles.
class WorldPainter {
 public:
  /// Sets the picture's origin, haze, background and sun for the camera.
  WorldPainter(const Camera& camera, Picture& picture);

  /// Lit surfaces in their meshes' colours; edges of what stands upright are drawn as lines, and it
  /// throws shadows. In the top view walls and their edges have a colour of their own.
  void addScene(const Scene& scene);
  /// Ghosts and solid vehicles in their paint.
  void addVehicles(const Recording& recording, const RunExcerpt& run);
  /// A path on the ground below the mass centre, coloured by speed from 0 to `fastest`, m/s.
  void addPath(const RecordedVehicle& vehicle, const std::vector<RecordedPose>& path,
               double fastest);

 private:
  using Corners = std::array<Eigen::Vector3d, 3>;

  void addBackground();
  void setSun();
  [[nodiscard]] Vertex vertexAt(const Eigen::Vector3d& point, const Colour& colour,
                                const Lighting& lighting) const;
  [[nodiscard]] Lighting lightingOf(const Corners& corners) const;
  void addLit(const Corners& corners, const Colour& colour, float grid, Triangles& into) const;
  void addShadow(const Corners& corners);
  void addEdge(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Colour& colour);
  void addFarMarker(const DrawnPose& drawn, const Colour& colour);

  const Camera& camera_;
  Picture& picture_;
};

/// The paint of the vehicle with an index in the recording.
Eigen::Vector3f paintOf(std::size_t vehicle);

}  // namespace bumper::drawing
