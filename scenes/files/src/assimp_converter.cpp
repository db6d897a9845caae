#include "assimp_converter.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "file_conventions.h"
#include "triangulate.h"

namespace bumper {

namespace {

using Transform = Eigen::Matrix4d;

Transform toDouble(const aiMatrix4x4& m) {
  Eigen::Matrix4f transform;
  transform << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1, m.d2,
      m.d3, m.d4;
  return transform.cast<double>();
}

/// How much an assimp scene would become.
class Cost {
 public:
  Cost(const std::filesystem::path& file, const aiScene& source, const SceneBudget& budget)
      : file_(file), source_(source), budget_(budget), trianglesOf_(source.mNumMeshes) {
    for (unsigned i = 0; i < source.mNumMeshes; ++i) {
      const aiMesh& mesh = *source.mMeshes[i];
      for (unsigned k = 0; k < mesh.mNumFaces; ++k) {
        trianglesOf_[i] += std::max(mesh.mFaces[k].mNumIndices, 2U) - 2;
      }
    }
  }

  void addNode(const aiNode& node) {
    ++nodes_;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      if (node.mMeshes[i] < source_.mNumMeshes) addMesh(node, node.mMeshes[i]);
    }
    require(nodes_, budget_.nodes, "nodes and meshes in them", "nodes");
  }

 private:
  void addMesh(const aiNode& node, unsigned index) {
    const aiMesh& mesh = *source_.mMeshes[index];
    ++nodes_;
    triangles_ += trianglesOf_[index];
    vertices_ += mesh.mNumVertices;
    names_ += std::max(node.mName.length, mesh.mName.length);
    if (mesh.mMaterialIndex < source_.mNumMaterials) {
      names_ += source_.mMaterials[mesh.mMaterialIndex]->GetName().length;
    }
    require(triangles_, budget_.triangles, "triangles, each copy of a mesh counted,", "triangles");
    require(vertices_ / 3, budget_.triangles, "times three vertices, each copy counted,",
            "triangles");
    require(names_, budget_.names, "bytes of names", "names");
  }

  void require(std::uint64_t actual, std::size_t most, const char* what, const char* limit) const {
    if (actual <= most) return;
    throw fileError(file_, "holds " + std::to_string(actual) + " or more " + what +
                               " but SceneBudget::" + limit + " allows " + std::to_string(most));
  }

  const std::filesystem::path& file_;
  const aiScene& source_;
  const SceneBudget& budget_;
  std::vector<std::uint64_t> trianglesOf_;  // by mesh
  std::uint64_t nodes_ = 0;
  std::uint64_t triangles_ = 0;
  std::uint64_t vertices_ = 0;
  std::uint64_t names_ = 0;
};

void requireBudget(const std::filesystem::path& file, const aiScene& source,
                   const SceneBudget& budget) {
  Cost cost(file, source, budget);
  std::vector<const aiNode*> open;
  if (source.mRootNode != nullptr) open.push_back(source.mRootNode);
  while (!open.empty()) {
    const aiNode* node = open.back();
    open.pop_back();
    cost.addNode(*node);
    open.insert(open.end(), node->mChildren, node->mChildren + node->mNumChildren);
  }
}

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
    if (const aiNode* root = source_.mRootNode; root != nullptr) {
      open.push_back({root, rootIsImporters(result_.format) ? Transform(Transform::Identity())
                                                            : toDouble(root->mTransformation)});
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

  void reportProgress() {
    ++visited_;
    // A file may show a mesh many times.
    const double share = static_cast<double>(visited_) / (source_.mNumMeshes + 1.0);
    if (share < 1.0 && visited_ % 16 == 0) progress_(LoadStage::converting, share);
  }

  void addMesh(const aiNode& node, unsigned index, const Transform& transform) {
    const std::string nodeName = node.mName.C_Str();
    reportProgress();
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

}  // namespace

void convert(const std::filesystem::path& file, const aiScene& source, const SceneBudget& budget,
             FileScene& result, const Progress& progress) {
  requireBudget(file, source, budget);
  Converter(file, source, result, progress).convert();
}

}  // namespace bumper
