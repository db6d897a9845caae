#pragma once

#include <vector>

#include "bumper/response/collision_step.h"
#include "random_impacts.h"

/// Walls as they are built, of blocks in a row, and a car that slides along them.
namespace bumper::tests {

/// A plane with its origin where the row begins: along it, and out of it towards the vehicle.
struct RowFrame {
  Vector2 origin = Vector2::Zero();
  Vector2 along = Vector2::UnitX();

  [[nodiscard]] Vector2 out() const { return turnedLeft(along); }
  [[nodiscard]] Vector2 at(double x, double y) const { return origin + x * along + y * out(); }
};

struct Row {
  RowFrame frame;
  std::vector<Segment> walls{};
  double foremost = 0.0;  ///< of all faces, above the frame's line, m
};

/// A block, or a sheet if it has no thickness, whose face stands out by `out`.
struct Block {
  double from = 0.0, to = 0.0;  ///< along the row, m
  double out = 0.0;
  double thickness = 0.0;
};
void add(Row& row, const Block& block);

/// What blocks there are.
struct Masonry {
  double unit = 1.0;       ///< a model's scale
  double off = 0.0;        ///< each block stands in line or out by this, m
  double length = 0.0;     ///< of the row, m
  bool jointless = false;  ///< every joint is closed; else open up to 30 cm · unit, or closed
};
Row randomRow(Random& random, const Masonry& masonry, const RowFrame& frame);

/// A wall at an angle to the axes, made of square cells: the edge of those that lie behind it.
Row staircase(double cell, double length, const RowFrame& frame);

/// The coordinates as single precision stores them.
void roundToFloat(Row& row);

struct Slide {
  VehicleParameters vehicle;
  double speed = 0.0;     ///< along the row at first, m/s
  double into = 0.0;      ///< heading and motion into the row, rad
  double step = 0.0;      ///< s
  double distance = 0.0;  ///< along the row, m
  double start = 0.0;     ///< of the mass centre along the row, m
  double gap = 0.0;       ///< of the foremost corner above the foremost face at first, m
  double pressing = 4.0;  ///< m/s²
};

struct SlideResult {
  double hardest = 0.0;      ///< velocity change in one impact, m/s
  double hardestStep = 0.0;  ///< … in one step
  double deepest = 0.0;      ///< of the outline below the foremost face, m
  double speed = 0.0;        ///< at the end, along the row, m/s
  double slowest = 0.0;      ///< along the row, m/s
  int impacts = 0;
  bool settled = true;
  double turned = 0.0;  ///< largest deviation from the heading, rad
};

/// The car drives along the row, is pressed against it and steered to keep its heading.
SlideResult slideAlong(CollisionStep& collision, const Row& row, const Slide& slide,
                       const ResponseSettings& settings = {});

}  // namespace bumper::tests
