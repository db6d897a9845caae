#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bumper/base/api.h"
#include "bumper/scenes/walls.h"

namespace BUMPER_API bumper {

/// A straight corridor: a rectangle in the horizontal plane.
struct PlanStrip {
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();      ///< on its middle line, m
  Eigen::Vector2d direction = Eigen::Vector2d::UnitX();  ///< unit, along the middle line
  double start = 0.0;                                    ///< m along that line from the origin
  double end = 0.0;                                      ///< … likewise, not before `start`
  double halfWidth = 0.0;                                ///< m
};

/// Broad phase over all walls in the horizontal plane, whatever their heights: finds quickly how
/// far a corridor is free. Takes little memory: walls that go on from one another are one thick
/// line where that is true to 5 cm, and the lines lie in a uniform grid.
class WallPlan {
 public:
  /// Of no walls.
  WallPlan() = default;
  explicit WallPlan(const std::vector<Wall>& walls);

  /// How far along its middle line a corridor is free, m: between `start` and that place there is
  /// certainly no wall in it, even one that only touches an edge. `end` if there is none at all;
  /// less than `start` if one reaches over the corridor's beginning, or a number is not finite.
  /// Short of the truth by a few centimetres at walls that stand upright, by at most twice their
  /// width in plan at those that lean.
  [[nodiscard]] double freeUntil(const PlanStrip& strip) const;

  [[nodiscard]] std::size_t memory() const;  ///< bytes
  [[nodiscard]] std::size_t lineCount() const { return lines_; }

 private:
  /// Where a line begins, from the plan's origin, and the next node is where it ends: all of its
  /// walls are within `thickness` of it. Negative: no line begins here.
  struct Node {
    float x;
    float y;
    float thickness;
  };
  /// Lines that follow one another.
  struct Run {
    std::uint32_t first;
    std::uint32_t count;
  };
  class Builder;

  /// Those of the grid that a rectangle touches, the last ones included.
  struct Cells {
    std::size_t left, right, near, far;
    [[nodiscard]] std::size_t count() const { return (right - left + 1) * (far - near + 1); }
  };

  [[nodiscard]] Cells cellsOf(std::size_t line) const;
  void chooseCellSize();
  void sortIntoCells();
  void shorten(const Run& run, const PlanStrip& strip, double& until) const;
  [[nodiscard]] std::size_t columnAt(double x) const;
  [[nodiscard]] std::size_t rowAt(double y) const;

  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();
  std::vector<Node> nodes_;
  std::size_t lines_ = 0;

  // The grid over all lines, from the plan's origin on; and for each cell, row by row, where its
  // runs begin.
  Eigen::Vector2d size_ = Eigen::Vector2d::Zero();  // m
  double cell_ = 1.0;                               // m
  std::size_t columns_ = 0;
  std::size_t rows_ = 0;
  std::vector<std::uint32_t> firstRun_;
  std::vector<Run> runs_;
};

}  // namespace bumper
