// The converter trusts nothing that an importer hands over, whichever lets it pass.

#include "assimp_converter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "importer_scene.h"

namespace bumper {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

std::unique_ptr<aiScene> fence(const std::vector<unsigned>& face, unsigned copies = 1) {
  return bumper::testing::importedTriangle(face, "fence", copies);
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

TEST(AssimpConverter, StaysWithinTheBudget) {
  const auto scene = fence({0, 1, 2}, 10);
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
