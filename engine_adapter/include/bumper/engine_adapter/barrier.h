#pragma once

#include <ode/ode.h>

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bumper/base/api.h"
#include "bumper/response/response_settings.h"
#include "bumper/scenes/walls.h"

namespace BUMPER_API bumper {

/// Names a barrier of one responder.
struct BarrierId {
  int value = -1;
  bool operator==(const BarrierId&) const = default;
};

/// How a barrier moves, world: of the place of its geom, m/s, and the rotation of it all, rad/s.
struct BarrierVelocity {
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular = Eigen::Vector3d::Zero();
};

struct BarrierOptions {
  /// The space in which a barrier made from a scene puts its new geom; may be null, then the
  /// application collides it itself. Not used for a mesh that the application already has.
  dSpaceID space = nullptr;
  /// The application's geom whose shape the scene is, in the world's axes and unit, for classes
  /// whose shape ODE does not expose: convex, heightfield. Null: a new geom is made. Not used for a
  /// geom that is a barrier by itself.
  dGeomID geom = nullptr;
  /// The name in events; empty: the scene's name, or "barrier <number>".
  std::string name{};
  /// Which triangles are walls.
  WallSelection walls{};
  /// How these walls respond; empty: ResponderOptions::response.
  std::optional<ResponseSettings> response{};
  /// How the walls of some materials respond, by the material's name in the scene. A name that the
  /// scene does not have is an Error.
  std::map<std::string, ResponseSettings> materials{};
};

/// The geoms of a space as barriers: Responder::addBarriers().
struct SpaceBarriers {
  /// A geom that stands still and is no barrier, and why: it is flat, or ODE does not tell its
  /// shape.
  struct Left {
    dGeomID geom = nullptr;
    std::string reason{};
  };
  std::vector<BarrierId> barriers{};  ///< each of one geom; Responder::geom() says which
  std::vector<Left> left{};
};

}  // namespace bumper
