#pragma once

#include <Eigen/Core>
#include <vector>

#include "ode_mesh.h"
#include "subject.h"

namespace bumper::doctor {

/// The heights of a scene's ground: what faces up or down by less than 45° from the vertical.
class Ground {
 public:
  explicit Ground(const Subject& subject);
  ~Ground();
  Ground(const Ground&) = delete;
  Ground& operator=(const Ground&) = delete;
  Ground(Ground&&) = delete;
  Ground& operator=(Ground&&) = delete;

  /// Between two heights at a place, m, from below.
  [[nodiscard]] std::vector<double> heightsAt(const Eigen::Vector2d& place, double bottom,
                                              double top) const;

 private:
  OdeMesh mesh_;
  dGeomID ray_;
};

}  // namespace bumper::doctor
