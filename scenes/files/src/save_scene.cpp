#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Exporter.hpp>
#include <limits>
#include <map>
#include <memory>
#include <vector>

#include "bumper/base/output_file.h"
#include "file_scene.h"

namespace bumper {

namespace {

struct Format {
  const char* ending;
  const char* id;  ///< assimp's
  UpAxis up;
};

Format formatOf(const std::filesystem::path& file) {
  for (const Format& format :
       {Format{".obj", "obj", UpAxis::z}, Format{".stl", "stlb", UpAxis::z},
        Format{".ply", "plyb", UpAxis::z}, Format{".glb", "glb2", UpAxis::y}}) {
    if (file.extension() == format.ending) return format;
  }
  throw fileError(file, "cannot be written: allowed endings are .obj, .stl, .ply and .glb");
}

aiVector3D toFile(const Eigen::Vector3d& v, UpAxis up) {
  const Eigen::Vector3f f = v.cast<float>();
  return up == UpAxis::y ? aiVector3D(f.x(), f.z(), -f.y()) : aiVector3D(f.x(), f.y(), f.z());
}

std::unique_ptr<aiMaterial> toMaterial(const SceneMesh& mesh) {
  auto material = std::make_unique<aiMaterial>();
  const aiString name(mesh.material);
  material->AddProperty(&name, AI_MATKEY_NAME);
  const aiColor3D colour(mesh.colour.x(), mesh.colour.y(), mesh.colour.z());
  material->AddProperty(&colour, 1, AI_MATKEY_COLOR_DIFFUSE);
  return material;
}

/// The triangles of one mesh with the vertices that they use.
std::unique_ptr<aiMesh> toMesh(const Scene& scene, const std::vector<const Scene::Triangle*>& part,
                               UpAxis up) {
  auto mesh = std::make_unique<aiMesh>();
  mesh->mName.Set(scene.meshes[part.front()->mesh].name);
  mesh->mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
  mesh->mNumFaces = static_cast<unsigned>(part.size());
  mesh->mFaces = new aiFace[part.size()];
  std::map<std::uint32_t, unsigned> numbers;
  std::vector<aiVector3D> vertices;
  for (std::size_t i = 0; i < part.size(); ++i) {
    aiFace& face = mesh->mFaces[i];
    face.mNumIndices = 3;
    face.mIndices = new unsigned[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [number, isNew] =
          numbers.try_emplace(part[i]->corners.at(k), static_cast<unsigned>(vertices.size()));
      if (isNew) vertices.push_back(toFile(scene.corner(*part[i], k), up));
      face.mIndices[k] = number->second;
    }
  }
  mesh->mNumVertices = static_cast<unsigned>(vertices.size());
  mesh->mVertices = new aiVector3D[vertices.size()];
  std::copy(vertices.begin(), vertices.end(), mesh->mVertices);
  return mesh;
}

template <typename T>
T** toArray(std::vector<std::unique_ptr<T>>& items) {
  T** array = new T*[items.size()];
  std::transform(items.begin(), items.end(), array, [](auto& item) { return item.release(); });
  return array;
}

/// One node, mesh and material for each mesh that has triangles.
std::unique_ptr<aiScene> toAssimp(const Scene& scene, UpAxis up) {
  std::vector<std::vector<const Scene::Triangle*>> parts(scene.meshes.size());
  for (const Scene::Triangle& triangle : scene.triangles) parts[triangle.mesh].push_back(&triangle);

  std::vector<std::unique_ptr<aiMesh>> meshes;
  std::vector<std::unique_ptr<aiMaterial>> materials;
  std::vector<std::unique_ptr<aiNode>> nodes;
  auto result = std::make_unique<aiScene>();
  result->mRootNode = new aiNode(scene.name);
  for (const std::vector<const Scene::Triangle*>& part : parts) {
    if (part.empty()) continue;
    const auto index = static_cast<unsigned>(meshes.size());
    const SceneMesh& source = scene.meshes[part.front()->mesh];
    meshes.push_back(toMesh(scene, part, up));
    meshes.back()->mMaterialIndex = index;
    materials.push_back(toMaterial(source));
    nodes.push_back(std::make_unique<aiNode>(source.name));
    nodes.back()->mParent = result->mRootNode;
    nodes.back()->mNumMeshes = 1;
    nodes.back()->mMeshes = new unsigned[1]{index};
  }
  result->mNumMeshes = static_cast<unsigned>(meshes.size());
  result->mMeshes = toArray(meshes);
  result->mNumMaterials = static_cast<unsigned>(materials.size());
  result->mMaterials = toArray(materials);
  result->mRootNode->mNumChildren = static_cast<unsigned>(nodes.size());
  result->mRootNode->mChildren = toArray(nodes);
  return result;
}

}  // namespace

void saveScene(const Scene& scene, const std::filesystem::path& file) {
  const Format format = formatOf(file);
  try {
    validate(scene);
    const std::unique_ptr<aiScene> source = toAssimp(scene, format.up);
    // In memory: assimp does not notice a full disk.
    Assimp::Exporter exporter;
    Assimp::ExportProperties properties;
    properties.SetPropertyString(AI_CONFIG_EXPORT_BLOB_NAME, file.filename().string());
    const aiExportDataBlob* blob = exporter.ExportToBlob(source.get(), format.id, 0, &properties);
    if (blob == nullptr) throw Error(exporter.GetErrorString());
    // An OBJ file's materials are a file beside it; that has to be there first.
    std::vector<std::unique_ptr<OutputFile>> outputs;
    for (; blob != nullptr; blob = blob->next) {
      std::filesystem::path place = file;
      if (blob->name.length > 0)
        place.replace_extension(
            std::filesystem::path(std::string("a.") + blob->name.C_Str()).extension());
      outputs.push_back(std::make_unique<OutputFile>(place));
      outputs.back()->write({{static_cast<const char*>(blob->data), blob->size}});
    }
    // The file itself is the first one, and comes last.
    for (; !outputs.empty(); outputs.pop_back()) outputs.back()->moveToPlace();
  } catch (const std::exception& error) {
    throw fileError(file, std::string("cannot be written: ") + error.what());
  }
}

}  // namespace bumper
