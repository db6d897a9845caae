// The converter trusts nothing that an importer hands over, whichever lets it pass.

#include "assimp_converter.h"

#include <assimp/mesh.h>
#include <assimp/scene.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace bumper {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// A scene with one mesh, "fence", of three corners and one face.
std::unique_ptr<aiScene> fence(const std::vector<unsigned>& face) {
  // assimp's objects free what they point to.
  auto scene = std::make_unique<aiScene>();
  auto mesh = std::make_unique<aiMesh>();
  mesh->mNumVertices = 3;
  mesh->mVertices = std::make_unique<aiVector3D[]>(3).release();
  mesh->mVertices[1] = {1, 0, 0};
  mesh->mVertices[2] = {0, 0, 1};
  mesh->mNumFaces = 1;
  mesh->mFaces = std::make_unique<aiFace[]>(1).release();
  mesh->mFaces[0].mNumIndices = static_cast<unsigned>(face.size());
  mesh->mFaces[0].mIndices = std::make_unique<unsigned[]>(face.size()).release();
  std::copy(face.begin(), face.end(), mesh->mFaces[0].mIndices);
  scene->mNumMeshes = 1;
  scene->mMeshes = std::make_unique<aiMesh*[]>(1).release();
  scene->mMeshes[0] = mesh.release();
  scene->mRootNode = std::make_unique<aiNode>("root").release();
  auto node = std::make_unique<aiNode>("fence");
  node->mNumMeshes = 1;
  node->mMeshes = std::make_unique<unsigned[]>(1).release();
  aiNode* child = node.release();
  scene->mRootNode->addChildren(1, &child);
  return scene;
}

FileScene converted(const aiScene& source, const SceneBudget& budget = {}) {
  FileScene result;
  convert("yard.ply", source, budget, result, [](LoadStage, double) {});
  return result;
}

void expectError(const aiScene& source, const std::string& what) {
  EXPECT_THAT([&] { converted(source); },
              ThrowsMessage<Error>(
                  AllOf(HasSubstr("yard.ply"), HasSubstr("mesh \"fence\""), HasSubstr(what))));
}

TEST(AssimpConverter, CopiesWhatIsRight) {
  const FileScene result = converted(*fence({0, 1, 2}));
  EXPECT_EQ(result.scene.triangles.size(), 1U);
  EXPECT_EQ(result.scene.meshes.at(0).name, "fence");
  EXPECT_EQ(converted(*fence({0, 1})).pointsAndLines, 1U);
}

/// The same shown by so many nodes.
std::unique_ptr<aiScene> fences(unsigned count) {
  auto scene = fence({0, 1, 2});
  for (unsigned i = 1; i < count; ++i) {
    auto node = std::make_unique<aiNode>("fence");
    node->mNumMeshes = 1;
    node->mMeshes = std::make_unique<unsigned[]>(1).release();
    aiNode* child = node.release();
    scene->mRootNode->addChildren(1, &child);
  }
  return scene;
}

TEST(AssimpConverter, StaysWithinTheBudget) {
  const auto scene = fences(10);
  // A root, ten nodes and ten meshes; ten names of five bytes.
  const SceneBudget enough{.triangles = 10, .nodes = 21, .names = 50};
  EXPECT_EQ(converted(*scene, enough).scene.triangles.size(), 10U);
  const auto expectLimit = [&](SceneBudget budget, const std::string& limit) {
    EXPECT_THAT([&] { converted(*scene, budget); },
                ThrowsMessage<Error>(AllOf(HasSubstr("yard.ply"), HasSubstr(limit))));
  };
  SceneBudget less = enough;
  less.triangles = 9;
  expectLimit(less, "SceneBudget::triangles allows 9");
  less = enough;
  less.nodes = 20;
  expectLimit(less, "SceneBudget::nodes allows 20");
  less = enough;
  less.names = 49;
  expectLimit(less, "SceneBudget::names allows 49");
  // Vertices that no face uses count too.
  const std::unique_ptr<aiVector3D[]> replaced(
      std::exchange(scene->mMeshes[0]->mVertices, nullptr));
  scene->mMeshes[0]->mNumVertices = 1'000'000'000;
  expectLimit(SceneBudget{}, "SceneBudget::triangles allows 5000000");
}

TEST(AssimpConverter, RefusesIndicesOutOfRange) {
  expectError(*fence({0, 1, 9}), "uses vertex 9 of 3");
  expectError(*fence({0, 3}), "uses vertex 3 of 3");
  const auto other = fence({0, 1, 2});
  other->mRootNode->mChildren[0]->mMeshes[0] = 1;
  expectError(*other, "does not exist");
}

TEST(AssimpConverter, RefusesCoordinatesThatAreNotFinite) {
  const auto far = fence({0, 1, 2});
  far->mMeshes[0]->mVertices[2].y = std::numeric_limits<float>::infinity();
  expectError(*far, "not finite, at vertex 2");
  const auto turned = fence({0, 1, 2});
  turned->mRootNode->mTransformation.a1 = std::numeric_limits<float>::quiet_NaN();
  expectError(*turned, "not finite, at vertex 0");
}

}  // namespace
}  // namespace bumper
