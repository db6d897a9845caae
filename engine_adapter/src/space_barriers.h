#pragma once

#include <ode/ode.h>

#include <array>
#include <string>
#include <vector>

#include "bumper/engine_adapter/barrier.h"

namespace bumper {

/// How a geom stood when its walls were read.
struct GeomStand {
  int kind = -1;
  std::array<dReal, 6> box{};  // around it
  std::array<dReal, 3> position{};
  std::array<dReal, 12> rotation{};
  bool operator==(const GeomStand&) const = default;
};

/// A space whose geoms are barriers.
struct BarrierSpace {
  struct Member {
    dGeomID geom = nullptr;  // may be gone
    BarrierId barrier;
    GeomStand stand;
  };

  dSpaceID space = nullptr;
  BarrierOptions options;
  std::string scenery;  // what options refers to
  std::vector<Member> members;
  SpaceBarriers found;
};

}  // namespace bumper
