#pragma once

#include <Eigen/Core>
#include <vector>

#include "bumper/scenes/scene.h"

namespace bumper::tests {

/// Scenes as people build them: each face has corners of its own, along x, rails in a mesh of their
/// own.
class Roadside {
 public:
  Roadside();

  enum Mesh : std::uint32_t { ground, rail };

  void addQuad(Mesh mesh, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
               const Eigen::Vector3d& c, const Eigen::Vector3d& d);
  /// A level rectangle.
  void addFloor(const Eigen::Vector2d& low, const Eigen::Vector2d& high, double height);
  /// The same of boards that lie across x, with gaps between them, m.
  void addPlanks(const Eigen::Vector2d& low, const Eigen::Vector2d& high, double height,
                 double width, double joint);
  /// A sheet with that section, as (y, z), between two places along x, in pieces.
  void addBeam(const std::vector<Eigen::Vector2d>& section, double from, double to, int pieces = 1);
  /// A guard rail of two sheets, 0.1 m apart, from 0.3 to 0.8 m above `height`.
  void addRail(double y, double height, double from, double to);
  /// A prism around a line; `turn` turns it about that line, rad.
  void addTube(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius, int sides,
               double turn);
  /// Turns all about z.
  void turn(double yaw);

  Scene scene;
};

/// The corners of a tube's section, around the line from `from` to `to`.
std::vector<Eigen::Vector3d> tubeSection(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                         double radius, int sides, double turn);

}  // namespace bumper::tests
