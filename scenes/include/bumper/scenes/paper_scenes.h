#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "bumper/base/api.h"
#include "bumper/scenes/scene.h"

namespace BUMPER_API bumper {

/// The paper's test scene (Figure 8): an L-shaped wall on flat ground, 612 triangles. For a car
/// that starts at the origin, heading along +x.
///
/// The side wall, on the car's right, has its face on the line through (42.334, -0.900) m with
/// normal (-0.10453, 0.99452), 6° to the x axis; the end wall, ahead, through (67.197, 1.713) m
/// with normal (-0.98163, -0.19081). They join where the lines meet. Each is a slab 60 m long, 0.9
/// m tall, 0.3 m thick behind its face and open below: 106 triangles. The ground, z = 0, reaches
/// from
/// (-20, -20) to (80, 70) m: 400 triangles. Meshes: "side_wall", "end_wall" (concrete), "ground"
/// (asphalt). Surfaces face outward.
Scene testRail();

/// How finely a course is meshed. The defaults give the paper's numbers of triangles.
struct CourseMesh {
  std::size_t innerPanels = 459;   ///< quads around the inner wall, at least 50
  std::size_t outerPanels = 460;   ///< quads around the outer wall, at least 50
  std::size_t groundAlong = 1157;  ///< quads of the ground along the course, at least 50
  std::size_t groundAcross = 3;    ///< and across it, at least 1
};

/// A closed course in the spirit of Watkins Glen, standing for the paper's larger scene (Figure 9):
/// driven clockwise, 5,400 m, walls 1 m high that face the road on both sides, 14 m apart, on flat
/// ground, z = 0. 8,780 triangles, of which 1,838 are walls. No bend is tighter than 60 m. Meshes:
/// "inner_wall", "outer_wall" (concrete), "road" (asphalt), "verge" (grass), which reaches 5 m
/// beyond the walls. Throws Error if `mesh` is out of range.
Scene course(const CourseMesh& mesh = {});

/// The course's centre line: `points` points equally spaced along it, the first at the origin with
/// the line heading along +x. Throws Error for fewer than 3 points.
std::vector<Eigen::Vector2d> courseCentreLine(std::size_t points);

/// A straight wall without thickness from `from` to `to`, m, standing on z = 0, in `panels` ×
/// `rows` equal quads, two triangles each. It faces left of the way from start to end. One mesh,
/// "wall". Throws Error if the ends coincide, `height` is not positive or there is no panel or row.
Scene straightWall(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double height,
                   std::size_t panels = 1, std::size_t rows = 1);

}  // namespace bumper
