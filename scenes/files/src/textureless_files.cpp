#include "textureless_files.h"

#include <assimp/MemoryIOWrapper.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "file_ending.h"

namespace bumper {

void hideTextures(std::string& collada) {
  for (const std::string name : {"<image", "</image", "<texture", "</texture"}) {
    for (std::size_t at = 0; (at = collada.find(name, at)) != std::string::npos;) {
      at += name.size();
      const bool isWhole =
          at < collada.size() && std::string(" \t\r\n/>").find(collada[at]) != std::string::npos;
      // Of the same length, and none of Collada's own.
      if (isWhole) collada[at - 1] = '_';
    }
  }
}

Assimp::IOStream* TexturelessFiles::Open(const char* file, const char* mode) {
  std::unique_ptr<Assimp::IOStream> stream(FolderFiles::Open(file, mode));
  if (stream != nullptr && lowerCaseEnding(file) == ".dae") {
    std::string text(stream->FileSize(), '\0');
    text.resize(stream->Read(text.data(), 1, text.size()));
    hideTextures(text);
    auto bytes = std::make_unique<std::uint8_t[]>(text.size());
    std::copy(text.begin(), text.end(), bytes.get());
    stream = std::make_unique<Assimp::MemoryIOStream>(bytes.release(), text.size(), true);
  }
  return stream.release();  // the importer frees it
}

}  // namespace bumper
