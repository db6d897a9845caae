#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "bumper/scenes/scene.h"

namespace bumper::examples {

/// Finds where in a scene a car can be put down.
class StartPlaces {
 public:
  /// `scene` is referred to, its corners welded, as loadScene() leaves them; `scenery`, by mesh, is
  /// passed over.
  StartPlaces(const Scene& scene, const std::vector<bool>& scenery);

  /// Height of the ground at a place, m: the lowest with 2 m of room above it, so the floor of a
  /// hall and not its roof, the road and not the bridge over it. Ground is flatter than 45°. The
  /// inside of a closed solid that walls stand on has none. Without such room the highest ground is
  /// taken, without ground the highest surface; empty if nothing is there.
  [[nodiscard]] std::optional<double> lowestGround(const Eigen::Vector2d& place) const;

  /// The same of the storey that a height, m, names: the highest ground that is not more than half
  /// a metre above it; if there is none, the lowest.
  [[nodiscard]] std::optional<double> groundNear(const Eigen::Vector2d& place, double height) const;

  /// The place nearest to the scene's middle on the largest connected piece of ground, where that
  /// is level to 14° if it is so anywhere: the scene's middle or that of a triangle. Empty if there
  /// is no ground.
  [[nodiscard]] std::optional<Eigen::Vector2d> middle() const;

 private:
  struct Surface {
    double height;  ///< m
    bool isGround;
    bool facesUp;
    bool facesDown;
  };

  [[nodiscard]] std::vector<Surface> surfacesAt(const Eigen::Vector2d& place) const;
  [[nodiscard]] bool wallsStandOn(double height) const;

  const Scene& scene_;
  std::vector<Scene::Triangle> triangles_;
};

}  // namespace bumper::examples
