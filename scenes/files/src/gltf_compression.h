#pragma once

#include <filesystem>
#include <string>

namespace bumper {

/// By what the meshes of a glTF file (.gltf, .glb) are compressed, to be said where it cannot be
/// read: "; its meshes are compressed by Draco (KHR_draco_mesh_compression), …". Empty if by
/// nothing or if the file is another.
std::string compressionNote(const std::filesystem::path& file);

}  // namespace bumper
