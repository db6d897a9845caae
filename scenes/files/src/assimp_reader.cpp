#include "assimp_reader.h"

#include <assimp/BaseImporter.h>
#include <assimp/importerdesc.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <assimp/ProgressHandler.hpp>
#include <map>
#include <memory>
#include <new>
#include <string>

#include "assimp_converter.h"
#include "file_conventions.h"
#include "file_ending.h"
#include "textureless_files.h"

namespace bumper {

namespace {

/// assimp's name of the importer of a format of loadTrustedScene().
std::string ownImporter(const std::filesystem::path& file) {
  static const std::map<std::string, std::string> importers{
      {".obj", "Wavefront Object Importer"},
      {".gltf", "glTF2 Importer"},
      {".glb", "glTF2 Importer"},
      {".stl", "Stereolithography (STL) Importer"},
      {".fbx", "Autodesk FBX Importer"},
      {".3ds", "Discreet 3DS Importer"},
      {".ac", "AC3D Importer"},
      {".acc", "AC3D Importer"},
      {".ac3d", "AC3D Importer"},
  };
  const auto found = importers.find(lowerCaseEnding(file));
  if (found != importers.end()) return found->second;
  throw fileError(file,
                  "is in a format that is not read in this process: allowed are .obj, .gltf, .glb, "
                  ".stl, .fbx, .3ds, .ac, .acc and .ac3d; loadScene() reads any other");
}

/// Leaves a single importer registered: assimp would otherwise try others by the file's content.
void keepOnly(Assimp::Importer& importer, const std::string& name) {
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    if (importer.GetImporterInfo(i)->mName == name) continue;
    const std::unique_ptr<Assimp::BaseImporter> unwanted(importer.GetImporter(i));
    importer.UnregisterLoader(unwanted.get());
  }
}

void requireFile(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) throw fileError(file, "does not exist");
  if (!std::filesystem::is_regular_file(file, error)) throw fileError(file, "is not a file");
  if (std::filesystem::file_size(file, error) == 0) throw fileError(file, "is empty");
}

/// Passes on the progress that assimp reports.
class ReadingProgress : public Assimp::ProgressHandler {
 public:
  explicit ReadingProgress(const Progress& progress) : progress_(progress) {}

  // NOLINTNEXTLINE(google-default-arguments): assimp's
  bool Update(float percentage = -1.0F) override {
    // A half is for the post-processing that is not asked for; unknown is negative.
    const double share = std::clamp(2.0 * static_cast<double>(percentage), share_, 1.0);
    if (share > share_) progress_(LoadStage::reading, share_ = share);
    return true;
  }

 private:
  const Progress& progress_;
  double share_ = 0.0;
};

}  // namespace

FileScene readWithAssimp(const std::filesystem::path& file, Formats formats,
                         const SceneBudget& budget, const Progress& progress) {
  requireFile(file);
  Assimp::Importer importer;
  progress(LoadStage::reading, 0.0);
  importer.SetProgressHandler(std::make_unique<ReadingProgress>(progress).release());  // it owns
  auto ownFiles = std::make_unique<TexturelessFiles>(file);
  const TexturelessFiles& files = *ownFiles;
  importer.SetIOHandler(ownFiles.release());  // likewise
  if (formats == Formats::own) keepOnly(importer, ownImporter(file));
  const aiScene* source = nullptr;
  std::string reason;
  try {
    source = importer.ReadFile(file.string(), 0);
    reason = importer.GetErrorString();
  } catch (const std::exception& error) {
    reason = error.what();
  }
  if (!files.refused().empty()) {
    throw fileError(file, "refers to \"" + files.refused() + "\", which is not in its folder");
  }
  if (source == nullptr) {
    if (reason.find("bad_alloc") != std::string::npos) throw std::bad_alloc();
    throw fileError(file, "cannot be read: " + reason);
  }
  progress(LoadStage::reading, 1.0);
  progress(LoadStage::converting, 0.0);
  FileScene result;
  const int index = importer.GetPropertyInteger("importerIndex", -1);
  if (index >= 0) {
    result.format = importer.GetImporterInfo(static_cast<std::size_t>(index))->mName;
    result.format = result.format.substr(0, result.format.find(" Importer"));
  }
  result.scene.name = file.stem().string();
  readConventions(file, *source, result);
  convert(file, *source, budget, result, progress);
  if (result.scene.triangles.empty()) throw fileError(file, "holds no triangle");
  return result;
}

}  // namespace bumper
