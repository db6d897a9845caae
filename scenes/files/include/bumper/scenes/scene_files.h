#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bumper/scenes/scene.h"

namespace bumper {

/// The axis of a file that points up. A scene's own is always z.
enum class UpAxis { x, y, z };

/// What loadScene() does, in this order.
enum class LoadStage {
  reading,     ///< the file's format is read
  converting,  ///< polygons are cut into triangles, axes and unit turned into the scene's
  welding,     ///< corners in the same place are joined
  dropping     ///< degenerate and duplicate triangles are dropped
};

/// How to read a scene file.
struct LoadOptions {
  /// Needed for formats that state none (OBJ, STL, PLY, AC3D, 3DS, most others). glTF and Collada
  /// are y-up by their standard, FBX states it in the file; a value given here overrides theirs.
  std::optional<UpAxis> up = std::nullopt;

  /// Multiplies all lengths, after the unit that the file states (FBX, Collada) was turned into
  /// metres; > 0. A file that states no unit is taken to be in metres.
  double scale = 1.0;

  /// Reads the file in a child process, so that nothing a broken or hostile file does to the reader
  /// affects the caller: for untrusted files. Any format that assimp supports. The child process
  /// runs the program bumper-read-scene: the one that the environment variable BUMPER_READ_SCENE
  /// names, or else the one beside the running program, in the installation that this or the
  /// library belongs to, or where bumper was configured to be installed.
  ///
  /// Without it, the formats whose readers withstand broken files are read: OBJ, glTF 2 and GLB,
  /// STL, FBX, 3DS; and AC3D, whose reader does not: a broken AC3D file ends the process.
  bool isolate = false;

  double timeout = 10.0;                               ///< s, > 0; for reading in isolation
  std::size_t memoryLimit = std::size_t{2048} << 20U;  ///< bytes, from 64 MiB; likewise

  /// Reports progress: the stage and the share of it that is done, in [0, 1], which does
  /// not decrease within a stage. Called in the thread that calls loadScene(), at the beginning and
  /// end of each stage and whenever the format's reader reports progress; in isolation every 0.1 s
  /// while the file is read, with a share of 0. Must not throw.
  std::function<void(LoadStage stage, double share)> progress{};
};

/// What was made of a file.
struct LoadReport {
  std::size_t triangles = 0;              ///< in the scene, after everything below was dropped
  std::size_t weldedVertices = 0;         ///< joined with one in the same place, to 0.01 mm
  std::size_t droppedDegenerate = 0;      ///< triangles thinner than a micrometre
  std::size_t droppedDuplicate = 0;       ///< the same three corners as before, either winding
  std::size_t droppedPointsAndLines = 0;  ///< faces of one or two corners
  std::size_t droppedEmptyMeshes = 0;     ///< without vertices or faces
  UpAxis up = UpAxis::z;                  ///< the file's, as it was taken
  double metresPerUnit = 1.0;             ///< the file's unit times LoadOptions::scale
  /// What is doubtful, each naming the file: an up axis, stated by the file or given, that the
  /// ground and the walls contradict.
  std::vector<std::string> warnings{};
};

/// Reads a mesh file. Node transforms are applied, polygons cut into triangles, corners welded,
/// degenerate and duplicate triangles dropped. Mesh names are those of the file's nodes.
///
/// Throws Error, naming the file, if it cannot be read, holds no triangle, has an index out of
/// range or a coordinate that is not finite (with the mesh's name), does not state which axis is up
/// while `options` does not either (with extents and, for y and for z up, how many triangles are
/// walls by their slope), or, in isolation, makes the reader crash, take too long or need too much
/// memory.
Scene loadScene(const std::filesystem::path& file, const LoadOptions& options = {},
                LoadReport* report = nullptr);

/// Writes a scene as .obj (with its .mtl beside), .stl or .ply (binary), or .glb, by the file's
/// ending; single precision. OBJ, STL and PLY are written z-up but cannot state it: load them with
/// `up = UpAxis::z`. GLB is y-up, as its standard demands. Names, materials and colours are kept by
/// OBJ and GLB. Throws Error, naming the file, on an invalid scene, another ending, or a file that
/// cannot be written.
void saveScene(const Scene& scene, const std::filesystem::path& file);

}  // namespace bumper
