#include "up_axis.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "bumper/scenes/walls.h"

namespace bumper {

namespace {

/// Ground leans by less than 25°.
constexpr double minGroundNormalUp = 0.9;

constexpr double minAreaRatio = 2.0;
constexpr double minHeightRatio = 3.0;

/// m; what is narrower is the face of a wall, not ground.
constexpr double minGroundWidth = 5.0;

/// A scene seen from one of its axes.
struct View {
  double ground = 0.0;  ///< m², what would lie flat if the axis pointed up
  double walls = 0.0;   ///< m², what would stand
};

std::array<View, 3> viewsOf(const Scene& scene) {
  const double maxWallNormalUp = WallSelection{}.maxNormalUp;
  std::array<View, 3> views;
  for (const Scene::Triangle& triangle : scene.triangles) {
    const Eigen::Vector3d& a = scene.corner(triangle, 0);
    const Eigen::Vector3d normal =
        (scene.corner(triangle, 1) - a).cross(scene.corner(triangle, 2) - a);
    const double twice = normal.norm();
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      View& view = views.at(static_cast<std::size_t>(axis));
      if (std::abs(normal[axis]) >= minGroundNormalUp * twice) view.ground += 0.5 * twice;
      if (std::abs(normal[axis]) <= maxWallNormalUp * twice) view.walls += 0.5 * twice;
    }
  }
  return views;
}

/// The larger ground of the two other views.
double groundOfOthers(const std::array<View, 3>& views, Eigen::Index axis) {
  const auto ground = [&](Eigen::Index k) { return views.at(static_cast<std::size_t>(k)).ground; };
  return std::max(ground((axis + 1) % 3), ground((axis + 2) % 3));
}

const char* nameOf(UpAxis axis) {
  return std::array{"x", "y", "z"}.at(static_cast<std::size_t>(axis));
}

/// The axis of a scene along which an axis of its file lies.
Eigen::Index sceneAxis(UpAxis ofFile, UpAxis up) {
  Eigen::Index axis = 0;
  turned(Eigen::Vector3d::Unit(static_cast<Eigen::Index>(ofFile)), up).cwiseAbs().maxCoeff(&axis);
  return axis;
}

}  // namespace

Eigen::Vector3d turned(const Eigen::Vector3d& v, UpAxis up) {
  switch (up) {
    case UpAxis::x:
      return {v.y(), v.z(), v.x()};
    case UpAxis::y:
      return {v.x(), -v.z(), v.y()};
    case UpAxis::z:
      break;
  }
  return v;
}

std::string upContradiction(const Scene& scene, UpAxis up) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& vertex : scene.vertices) box.extend(vertex);
  const Eigen::Vector3d extents = box.sizes();
  const std::array<View, 3> views = viewsOf(scene);
  const View& taken = views[2];
  for (const UpAxis other : {UpAxis::x, UpAxis::y, UpAxis::z}) {
    const Eigen::Index axis = sceneAxis(other, up);
    const View& view = views.at(static_cast<std::size_t>(axis));
    const double width = std::min(extents[(axis + 1) % 3], extents[(axis + 2) % 3]);
    if (other == up || view.walls == 0.0 || width < minGroundWidth ||
        view.ground < minAreaRatio * groundOfOthers(views, axis) ||
        extents.z() < minHeightRatio * extents[axis]) {
      continue;
    }
    std::ostringstream what;
    what.precision(3);
    what << "was read with " << nameOf(up) << " up, but looks as if " << nameOf(other)
         << " were: it is then " << extents[axis] << " m tall instead of " << extents.z()
         << " m, with " << view.ground << " m² of level ground instead of " << taken.ground
         << " m²; see LoadOptions::up";
    return what.str();
  }
  return "";
}

}  // namespace bumper
