// What a file may become: within the budget in proportion to it, beyond an Error that names the
// limit.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "bumper/response/error.h"
#include "bumper/scenes/paper_scenes.h"
#include "bumper/scenes/scene_files.h"
#include "scene_stream.h"
#include "temporary_files.h"

namespace bumper {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class Budget : public TemporaryFiles {
 protected:
  /// One triangle, shown by so many nodes, in a text of so little for each.
  [[nodiscard]] std::filesystem::path copies(unsigned count, const std::string& name = "") const {
    std::string nodes;
    std::string numbers;
    for (unsigned i = 0; i < count; ++i) {
      const std::string comma = i == 0 ? "" : ",";
      nodes += comma;
      nodes += R"({"mesh":0,"name":")" + name + R"(","translation":[)" + std::to_string(3 * i) +
               ",0,0]}";
      numbers += comma;
      numbers += std::to_string(i);
    }
    return write("copies.gltf", R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[)" +
                                    numbers + R"(]}],"nodes":[)" + nodes +
                                    R"(],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[2,1,0]}],
"bufferViews":[{"buffer":0,"byteLength":36}],
"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAAAAQAAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})");
  }

  static void expectLimit(const std::filesystem::path& file, const SceneBudget& budget,
                          const std::string& limit) {
    for (const auto load : {loadTrustedScene, loadScene}) {
      EXPECT_THAT([&] { load(file, {.budget = budget}, nullptr); },
                  ThrowsMessage<Error>(AllOf(HasSubstr(file.string()), HasSubstr(limit))));
    }
  }
};

TEST_F(Budget, NamesTheLimit) {
  const std::filesystem::path file = copies(20, "twelve bytes");
  SceneBudget budget{.triangles = 20, .nodes = 41, .names = 20 * 40, .nameLength = 40};
  EXPECT_EQ(loadScene(file, {.budget = budget}).triangles.size(), 20U);
  EXPECT_EQ(loadTrustedScene(file, {.budget = budget}).triangles.size(), 20U);
  SceneBudget less = budget;
  less.triangles = 19;
  expectLimit(file, less, "SceneBudget::triangles allows 19");
  less = budget;
  less.nodes = 30;
  expectLimit(file, less, "SceneBudget::nodes allows 30");
  less = budget;
  less.names = 100;
  expectLimit(file, less, "SceneBudget::names allows 100");
  less = budget;
  less.nameLength = 11;
  expectLimit(file, less, "SceneBudget::nameLength allows 11");
}

// What the child process answers is within the same limits, whoever wrote it.
TEST_F(Budget, HoldsForTheAnswerToo) {
  FileScene file;
  file.scene = course();
  const std::string answer = pack(file);
  const SceneBudget exact{
      .triangles = std::max(file.scene.triangles.size(), file.scene.vertices.size() / 3),
      .nodes = file.scene.meshes.size()};
  EXPECT_TRUE(unpack(answer, exact).has_value());
  EXPECT_LE(answer.size(), longestAnswer(exact));
  SceneBudget less = exact;
  less.nodes -= 1;
  EXPECT_FALSE(unpack(answer, less).has_value());
  EXPECT_NO_THROW(validate(file.scene, exact));
  less = exact;
  less.triangles -= 1;
  EXPECT_THROW(validate(file.scene, less), Error);
}

TEST_F(Budget, NamesTooLongForAPattern) {
  Scene scene = testRail();
  scene.meshes.front().name = std::string(1000, 'a');
  EXPECT_TRUE(matchingMeshes(scene, "(a|b)*").front());
  scene.meshes.front().name = std::string(60'000, 'a');
  EXPECT_THAT([&] { matchingMeshes(scene, "(a|b)*"); },
              ThrowsMessage<Error>(AllOf(HasSubstr("\"aaaa"), HasSubstr("60000 bytes"))));
  EXPECT_NO_THROW(matchingMeshes(scene, ""));
}

}  // namespace
}  // namespace bumper
