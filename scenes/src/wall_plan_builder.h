#pragma once

#include <vector>

#include "bumper/response/planar_motion.h"
#include "bumper/scenes/wall_plan.h"

namespace bumper {

/// How far walls may lie from the line that stands for them, m.
inline constexpr double coarseness = 0.05;

/// Puts walls that follow one another into one line as long as it stays true to them.
class BUMPER_HIDDEN WallPlan::Builder {
 public:
  /// Appends to `nodes`, as seen from `origin`. Rounding moves a node and changes its thickness by
  /// no more than `roundingError`, m.
  Builder(std::vector<Node>& nodes, Vector2 origin, double roundingError);

  void add(const Wall& added);

  /// Ends the line that is being put together.
  void finish();

 private:
  struct Footprint;

  static bool isAt(const Vector2& a, const Vector2& b);
  static bool coversAll(const Vector2& from, const Vector2& to, const Footprint& wall);
  [[nodiscard]] bool canReplaceEnd(const Footprint& wall) const;
  void begin(const Vector2& from, const Vector2& to, const Footprint& wall);
  void keep(const Footprint& wall);
  void writeLine();
  void addWide(const Footprint& wall);
  void writeNode(const Vector2& place, double thickness);

  std::vector<Node>& nodes_;
  Vector2 origin_;
  double roundingError_;

  Vector2 from_ = Vector2::Zero();
  Vector2 to_ = Vector2::Zero();
  std::vector<Vector2> points_;  // that the line stands for; none: there is no line
  bool isFirst_ = true;          // no line before leads to `from_`
};

}  // namespace bumper
