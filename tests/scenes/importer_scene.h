#pragma once

#include <assimp/mesh.h>
#include <assimp/scene.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace bumper::testing {

/// A scene as an importer makes it: one mesh of three corners and one face, shown by `copies` nodes
/// of a name. assimp's objects free what they point to.
inline std::unique_ptr<aiScene> importedTriangle(const std::vector<unsigned>& face,
                                                 const char* name, unsigned copies = 1) {
  auto scene = std::make_unique<aiScene>();
  auto mesh = std::make_unique<aiMesh>();
  mesh->mNumVertices = 3;
  mesh->mVertices = std::make_unique<aiVector3D[]>(3).release();
  mesh->mVertices[1] = {1, 0, 0};
  mesh->mVertices[2] = {0, 0, 1};
  mesh->mNumFaces = 1;
  mesh->mFaces = std::make_unique<aiFace[]>(1).release();
  mesh->mFaces[0].mNumIndices = static_cast<unsigned>(face.size());
  mesh->mFaces[0].mIndices = std::make_unique<unsigned[]>(face.size()).release();
  std::copy(face.begin(), face.end(), mesh->mFaces[0].mIndices);
  scene->mNumMeshes = 1;
  scene->mMeshes = std::make_unique<aiMesh*[]>(1).release();
  scene->mMeshes[0] = mesh.release();
  scene->mRootNode = std::make_unique<aiNode>("root").release();
  scene->mRootNode->mNumChildren = copies;
  scene->mRootNode->mChildren = std::make_unique<aiNode*[]>(copies).release();
  for (unsigned i = 0; i < copies; ++i) {
    auto node = std::make_unique<aiNode>(name);
    node->mParent = scene->mRootNode;
    node->mNumMeshes = 1;
    node->mMeshes = std::make_unique<unsigned[]>(1).release();
    scene->mRootNode->mChildren[i] = node.release();
  }
  return scene;
}

}  // namespace bumper::testing
