// Files whose textures and materials are missing are scenes none the less; meshes that cannot be
// read are not.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <utility>

#include "bumper/response/error.h"
#include "bumper/scenes/scene_files.h"
#include "left_behind.h"
#include "temporary_files.h"

namespace bumper {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;

using MissingParts = TemporaryFiles;

/// A triangle in Collada whose material has a texture. `images` stands where the file's images do,
/// `parameters` in the effect.
std::string collada(const std::string& images, const std::string& parameters) {
  return R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="1" name="meter"/><up_axis>Z_UP</up_axis></asset>)" +
         images + R"(<library_effects><effect id="e"><profile_COMMON>)" + parameters +
         R"(<technique sid="c"><phong><diffuse><texture texture="image-sampler" texcoord="UV"/>
</diffuse></phong></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="m" name="paint"><instance_effect url="#e"/></material>
</library_materials>
<library_geometries><geometry id="g" name="fence"><mesh>
<source id="p"><float_array id="a" count="9">0 0 0 3 0 0 0 0 1</float_array>
<technique_common><accessor source="#a" count="3" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1" material="paint"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p>
</triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n" name="n"><instance_geometry url="#g">
<bind_material><technique_common><instance_material symbol="paint" target="#m"/></technique_common>
</bind_material></instance_geometry></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

std::string sampler(const std::string& image) {
  return R"(<newparam sid="image-surface"><surface type="2D"><init_from>)" + image +
         R"(</init_from></surface></newparam><newparam sid="image-sampler"><sampler2D>
<source>image-surface</source></sampler2D></newparam>)";
}

TEST_F(MissingParts, OfColladaFilesMayBeTextures) {
  const auto expectLoads = [&](const std::string& images, const std::string& parameters) {
    SCOPED_TRACE(images + parameters);
    const std::filesystem::path file = write("fence.dae", collada(images, parameters));
    Scene scene;
    ASSERT_NO_THROW(scene = loadScene(file));
    EXPECT_EQ(scene.triangles.size(), 1U);
    EXPECT_EQ(scene.meshes.at(0).material, "paint");
  };
  const auto image = [](const std::string& content) {
    return "<library_images><image id=\"image\" name=\"image\">" + content +
           "</image></library_images>";
  };
  const std::string parameters = sampler("image");
  expectLoads(image("<init_from>not_there.png</init_from>"), parameters);
  // assimp 5.2 crashes on the first four, and calls the next three an invalid texture.
  expectLoads(image("<init_from></init_from>"), parameters);
  expectLoads(image("<init_from/>"), parameters);
  expectLoads(image("<init_from> \n</init_from>"), parameters);
  expectLoads(image("<init_from><ref>not_there.png</ref></init_from>"), parameters);
  expectLoads(image(""), parameters);
  expectLoads(image("<data format=\"png\"></data>"), parameters);
  expectLoads("<library_images><image id=\"image\"/></library_images>", parameters);
  expectLoads("<library_images/>", parameters);
  expectLoads("", parameters);
  expectLoads("", "");
  expectLoads("", sampler(""));
  expectLoads("", "<image id=\"image\"><init_from/></image>" + parameters);
  // It samples itself, for ever.
  expectLoads(
      image("<init_from>not_there.png</init_from>"),
      "<newparam sid=\"image-sampler\"><sampler2D><source>image-sampler</source></sampler2D>"
      "</newparam>");
}

TEST_F(MissingParts, OfColladaFilesMayBeMaterials) {
  const std::string whole = collada("", sampler("image"));
  const auto without = [&](const std::string& from, const std::string& to) {
    const std::size_t begin = whole.find(from);
    const std::size_t end = whole.find(to, begin) + to.size();
    return whole.substr(0, begin) + whole.substr(end);
  };
  for (const std::string& text : {without("<library_effects>", "</library_effects>"),
                                  without("<library_materials>", "</library_materials>"),
                                  without("<bind_material>", "</bind_material>")}) {
    EXPECT_EQ(loadScene(write("fence.dae", text)).triangles.size(), 1U);
  }
}

TEST_F(MissingParts, OfOtherFormatsMayBeTexturesAndMaterials) {
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 0 1\n";
  static_cast<void>(
      write("without_picture.mtl", "newmtl paint\nKd 1 0 0\nmap_Kd not_there.png\nmap_Bump\n"));
  for (const std::string head : {"mtllib not_there.mtl\n", "mtllib without_picture.mtl\n", ""}) {
    for (const std::string material : {"paint", "other", ""}) {
      const auto file = write("fence.obj", head + corners + "usemtl " + material + "\nf 1 2 3\n");
      EXPECT_EQ(loadTrustedScene(file, {.up = UpAxis::z}).triangles.size(), 1U) << head << material;
    }
  }
}

/// A triangle in glTF, its mesh with an attribute more than the corners, and something at the end.
std::string gltf(const std::string& primitive, const std::string& end) {
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
"nodes": [{"name": "fence", "mesh": 0}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}, )" +
         primitive + R"(}]}], "accessors": [)" + end + "}";
}

const std::string plainGltf =
    gltf(R"("material": 0)",
         R"({"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
 "min": [0, 0, 0], "max": [2, 1, 0]}],
"materials": [{"name": "paint", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
"textures": [{"source": 0}], "images": [{"uri": "not_there.png"}],
"bufferViews": [{"buffer": 0, "byteLength": 36}],
"buffers": [{"byteLength": 36,
 "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAAAAQAAAAAAAAAAAAAAAAAAAgD8AAAAA"}])");

TEST_F(MissingParts, OfGltfFilesMayBePictures) {
  EXPECT_EQ(loadTrustedScene(write("fence.gltf", plainGltf)).meshes.at(0).material, "paint");
}

std::string compressed(const std::string& extension, const std::string& lists) {
  return gltf(
      "\"extensions\": {\"" + extension + R"(": {"bufferView": 0, "attributes": {"POSITION": 0}}})",
      R"({"componentType": 5126, "count": 3, "type": "VEC3",
 "min": [0, 0, 0], "max": [2, 1, 0]}],
"bufferViews": [{"buffer": 0, "byteLength": 3}],
"buffers": [{"byteLength": 3, "uri": "data:application/octet-stream;base64,AAAA"}], )" +
          lists);
}

/// The text as the only part of a binary file.
std::string asGlb(std::string text) {
  while (text.size() % 4 != 0) text += ' ';
  const auto number = [](std::size_t value) {
    std::string bytes;
    for (unsigned shift = 0; shift < 32; shift += 8) {
      bytes += static_cast<char>((value >> shift) & 0xFFU);
    }
    return bytes;
  };
  return "glTF" + number(2) + number(20 + text.size()) + number(text.size()) + "JSON" + text;
}

TEST_F(MissingParts, CompressedMeshesThatCannotBeReadAreNamed) {
  const auto expectNamed = [&](const std::filesystem::path& file, const std::string& name,
                               const std::string& extension) {
    for (const auto load : {loadTrustedScene, loadScene}) {
      const NothingLeftBehind check;
      EXPECT_THAT(
          [&] { load(file, {}, nullptr); },
          ThrowsMessage<Error>(AllOf(HasSubstr(file.string()),
                                     HasSubstr("compressed by " + name + " (" + extension))));
    }
  };
  for (const auto& [extension, name] : {std::pair("KHR_draco_mesh_compression", "Draco"),
                                        std::pair("EXT_meshopt_compression", "meshopt")}) {
    const std::string list = std::string("[\"") + extension + "\"]";
    for (const std::string& lists :
         {"\"extensionsUsed\": " + list,
          "\"extensionsUsed\": " + list + ", \"extensionsRequired\": " + list}) {
      const std::string text = compressed(extension, lists);
      expectNamed(write("fence.gltf", text), name, extension);
      expectNamed(write("fence.glb", asGlb(text)), name, extension);
    }
  }
  // What is not compressed has another fault.
  EXPECT_THAT([&] { loadTrustedScene(write("broken.gltf", plainGltf.substr(0, 400))); },
              ThrowsMessage<Error>(Not(HasSubstr("compressed"))));
}

}  // namespace
}  // namespace bumper
