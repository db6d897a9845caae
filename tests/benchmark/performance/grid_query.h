#pragma once

#include <vector>

#include "bumper/response/collision_step.h"
#include "bumper/response/response_settings.h"
#include "drive.h"
#include "scenes.h"
#include "wall_grid.h"

namespace bumper::benchmark {

/// The practical limit of a query: one look-up, and an exact test of what is there.
class GridQuery {
 public:
  explicit GridQuery(const Scene& scene);

  void moveTo(const Pose& pose) { place_ = pose.place; }
  std::size_t query() {
    count_ = 0;
    for (const PlanSegment& wall : grid_.near(place_.position)) {
      if (overlap(outline_, place_, wall)) ++count_;
    }
    return count_;
  }
  [[nodiscard]] bool found() const { return count_ > 0; }

 private:
  Outline outline_;
  WallGrid grid_;
  PlanPlace place_;
  std::size_t count_ = 0;
};

/// The same look-up, and Bumper's own sweep and response for what is there: what a step costs if
/// the walls are found by hand.
class GridSweep {
 public:
  explicit GridSweep(const Scene& scene);

  void moveTo(const Pose& pose) { pose_ = pose; }
  std::size_t query();
  [[nodiscard]] bool found() const { return count_ > 0; }

 private:
  VehicleParameters car_ = queryCar();
  ResponseSettings settings_;
  Surface surface_{.settings = &settings_};
  WallGrid grid_;
  CollisionStep collision_;
  std::vector<Segment> segments_;
  Pose pose_;
  std::size_t count_ = 0;
};

}  // namespace bumper::benchmark
