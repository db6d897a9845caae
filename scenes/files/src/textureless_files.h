#pragma once

#include <string>

#include "folder_files.h"

namespace bumper {

/// Makes a Collada file's images, and what refers to them, unknown elements, which readers skip: no
/// scene has textures, and assimp fails on an image without a file's name, as exporters write it
/// for a texture that is missing.
void hideTextures(std::string& collada);

/// A file and those in its folder, Collada files (.dae) without their textures.
class TexturelessFiles : public FolderFiles {
 public:
  using FolderFiles::FolderFiles;

  // NOLINTNEXTLINE(google-default-arguments): assimp's
  Assimp::IOStream* Open(const char* file, const char* mode = "rb") override;
};

}  // namespace bumper
