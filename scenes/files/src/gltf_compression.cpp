#include "gltf_compression.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <system_error>
#include <utility>

#include "file_ending.h"

namespace bumper {

namespace {

/// Of a file's text, or of a binary file's beginning, where its text is: bytes.
constexpr std::uintmax_t longestText = std::uintmax_t{64} << 20U;

constexpr std::array compressions{
    std::pair("KHR_draco_mesh_compression", "Draco"),
    std::pair("EXT_meshopt_compression", "meshopt"),
    std::pair("KHR_meshopt_compression", "meshopt"),
};

}  // namespace

std::string compressionNote(const std::filesystem::path& file) {
  const std::string ending = lowerCaseEnding(file);
  if (ending != ".gltf" && ending != ".glb") return "";
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error) return "";
  std::ifstream stream(file, std::ios::binary);
  std::string text(static_cast<std::size_t>(std::min(size, longestText)), '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  for (const auto& [extension, name] : compressions) {
    if (text.find('"' + std::string(extension) + '"') == std::string::npos) continue;
    return std::string("; its meshes are compressed by ") + name + " (" + extension +
           "), which the assimp library that reads them may lack: save it without";
  }
  return "";
}

}  // namespace bumper
