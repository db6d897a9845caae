#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bumper/scenes/scene_files.h"
#include "contact_normals.h"
#include "dropped_walls.h"
#include "impacts.h"
#include "mesh_edges.h"
#include "rig.h"
#include "slides.h"
#include "small_features.h"
#include "subject.h"
#include "tunnelling.h"

namespace bumper::doctor {

/// A lowest tunnelling speed, and where.
struct Tunnelling {
  std::optional<double> speed;  ///< m/s; empty: never
  TestDrive drive{};
};

/// What the test drives by one method led to.
struct MethodResult {
  std::vector<Slide> slides;
  std::vector<ImpactTrial> impacts;
  Tunnelling front;
  Tunnelling side;

  [[nodiscard]] std::size_t caught(double speed) const;
  [[nodiscard]] double worstLoss() const;  ///< m/s
  [[nodiscard]] std::size_t gained() const;
  [[nodiscard]] double mostEnergy() const;  ///< ratio; 0 without impacts
  /// Impacts that led through, at the subject's speed.
  [[nodiscard]] std::size_t through() const;
};

struct Examination {
  LoadReport load{};
  MeshEdges edges{};
  Walls walls{};
  std::vector<std::string> warnings{};  ///< of the responder
  std::vector<DroppedGroup> dropped{};
  std::vector<SmallFeature> features{};
  std::vector<Place> places{};
  double distance = 0.0;  ///< of walls driven along, m
  NormalCount normals{};
  MethodResult joints{};
  MethodResult bumper{};
};

/// The parts of an examination, in their order.
enum class Stage { mesh, features, places, normals, slides, impacts, tunnelling };

/// Examines a subject at `places` places. Throws Error on an invalid subject or one without walls.
/// ODE has to be initialised. `progress` is called at the beginning of each stage.
Examination examine(const Subject& subject, const LoadReport& load, std::size_t places,
                    const std::function<void(Stage)>& progress = {});

}  // namespace bumper::doctor
