#include <cmath>
#include <string>

#include "bumper/response/error.h"
#include "bumper/scenes/paper_scenes.h"
#include "sheet.h"

namespace bumper {

Scene straightWall(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double height,
                   std::size_t panels, std::size_t rows) {
  if (!(std::isfinite(height) && height > 0.0)) {
    throw Error("straightWall: height is " + std::to_string(height) +
                " m: it must be finite and positive");
  }
  if (!((to - from).norm() > 0.0 && (to - from).allFinite())) {
    throw Error("straightWall: start and end must be finite and apart");
  }
  if (panels == 0 || rows == 0) {
    throw Error("straightWall: needs at least one panel and one row");
  }
  Scene scene;
  scene.name = "straight_wall";
  const std::uint32_t mesh = addMesh(scene, "wall", "concrete", {0.76F, 0.74F, 0.69F});
  Sheet sheet{{}, rows + 1, false, std::vector<std::uint32_t>(rows, mesh)};
  for (std::size_t i = 0; i <= panels; ++i) {
    const double way = static_cast<double>(i) / static_cast<double>(panels);
    // This form meets both ends exactly.
    const Eigen::Vector2d place = (1.0 - way) * from + way * to;
    for (std::size_t k = 0; k <= rows; ++k) {
      sheet.points.emplace_back(place.x(), place.y(),
                                height * (static_cast<double>(k) / static_cast<double>(rows)));
    }
  }
  addSheet(scene, sheet);
  return scene;
}

}  // namespace bumper
