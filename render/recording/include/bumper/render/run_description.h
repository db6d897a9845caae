#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <variant>

#include "bumper/base/api.h"
#include "bumper/scenes/scene.h"

namespace BUMPER_API bumper {

/// What an application states of a run or a vehicle, under names of its own: numbers, in SI units
/// unless the name has another, and words. A number that is not finite counts as unknown.
using RunParameters = std::map<std::string, std::variant<double, std::string>>;

/// Which scene a run took place in: where to find it, and by what to recognise its geometry.
struct SceneReference {
  std::string name{};  ///< Scene::name
  /// The mesh file, in the form in which the application finds it again; empty: none.
  std::string file{};
  std::string up{};    ///< the file's axis that points up: "x", "y", "z"; empty: as the file states
  double scale = 1.0;  ///< LoadOptions::scale, > 0
  /// A scene of paper_scenes.h: "test_rail" or "course", with its default mesh; empty: none.
  std::string builtIn{};
  std::size_t triangles = 0;
  std::uint64_t hash = 0;  ///< contentHash(); 0 together with no triangle: not known
};

/// Name, number of triangles and hash of a scene; where it comes from is left to the caller.
SceneReference referenceTo(const Scene& scene);

/// Whether the reference was made of a scene with the same geometry; true if it has no hash.
bool isSameScene(const SceneReference& reference, const Scene& scene);

/// What a recording file states of the run besides its vehicles.
struct RunDescription {
  SceneReference scene{};
  RunParameters parameters{};  ///< law, step size, whatever else made the run what it was
};

}  // namespace bumper
