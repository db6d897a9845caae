#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bumper/base/api.h"
#include "bumper/scenes/scene.h"
#include "bumper/scenes/scene_budget.h"

namespace BUMPER_API bumper {

/// The axis of a file that points up. A scene's own is always z.
enum class UpAxis { x, y, z };

/// What loading does, in this order.
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

  /// How much of the file becomes a scene.
  SceneBudget budget{};

  double timeout = 10.0;                               ///< s, > 0; of loadScene()
  std::size_t memoryLimit = std::size_t{2048} << 20U;  ///< bytes, from 64 MiB; likewise

  /// Reports progress: the stage and the share of it that is done, in [0, 1], which does
  /// not decrease within a stage. Called in the calling thread at the beginning and end of each
  /// stage; by loadScene() every 0.1 s while the file is read, with a share of 0, by
  /// loadTrustedScene() whenever the format's reader reports progress. Must not throw.
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

// Two functions, not an option with a default: which process reads a file decides what a broken one
// can do, and the name says so wherever one is called. The short one is for any file.

/// Reads a mesh file of any format that assimp supports, trusted or not: a child process does, so
/// that nothing a broken or hostile file does to the reader affects the caller. Node transforms are
/// applied, polygons cut into triangles, corners welded, degenerate and duplicate triangles
/// dropped. Mesh names are those of the file's nodes.
///
/// The child process runs the program bumper-read-scene: the one that the environment variable
/// BUMPER_READ_SCENE names, or else the one beside the running program, in the installation that
/// this or the library belongs to, or where bumper was configured to be installed.
///
/// It is ended after `timeout` and given no more memory than `memoryLimit`. Even if a file takes it
/// over, it can gain no privileges, write no file and dump no core; unless it is root's, start no
/// process. Where the kernel has Landlock (Linux 5.13), it can moreover open nothing but the file
/// and, to read, what is in the file's folder, and execute nothing; from Linux 6.7 on connect to no
/// TCP port, from 6.12 on signal no other process. It is not kept from other kinds of sockets nor
/// from the kernel's other calls, and is no virtual machine. What it answers is limited by
/// `budget`, and checked as the file itself would be.
///
/// Throws Error, naming the file, if it cannot be read, holds no triangle or more than `budget`
/// allows, has an index out of range or a coordinate that is not finite (with the mesh's name),
/// refers to a file outside its folder, does not state which axis is up while `options` does not
/// either (with extents and, for y and for z up, how many triangles are walls by their slope), or
/// makes the reader crash, take too long or need too much memory.
Scene loadScene(const std::filesystem::path& file, const LoadOptions& options = {},
                LoadReport* report = nullptr);

/// The same in this process, and only OBJ, glTF 2 and GLB, STL, FBX, 3DS and AC3D: for files that
/// one ships oneself, where no child process can be started. Throws Error as loadScene() does where
/// assimp notices that something is wrong. Where it does not, the process ends, hangs, or runs out
/// of memory or stack. No format is safe; with assimp 5.2 are known
///   - GLB: an image in a bufferView whose mimeType has no "/" (reads out of bounds);
///   - FBX: elements nested some ten thousand deep (stack);
///   - AC3D: some broken files.
/// Of 6,600 files broken at random 25 ended the process, and 2 hung it.
Scene loadTrustedScene(const std::filesystem::path& file, const LoadOptions& options = {},
                       LoadReport* report = nullptr);

/// Writes a scene as .obj (with its .mtl beside), .stl or .ply (binary), or .glb, by the file's
/// ending; single precision. OBJ, STL and PLY are written z-up but cannot state it: load them with
/// `up = UpAxis::z`. GLB is y-up, as its standard demands. Names, materials and colours are kept by
/// OBJ and GLB. Throws Error, naming the file, on an invalid scene, another ending, or a file that
/// cannot be written.
void saveScene(const Scene& scene, const std::filesystem::path& file);

}  // namespace bumper
