#pragma once

#include <ode/ode.h>

#include <array>
#include <vector>

#include "bumper/scenes/scene.h"
#include "drive.h"

namespace bumper::benchmark {

/// dCollide of a box with a trimesh, as any ODE program does it, with at most 8 contacts.
class OdeQuery {
 public:
  explicit OdeQuery(const Scene& scene);
  ~OdeQuery();
  OdeQuery(const OdeQuery&) = delete;
  OdeQuery& operator=(const OdeQuery&) = delete;
  OdeQuery(OdeQuery&&) = delete;
  OdeQuery& operator=(OdeQuery&&) = delete;

  void moveTo(const Pose& pose);
  std::size_t query() {
    count_ = dCollide(box_, mesh_, static_cast<int>(contacts_.size()), contacts_.data(),
                      sizeof(dContactGeom));
    return static_cast<std::size_t>(count_);
  }
  [[nodiscard]] bool found() const { return count_ > 0; }

 private:
  // ODE does not copy these.
  std::vector<double> vertices_;
  std::vector<dTriIndex> indices_;
  dTriMeshDataID data_ = nullptr;
  dGeomID mesh_ = nullptr;
  dGeomID box_ = nullptr;
  int count_ = 0;
  std::array<dContactGeom, 8> contacts_{};
};

}  // namespace bumper::benchmark
