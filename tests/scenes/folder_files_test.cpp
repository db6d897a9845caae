// A scene file may refer to other files: those in its folder, and no others.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "bumper/response/error.h"
#include "bumper/scenes/scene_files.h"
#include "temporary_files.h"

namespace bumper {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class FolderFiles : public TemporaryFiles {
 protected:
  FolderFiles() {
    std::filesystem::create_directories(path("inside/deeper"));
    // A triangle, 36 bytes.
    const std::string floats(
        "\0\0\0\0\0\0\0\0\0\0\0\0\0\0\x80\x3f\0\0\0\0\0\0\0\0\0\0\0\0\0\0\x80\x3f\0\0\0\0", 36);
    for (const std::string place :
         {"outside.bin", "inside/beside.bin", "inside/deeper/below.bin"}) {
      static_cast<void>(write(place, floats));
    }
  }

  /// A glTF in the folder whose corners are in another file.
  [[nodiscard]] std::filesystem::path sceneOf(const std::string& reference) const {
    return write(
        "inside/scene.gltf",
        R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":")" +
            reference + "\"}]}");
  }

  void expectRefused(const std::string& reference) const {
    SCOPED_TRACE(reference);
    const std::filesystem::path file = sceneOf(reference);
    for (const auto load : {loadTrustedScene, loadScene}) {
      EXPECT_THAT(
          [&] { load(file, {}, nullptr); },
          ThrowsMessage<Error>(AllOf(HasSubstr(file.string()), HasSubstr("is not in its folder"))));
    }
  }
};

TEST_F(FolderFiles, ThoseBesideAndBelowAreRead) {
  for (const auto load : {loadTrustedScene, loadScene}) {
    for (const std::string reference :
         {"beside.bin", "./deeper/../beside.bin", "deeper/below.bin"}) {
      EXPECT_EQ(load(sceneOf(reference), {}, nullptr).triangles.size(), 1U) << reference;
    }
  }
}

TEST_F(FolderFiles, ThoseElsewhereAreRefused) {
  expectRefused("../outside.bin");
  expectRefused("deeper/../../outside.bin");
  expectRefused("../../../../../../../../etc/passwd");
  std::filesystem::create_directory(path("inside-too"));
  static_cast<void>(write("inside-too/x.bin", std::string(36, '\0')));
  expectRefused("../inside-too/x.bin");
}

TEST_F(FolderFiles, LinksDoNotLeadOutOfIt) {
  std::filesystem::create_symlink(path("outside.bin"), path("inside/link.bin"));
  expectRefused("link.bin");
  std::filesystem::create_symlink("beside.bin", path("inside/near.bin"));
  EXPECT_EQ(loadScene(sceneOf("near.bin")).triangles.size(), 1U);
}

// The file itself may be a link, and the way to it.
TEST_F(FolderFiles, AFileIsReadWhereverItIs) {
  std::filesystem::rename(sceneOf("beside.bin"), path("real.gltf"));
  std::filesystem::create_symlink(path("real.gltf"), path("inside/scene.gltf"));
  std::filesystem::create_directory_symlink(path("inside"), path("way"));
  for (const auto load : {loadTrustedScene, loadScene}) {
    EXPECT_EQ(load(path("inside/scene.gltf"), {}, nullptr).triangles.size(), 1U);
    EXPECT_EQ(load(path("way/scene.gltf"), {}, nullptr).triangles.size(), 1U);
  }
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(path("inside"));
  for (const auto load : {loadTrustedScene, loadScene}) {
    EXPECT_EQ(load("scene.gltf", {}, nullptr).triangles.size(), 1U);
  }
  std::filesystem::current_path(before);
}

}  // namespace
}  // namespace bumper
