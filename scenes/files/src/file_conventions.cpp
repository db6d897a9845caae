#include "file_conventions.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

namespace bumper {

namespace {

bool isFbx(const std::string& format) { return format.find("FBX") != std::string::npos; }

/// FBX keeps its axes and unit beside the geometry, and assimp leaves them there.
void readFbxConventions(const std::filesystem::path& file, const aiMetadata& metadata,
                        FileScene& result) {
  std::int32_t axis = 1;
  std::int32_t sign = 1;
  if (metadata.Get("UpAxis", axis)) {
    if (axis < 0 || axis > 2) throw fileError(file, "states an up axis that does not exist");
    result.up = std::array{UpAxis::x, UpAxis::y, UpAxis::z}.at(static_cast<std::size_t>(axis));
  }
  if (metadata.Get("UpAxisSign", sign) && sign < 0) {
    throw fileError(file, "has its up axis pointing down, which is not supported");
  }
  float centimetres = 1.0F;
  double centimetresDouble = 1.0;
  if (metadata.Get("UnitScaleFactor", centimetresDouble)) {
    result.metresPerUnit = 0.01 * centimetresDouble;
  } else if (metadata.Get("UnitScaleFactor", centimetres)) {
    result.metresPerUnit = 0.01 * static_cast<double>(centimetres);
  }
  if (!(result.metresPerUnit > 0.0 && std::isfinite(result.metresPerUnit))) {
    throw fileError(file, "states a unit that is not a positive length");
  }
}

}  // namespace

void readConventions(const std::filesystem::path& file, const aiScene& source, FileScene& result) {
  // By their standards; assimp turns Collada's axes and unit into these.
  if (result.format.starts_with("glTF") || result.format.starts_with("Collada")) {
    result.up = UpAxis::y;
  } else if (isFbx(result.format) && source.mMetaData != nullptr) {
    readFbxConventions(file, *source.mMetaData, result);
  }
}

// A file's own nodes are all below: assimp makes the root.
bool rootIsImporters(const std::string& format) { return isFbx(format); }

}  // namespace bumper
