#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "bumper/scenes/scene.h"
#include "wall_grid.h"

namespace bumper::benchmark {

/// One step of a drive: place and velocity as a step of ODE leaves them. The position is the last
/// one plus the step size times this velocity.
struct Pose {
  PlanPlace place;
  double halfCosine = 1.0;  ///< of half the yaw
  double halfSine = 0.0;
  Vector2 velocity = Vector2::Zero();
  double yawRate = 0.0;
};

/// What is around the outline.
enum class Nearness : std::size_t {
  far,      ///< nothing within 1 m
  near,     ///< something within 1 m
  touching  ///< leans on a wall or scrapes along it, overlapping by 1 mm
};
inline constexpr std::array allNearness = {Nearness::far, Nearness::near, Nearness::touching};

/// Poses that follow each other and are of one kind.
struct Stretch {
  Nearness kind = Nearness::far;
  std::span<const Pose> poses;
};

/// A drive through a scene, from the middle of the road out to a wall and back, again and again.
struct Drive {
  std::vector<Pose> poses;
  std::vector<Stretch> stretches;       ///< of `poses`, in order, none longer than 256
  std::array<std::size_t, 3> counts{};  ///< of poses, by nearness

  [[nodiscard]] std::size_t count(Nearness kind) const {
    return counts.at(static_cast<std::size_t>(kind));
  }
};

/// Around the test rail at 9 m/s or along the course at 28 m/s, by the scene's mesh names.
Drive makeDrive(const Scene& scene, std::size_t poses);

/// The places of `count` vehicles at equal distances along the course, in the middle of the road,
/// or touching the wall on their right.
std::vector<PlanPlace> placesAlongCourse(const Scene& scene, std::size_t count, bool touching);

/// The poses of one kind, out of any order: a drive of teleports.
std::vector<Pose> scattered(const Drive& drive, Nearness kind);

}  // namespace bumper::benchmark
