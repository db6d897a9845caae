#pragma once

#include <Eigen/Core>
#include <optional>

#include "bumper/base/api.h"
#include "bumper/render/snapshot.h"
#include "run_excerpt.h"
#include "sight_lines.h"

namespace BUMPER_INTERNAL bumper {
namespace drawing {

/// From the world to the picture.
struct Camera {
  Eigen::Vector3d eye = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< rows: right, up, back
  Eigen::Matrix4d projection = Eigen::Matrix4d::Identity();
  int width = 0;
  int height = 0;
  bool perspective = false;
  Eigen::Vector3d focus = Eigen::Vector3d::Zero();  ///< what the picture is about, on the ground
  double extent = 0.0;     ///< m from the focus: radius of what the picture is about
  double hazeStart = 0.0;  ///< distance from the camera, m, where haze begins …
  double hazeEnd = 0.0;    ///< … and where it hides everything; 0: no haze
  Eigen::Vector3d sun = Eigen::Vector3d::UnitZ();  ///< unit, towards the sun

  [[nodiscard]] Eigen::Vector3d right() const { return axes.row(0); }
  [[nodiscard]] Eigen::Vector3d up() const { return axes.row(1); }
  [[nodiscard]] Eigen::Vector3d back() const { return axes.row(2); }

  /// OpenGL clip space.
  [[nodiscard]] Eigen::Vector4d clip(const Eigen::Vector3d& point) const;
  /// From the left and top edges; nothing behind the camera.
  [[nodiscard]] std::optional<Eigen::Vector2d> pixel(const Eigen::Vector3d& point) const;
  /// At a point in front of the camera.
  [[nodiscard]] double pixelsPerMetre(const Eigen::Vector3d& point) const;
  /// Unit, from a point to the camera.
  [[nodiscard]] Eigen::Vector3d towards(const Eigen::Vector3d& point) const;
};

/// Where an orbit camera stands.
Eigen::Vector3d eyeOf(const OrbitCamera& orbit, const Eigen::Vector3d& centre);

/// Throws Error if the options' view has no such vehicle or a number outside its range.
Camera cameraFor(const SightLines& scene, const Recording& recording, const RunExcerpt& run,
                 const SnapshotOptions& options);

}  // namespace drawing
}  // namespace bumper
