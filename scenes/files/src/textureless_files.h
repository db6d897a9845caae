#pragma once

#include <assimp/DefaultIOSystem.h>

#include <string>

namespace bumper {

/// Makes a Collada file's images, and what refers to them, unknown elements, which readers skip: no
/// scene has textures, and assimp fails on an image without a file's name, as exporters write it
/// for a texture that is missing.
void hideTextures(std::string& collada);

/// The files of the disk, Collada files (.dae) without their textures.
class TexturelessFiles : public Assimp::DefaultIOSystem {
 public:
  // NOLINTNEXTLINE(google-default-arguments): assimp's
  Assimp::IOStream* Open(const char* file, const char* mode = "rb") override;
};

}  // namespace bumper
