#pragma once

#include <span>
#include <vector>

#include "wall_sections.h"

namespace bumper::doctor {

/// How far a vehicle can slide along a wall: the wall's line through the plane's origin, with the
/// vehicle's side on the left (+y). Lengths along it, m, count from the origin, forwards (+x).
struct WallPath {
  std::vector<Vector2> points;
  std::vector<double> lengths;  ///< of each point, increasing
  double start = 0.0;           ///< where it is clear: nothing stands in the way from there …
  double end = 0.0;             ///< … to there

  [[nodiscard]] double clear() const { return end - start; }
  /// At a length from start to end: the point, and the unit direction forwards.
  [[nodiscard]] Vector2 pointAt(double length) const;
  [[nodiscard]] Vector2 directionAt(double length) const;
  /// From a point to the path, m.
  [[nodiscard]] double distanceTo(const Vector2& point) const;

 private:
  [[nodiscard]] std::size_t legAt(double length) const;
};

struct PathLimits {
  double reach = 20.0;          ///< m, either way
  double feature = 0.02;        ///< m: what stands out by more ends the path
  double gap = 0.3;             ///< m: a wider one ends it too
  double width = 2.0;           ///< m, of the room that the vehicle needs
  double bend = 10.0 * degree;  ///< rad between two pieces; a sharper one ends it
};

/// The origin lies on one of `walls`, along the x axis; `obstacles` may stand in the way.
WallPath pathAlong(std::span<const WallLine> walls, std::span<const WallLine> obstacles,
                   const PathLimits& limits);

}  // namespace bumper::doctor
