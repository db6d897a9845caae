#include "assimp_reader.h"

#include <assimp/BaseImporter.h>
#include <assimp/importerdesc.h>
#include <assimp/scene.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <assimp/ProgressHandler.hpp>
#include <cctype>
#include <limits>
#include <map>
#include <memory>
#include <new>
#include <string_view>
#include <utility>
#include <vector>

#include "triangulate.h"

namespace bumper {

namespace {

std::string lowerCaseEnding(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

/// assimp's name of the importer that may read the file in this process.
std::string safeImporter(const std::filesystem::path& file) {
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
                  ".stl, .fbx, .3ds, .ac, .acc and .ac3d; set LoadOptions::isolate for any other");
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

/// Hands on what assimp says of its reading.
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

using Transform = Eigen::Matrix4d;

Transform toDouble(const aiMatrix4x4& m) {
  Eigen::Matrix4f transform;
  transform << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1, m.d2,
      m.d3, m.d4;
  return transform.cast<double>();
}

/// Copies what assimp read into plain arrays, trusting none of it.
class Converter {
 public:
  Converter(std::filesystem::path file, const aiScene& source, FileScene& result,
            const Progress& progress)
      : file_(std::move(file)), source_(source), result_(result), progress_(progress) {}

  void convert() {
    struct Visit {
      const aiNode* node;
      Transform transform;
    };
    std::vector<Visit> open;
    if (source_.mRootNode != nullptr) {
      open.push_back({source_.mRootNode, toDouble(source_.mRootNode->mTransformation)});
    }
    while (!open.empty()) {
      const auto [node, transform] = open.back();
      open.pop_back();
      for (unsigned i = 0; i < node->mNumMeshes; ++i) {
        addMesh(*node, node->mMeshes[i], transform);
      }
      for (unsigned i = node->mNumChildren; i-- > 0;) {
        const aiNode* child = node->mChildren[i];
        open.push_back({child, transform * toDouble(child->mTransformation)});
      }
    }
  }

 private:
  [[noreturn]] void fail(const std::string& name, const std::string& what) const {
    throw fileError(file_, "is broken: mesh \"" + name + "\" " + what);
  }

  void tellProgress() {
    ++visited_;
    // A file may show a mesh many times.
    const double share = static_cast<double>(visited_) / (source_.mNumMeshes + 1.0);
    if (share < 1.0 && visited_ % 16 == 0) progress_(LoadStage::converting, share);
  }

  void addMesh(const aiNode& node, unsigned index, const Transform& transform) {
    const std::string nodeName = node.mName.C_Str();
    tellProgress();
    if (index >= source_.mNumMeshes) fail(nodeName, "does not exist");
    const aiMesh& mesh = *source_.mMeshes[index];
    if (mesh.mNumVertices == 0 || mesh.mNumFaces == 0 || !mesh.HasPositions() || !mesh.HasFaces()) {
      ++result_.emptyMeshes;
      return;
    }
    SceneMesh part;
    // The root's name is the file's, or assimp's own; the nodes' are the author's.
    part.name = &node == source_.mRootNode ? mesh.mName.C_Str() : nodeName;
    if (part.name.empty()) part.name = result_.scene.name;
    readMaterial(mesh, part);
    result_.scene.meshes.push_back(part);
    addVertices(mesh, part.name, transform);
    addFaces(mesh, part.name, transform.topLeftCorner<3, 3>().determinant() < 0.0);
  }

  void readMaterial(const aiMesh& mesh, SceneMesh& part) const {
    if (mesh.mMaterialIndex >= source_.mNumMaterials) return;
    const aiMaterial& material = *source_.mMaterials[mesh.mMaterialIndex];
    aiString name;
    if (material.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS) part.material = name.C_Str();
    aiColor3D colour;
    if (material.Get(AI_MATKEY_COLOR_DIFFUSE, colour) != aiReturn_SUCCESS) return;
    const Eigen::Vector3f rgb(colour.r, colour.g, colour.b);
    if (rgb.allFinite()) part.colour = rgb.cwiseMax(0.0F).cwiseMin(1.0F);
  }

  void addVertices(const aiMesh& mesh, const std::string& name, const Transform& transform) {
    std::vector<Eigen::Vector3d>& vertices = result_.scene.vertices;
    firstVertex_ = static_cast<std::uint32_t>(vertices.size());
    if (mesh.mNumVertices >= std::numeric_limits<std::uint32_t>::max() - vertices.size()) {
      fail(name, "brings the file above 4,294,967,294 vertices");
    }
    vertices.reserve(vertices.size() + mesh.mNumVertices);
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      const aiVector3D& v = mesh.mVertices[i];
      const Eigen::Vector3d place = Eigen::Vector3f(v.x, v.y, v.z).cast<double>();
      vertices.emplace_back((transform * place.homogeneous()).head<3>());
      if (!vertices.back().allFinite()) {
        fail(name, "has a coordinate that is not finite, at vertex " + std::to_string(i));
      }
    }
  }

  void addFaces(const aiMesh& mesh, const std::string& name, bool mirrored) {
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
      const aiFace& face = mesh.mFaces[i];
      for (unsigned k = 0; k < face.mNumIndices; ++k) {
        if (face.mIndices[k] < mesh.mNumVertices) continue;
        fail(name, "uses vertex " + std::to_string(face.mIndices[k]) + " of " +
                       std::to_string(mesh.mNumVertices));
      }
      if (face.mNumIndices < 3) {
        ++result_.pointsAndLines;
      } else {
        addPolygon(face, name, mirrored);
      }
    }
  }

  void addPolygon(const aiFace& face, const std::string& name, bool mirrored) {
    polygon_.clear();
    for (unsigned k = 0; k < face.mNumIndices; ++k) {
      polygon_.push_back(result_.scene.vertices[firstVertex_ + face.mIndices[k]]);
    }
    if (!triangulate(polygon_, cut_)) {
      fail(name, "has a polygon of " + std::to_string(face.mNumIndices) +
                     " corners that is not convex: at most " + std::to_string(maxConcaveCorners) +
                     " are allowed");
    }
    const auto part = static_cast<std::uint32_t>(result_.scene.meshes.size() - 1);
    for (const std::array<std::size_t, 3>& piece : cut_) {
      Scene::Triangle triangle;
      triangle.mesh = part;
      for (std::size_t k = 0; k < 3; ++k) {
        triangle.corners.at(k) = firstVertex_ + face.mIndices[piece.at(k)];
      }
      if (mirrored) std::swap(triangle.corners[1], triangle.corners[2]);
      result_.scene.triangles.push_back(triangle);
    }
  }

  std::filesystem::path file_;
  const aiScene& source_;
  FileScene& result_;
  const Progress& progress_;
  std::size_t visited_ = 0;        ///< meshes
  std::uint32_t firstVertex_ = 0;  ///< of the mesh at hand
  std::vector<Eigen::Vector3d> polygon_;
  std::vector<std::array<std::size_t, 3>> cut_;
};

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

void readConventions(const std::filesystem::path& file, const aiScene& source, FileScene& result) {
  // By their standards; assimp turns Collada's axes and unit into these.
  if (result.format.starts_with("glTF") || result.format.starts_with("Collada")) {
    result.up = UpAxis::y;
  } else if (result.format.find("FBX") != std::string::npos && source.mMetaData != nullptr) {
    readFbxConventions(file, *source.mMetaData, result);
  }
}

}  // namespace

FileScene readWithAssimp(const std::filesystem::path& file, Formats formats,
                         const Progress& progress) {
  requireFile(file);
  Assimp::Importer importer;
  progress(LoadStage::reading, 0.0);
  importer.SetProgressHandler(std::make_unique<ReadingProgress>(progress).release());  // it owns
  if (formats == Formats::safe) keepOnly(importer, safeImporter(file));
  const aiScene* source = nullptr;
  std::string reason;
  try {
    source = importer.ReadFile(file.string(), 0);
    reason = importer.GetErrorString();
  } catch (const std::exception& error) {
    reason = error.what();
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
  Converter(file, *source, result, progress).convert();
  if (result.scene.triangles.empty()) throw fileError(file, "holds no triangle");
  return result;
}

}  // namespace bumper
