// Files that are not what they claim to be: one Error that names the file, nothing left behind.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <string>

#include "bumper/response/error.h"
#include "bumper/scenes/paper_scenes.h"
#include "bumper/scenes/scene_files.h"
#include "left_behind.h"
#include "temporary_files.h"

namespace bumper {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

std::string binaryGarbage(std::size_t size) {
  std::mt19937 random(20033);
  std::uniform_int_distribution<int> byte(0, 255);
  std::string text(size, '\0');
  for (char& c : text) c = static_cast<char>(byte(random));
  return text;
}

std::string contents(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class BrokenFiles : public TemporaryFiles {
 protected:
  /// Loads in a child process and expects an Error that names the file and says all of `what`.
  template <typename... What>
  void expectError(const std::filesystem::path& file, LoadOptions options, What... what) {
    if (!options.up) options.up = UpAxis::z;
    expectErrorOf(loadScene, file, options, what...);
  }

  /// The same in this process.
  template <typename... What>
  void expectErrorHere(const std::filesystem::path& file, What... what) {
    expectErrorOf(loadTrustedScene, file, {.up = UpAxis::z}, what...);
  }

  template <typename... What>
  void expectErrorEitherWay(const std::filesystem::path& file, What... what) {
    expectErrorHere(file, what...);
    expectError(file, {}, what...);
  }

 private:
  using Load = Scene(const std::filesystem::path&, const LoadOptions&, LoadReport*);

  template <typename... What>
  static void expectErrorOf(Load* load, const std::filesystem::path& file,
                            const LoadOptions& options, What... what) {
    SCOPED_TRACE(file.string() + (load == loadScene ? ", isolated" : ", in process"));
    const NothingLeftBehind check;
    EXPECT_THAT([&] { load(file, options, nullptr); },
                ThrowsMessage<Error>(AllOf(HasSubstr(file.string()), HasSubstr(what)...)));
  }
};

TEST_F(BrokenFiles, Missing) { expectErrorEitherWay(path("missing.obj"), "does not exist"); }

TEST_F(BrokenFiles, Empty) { expectErrorEitherWay(write("empty.stl", ""), "is empty"); }

TEST_F(BrokenFiles, Directory) {
  std::filesystem::create_directory(path("directory.obj"));
  expectErrorEitherWay(path("directory.obj"), "is not a file");
}

TEST_F(BrokenFiles, NamesWithSpacesAndDashes) {
  const std::filesystem::path file = write("-a b'\"$x.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n");
  EXPECT_EQ(loadTrustedScene(file, {.up = UpAxis::z}).triangles.size(), 1U);
  EXPECT_EQ(loadScene(file, {.up = UpAxis::z}).triangles.size(), 1U);
}

TEST_F(BrokenFiles, FormatsThatAreOnlyReadInIsolation) {
  const std::filesystem::path file = path("rail.ply");
  saveScene(testRail(), file);
  expectErrorHere(file, ".obj", "loadScene()");
  EXPECT_EQ(loadScene(file, {.up = UpAxis::z}).triangles.size(), 612U);
  // The content does not choose the reader.
  std::filesystem::rename(file, path("rail.xyz"));
  expectErrorHere(path("rail.xyz"), "loadScene()");
  std::filesystem::rename(path("rail.xyz"), path("rail.fbx"));
  expectErrorHere(path("rail.fbx"), "cannot be read");
}

TEST_F(BrokenFiles, Garbage) {
  for (const std::string ending : {"obj", "gltf", "glb", "stl", "fbx", "3ds"}) {
    expectErrorEitherWay(write("garbage." + ending, binaryGarbage(5000)));
  }
  for (const std::string ending : {"ac", "acc", "ply", "off", "dae", "x", "x3d", "blend", "dxf",
                                   "lwo", "3mf", "bsp", "ifc", "unknown"}) {
    expectError(write("garbage." + ending, binaryGarbage(5000)), {});
  }
}

TEST_F(BrokenFiles, CutShort) {
  for (const std::string ending : {"glb", "stl"}) {
    saveScene(testRail(), path("whole." + ending));
    const std::string whole = contents(path("whole." + ending));
    for (const double part : {0.01, 0.5, 0.99}) {
      const auto size = static_cast<std::size_t>(part * static_cast<double>(whole.size()));
      expectErrorEitherWay(write("cut." + ending, whole.substr(0, size)));
    }
  }
}

TEST_F(BrokenFiles, WithoutTriangles) {
  expectErrorEitherWay(write("points.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\n"));
  expectErrorEitherWay(write("line.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\nl 1 2 3\n"), "no triangle");
  expectErrorEitherWay(write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"),
                       "no triangle that has an area");
}

std::string binaryStl(float coordinate) {
  std::string text(80, ' ');
  const std::uint32_t count = 1;
  const std::array<float, 12> numbers{0, 0, 1, 0, 0, 0, 1, 0, 0, 0, coordinate, 0};
  text.resize(84 + 50);
  std::memcpy(text.data() + 80, &count, sizeof count);
  std::memcpy(text.data() + 84, numbers.data(), sizeof numbers);
  text[132] = '\0';
  text[133] = '\0';
  return text;
}

TEST_F(BrokenFiles, CoordinatesThatAreNotFinite) {
  EXPECT_EQ(
      loadTrustedScene(write("fine.stl", binaryStl(1.0F)), {.up = UpAxis::z}).triangles.size(), 1U);
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    expectErrorEitherWay(write("bad.stl", binaryStl(bad)), "mesh \"", "not finite");
  }
  expectErrorEitherWay(write("bad.obj", "o fence\nv 0 0 0\nv nan 0 0\nv 0 0 1\nf 1 2 3\n"),
                       "mesh \"fence\"", "not finite");
}

TEST_F(BrokenFiles, TooLargeForTheScale) {
  expectError(write("far.obj", "v 0 0 0\nv 1e38 0 0\nv 0 0 1e38\nf 1 2 3\n"),
              {.up = UpAxis::z, .scale = 1e300});
}

TEST_F(BrokenFiles, IndicesOutOfRange) {
  expectErrorEitherWay(write("index.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 9\n"));
  expectError(write("index.ply",
                    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                    "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                    "end_header\n0 0 0\n1 0 0\n0 0 1\n3 0 1 9\n"),
              {});
}

// What follows makes assimp 5.2 loop for ever, crash, and ask for more memory than there is;
// another version may say what is wrong.

TEST_F(BrokenFiles, ThatNeverEnd) {
  expectError(write("endless.ply", "ply\nformat ascii 1.0\n"), {.timeout = 0.5});
}

TEST_F(BrokenFiles, ThatCrashTheReader) {
  expectError(write("crash.ply", std::string("ply\nformat binary_\0\0\0", 21)), {},
              "cannot be read");
}

// Also of the formats that are read in this process.
TEST_F(BrokenFiles, ThatAreNestedDeep) {
  std::string text = "; FBX 7.4.0 project file\nFBXHeaderExtension:  {\n}\n";
  for (int i = 0; i < 50'000; ++i) text += "A:  {\n";
  expectError(write("deep.fbx", text), {}, "cannot be read");
}

// A triangle with a picture in the file, of a type that is none; it is not needed.
TEST_F(BrokenFiles, WithAPictureOfNoType) {
  const std::string json =
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],
"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],
"textures":[{"source":0}],"images":[{"mimeType":"x","bufferView":0}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":
"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAAAAQAAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
  const std::filesystem::path file = write("picture.gltf", json);
  const NothingLeftBehind check;
  try {
    EXPECT_EQ(loadScene(file).triangles.size(), 1U);
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr(file.string()));
  }
}

TEST_F(BrokenFiles, ThatNeedTooMuchMemory) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the memory limit is off with the address sanitizer, which maps terabytes";
#endif
  expectError(write("huge.off", "OFF\n400000000 400000000 0\n0 0 0\n"), {});
  // A whole one, of zeros, which takes more room than there is.
  constexpr std::uint32_t triangles = 2'000'000;
  std::string beginning = binaryStl(1.0F);
  std::memcpy(beginning.data() + 80, &triangles, sizeof triangles);
  const std::filesystem::path large = write("large.stl", beginning);
  std::filesystem::resize_file(large, 84 + 50 * std::uintmax_t{triangles});
  expectError(large, {.memoryLimit = std::size_t{128} << 20U}, "LoadOptions::memoryLimit");
}

}  // namespace
}  // namespace bumper
