#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <sstream>
#include <vector>

#include "assimp_reader.h"
#include "bumper/scenes/walls.h"
#include "corners.h"
#include "file_scene.h"
#include "gltf_compression.h"
#include "read_isolated.h"
#include "up_axis.h"
#include "weld.h"

namespace bumper {

namespace {

constexpr std::size_t leastMemory = std::size_t{64} << 20U;

void validate(const LoadOptions& options) {
  if (!(std::isfinite(options.scale) && options.scale > 0.0)) {
    throw Error("LoadOptions::scale is " + std::to_string(options.scale) +
                ": it must be finite and positive");
  }
  if (!(std::isfinite(options.timeout) && options.timeout > 0.0)) {
    throw Error("LoadOptions::timeout is " + std::to_string(options.timeout) +
                " s: it must be finite and positive");
  }
  if (options.memoryLimit < leastMemory) {
    throw Error("LoadOptions::memoryLimit is " + std::to_string(options.memoryLimit) +
                " bytes: at least " + std::to_string(leastMemory) + " are needed");
  }
}

void turn(Scene& scene, UpAxis up, double scale) {
  for (Eigen::Vector3d& vertex : scene.vertices) vertex = scale * turned(vertex, up);
}

/// How many triangles are steep enough for a wall if an axis of the file points up.
std::size_t countSteep(const Scene& scene, UpAxis up) {
  const double limit = WallSelection{}.maxNormalUp;
  return static_cast<std::size_t>(std::count_if(
      scene.triangles.begin(), scene.triangles.end(), [&](const Scene::Triangle& triangle) {
        const Eigen::Vector3d& a = scene.corner(triangle, 0);
        const Eigen::Vector3d normal =
            (scene.corner(triangle, 1) - a).cross(scene.corner(triangle, 2) - a);
        return normal.norm() > 0.0 && std::abs(turned(normal, up).z()) <= limit * normal.norm();
      }));
}

[[noreturn]] void failWithoutUp(const std::filesystem::path& file, const FileScene& read) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& vertex : read.scene.vertices) box.extend(vertex);
  const Eigen::Vector3d extents = box.sizes();
  std::ostringstream what;
  what << "does not state which axis is up (format: " << read.format
       << "): set LoadOptions::up. It extends " << extents.x() << " x " << extents.y() << " x "
       << extents.z() << " (x, y, z); of " << read.scene.triangles.size()
       << " triangles, by their slope, " << countSteep(read.scene, UpAxis::y)
       << " are walls with y up, " << countSteep(read.scene, UpAxis::z) << " with z up";
  throw fileError(file, what.str());
}

/// Joins corners in the same place and leaves out vertices that no triangle uses.
void weldVertices(Scene& scene, LoadReport& report) {
  constexpr std::uint32_t unused = std::numeric_limits<std::uint32_t>::max();
  const std::vector<std::uint32_t> welded = weld(scene.vertices);
  std::vector<std::uint32_t> number(welded.size(), unused);
  std::vector<Eigen::Vector3d> kept;
  for (Scene::Triangle& triangle : scene.triangles) {
    for (std::uint32_t& corner : triangle.corners) {
      const std::uint32_t first = welded[corner];
      if (number[first] == unused) {
        number[first] = static_cast<std::uint32_t>(kept.size());
        kept.push_back(scene.vertices[first]);
      }
      corner = number[first];
    }
  }
  for (std::size_t i = 0; i < welded.size(); ++i) report.weldedVertices += welded[i] != i ? 1 : 0;
  scene.vertices = std::move(kept);
}

void dropDegenerate(Scene& scene, LoadReport& report) {
  report.droppedDegenerate = std::erase_if(scene.triangles, [&](const Scene::Triangle& triangle) {
    return !(thickness(scene.corner(triangle, 0), scene.corner(triangle, 1),
                       scene.corner(triangle, 2)) >= degenerateThickness);
  });
}

void dropDuplicates(Scene& scene, LoadReport& report) {
  TriangleTable seen(scene.triangles.size());
  report.droppedDuplicate = std::erase_if(scene.triangles, [&](const Scene::Triangle& triangle) {
    return !seen.insert(sorted(triangle.corners));
  });
}

/// What `readFile` has read, as a scene.
template <typename ReadFile>
Scene load(const std::filesystem::path& file, const LoadOptions& options, LoadReport* report,
           const ReadFile& readFile) {
  validate(options);
  const Progress progress =
      options.progress ? options.progress : Progress([](LoadStage, double) {});
  FileScene read;
  try {
    read = readFile(progress);
  } catch (const std::bad_alloc&) {
    throw fileError(file, "cannot be read: not enough memory");
  } catch (const Error& error) {
    throw Error(error.what() + compressionNote(file));
  }
  try {
    bumper::validate(read.scene, options.budget);
  } catch (const Error& error) {
    throw fileError(file, std::string("cannot be read: ") + error.what());
  }
  if (!options.up && !read.up) failWithoutUp(file, read);

  LoadReport done;
  done.up = options.up ? *options.up : *read.up;
  done.metresPerUnit = read.metresPerUnit * options.scale;
  done.droppedPointsAndLines = read.pointsAndLines;
  done.droppedEmptyMeshes = read.emptyMeshes;
  turn(read.scene, done.up, done.metresPerUnit);
  progress(LoadStage::converting, 1.0);
  progress(LoadStage::welding, 0.0);
  weldVertices(read.scene, done);
  progress(LoadStage::welding, 1.0);
  progress(LoadStage::dropping, 0.0);
  dropDegenerate(read.scene, done);
  dropDuplicates(read.scene, done);
  progress(LoadStage::dropping, 1.0);
  done.triangles = read.scene.triangles.size();
  if (read.scene.triangles.empty()) throw fileError(file, "holds no triangle that has an area");
  try {
    bumper::validate(read.scene);
  } catch (const Error& error) {
    throw fileError(file, std::string("at this scale: ") + error.what());
  }
  if (const std::string what = upContradiction(read.scene, done.up); !what.empty()) {
    done.warnings.emplace_back(fileError(file, what).what());
  }
  if (report != nullptr) *report = done;
  return std::move(read.scene);
}

}  // namespace

Scene loadScene(const std::filesystem::path& file, const LoadOptions& options, LoadReport* report) {
  return load(file, options, report,
              [&](const Progress& progress) { return readIsolated(file, options, progress); });
}

Scene loadTrustedScene(const std::filesystem::path& file, const LoadOptions& options,
                       LoadReport* report) {
  return load(file, options, report, [&](const Progress& progress) {
    return readWithAssimp(file, Formats::own, options.budget, progress);
  });
}

}  // namespace bumper
