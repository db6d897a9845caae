// assimp 5.2 leaves the axes and the unit of an FBX file to its caller, 5.4 turns and scales the
// root node by them. What is read must be the same. Whichever is installed, both are played here.

#include <assimp/scene.h>
#include <gtest/gtest.h>

#include <array>
#include <assimp/Importer.hpp>
#include <memory>
#include <string>
#include <utility>

#include "assimp_converter.h"
#include "fbx_file.h"
#include "file_conventions.h"
#include "temporary_files.h"

namespace bumper::tests {
namespace {

using Eigen::Vector3d;

class ImporterAxes : public TemporaryFiles {
 protected:
  /// What is read of a file if the importer gives its root node this transform.
  [[nodiscard]] FileScene read(const FbxSettings& settings, const aiMatrix4x4& root) const {
    Assimp::Importer importer;
    const std::filesystem::path file = write("fence.fbx", fbxFile(settings));
    importer.ReadFile(file.string(), 0);
    const std::unique_ptr<aiScene> source(importer.GetOrphanedScene());
    EXPECT_NE(source, nullptr);
    source->mRootNode->mTransformation = root;
    FileScene result;
    result.format = "Autodesk FBX";
    readConventions(file, *source, result);
    convert(file, *source, {}, result, [](LoadStage, double) {});
    return result;
  }
};

/// As assimp 5.4 makes it: side, up and front become x, y and z, in centimetres.
aiMatrix4x4 turnedRoot(const FbxSettings& settings) {
  aiMatrix4x4 root;
  const auto unit = static_cast<float>(settings.unit);
  const std::array axes{std::pair(settings.side, 1), std::pair(settings.up, settings.upSign),
                        std::pair(settings.front, settings.frontSign)};
  for (unsigned row = 0; row < 3; ++row) {
    const auto& [axis, sign] = axes.at(row);
    for (unsigned column = 0; column < 3; ++column) {
      root[row][column] = static_cast<int>(column) == axis ? static_cast<float>(sign) * unit : 0.0F;
    }
  }
  return root;
}

TEST_F(ImporterAxes, MakeNoDifference) {
  const std::array systems{
      FbxSettings{.up = 1, .front = 2, .side = 0},                   // Maya, Blender by default
      FbxSettings{.up = 2, .front = 1, .frontSign = -1, .side = 0},  // 3ds Max, Blender's own axes
      FbxSettings{.up = 0, .front = 2, .frontSign = -1, .side = 1},
      FbxSettings{.up = 2, .front = 2, .side = 0},  // states no front: the root flattens it all
  };
  for (FbxSettings settings : systems) {
    for (const double unit : {1.0, 2.54, 100.0}) {
      settings.unit = unit;
      SCOPED_TRACE("up " + std::to_string(settings.up) + ", unit " + std::to_string(unit));
      for (const FileScene& scene :
           {read(settings, aiMatrix4x4()), read(settings, turnedRoot(settings))}) {
        EXPECT_EQ(scene.up, static_cast<UpAxis>(settings.up));
        EXPECT_NEAR(scene.metresPerUnit, 0.01 * unit, 1e-7);
        ASSERT_EQ(scene.scene.vertices.size(), 3U);
        EXPECT_EQ(scene.scene.vertices[1], Vector3d(300, 0, 0));
        EXPECT_EQ(scene.scene.vertices[2], Vector3d(0, 0, 100));
        EXPECT_EQ(scene.scene.meshes.at(0).name, "fence");
      }
    }
  }
}

TEST_F(ImporterAxes, OfOtherFormatsAreTheRootNodes) {
  // Collada's importer turns the root in every version, and states nothing.
  const std::filesystem::path file = write("fence.fbx", fbxFile({}));
  Assimp::Importer importer;
  importer.ReadFile(file.string(), 0);
  const std::unique_ptr<aiScene> source(importer.GetOrphanedScene());
  source->mRootNode->mTransformation = turnedRoot({.up = 2, .front = 1, .frontSign = -1});
  FileScene result;
  result.format = "Collada";
  readConventions(file, *source, result);
  convert(file, *source, {}, result, [](LoadStage, double) {});
  EXPECT_EQ(result.up, UpAxis::y);
  EXPECT_EQ(result.scene.vertices.at(2), Vector3d(0, 100, 0));
}

}  // namespace
}  // namespace bumper::tests
