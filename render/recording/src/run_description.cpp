#include "bumper/render/run_description.h"

#include "bumper/scenes/scene_hash.h"

namespace bumper {

SceneReference referenceTo(const Scene& scene) {
  SceneReference reference;
  reference.name = scene.name;
  reference.triangles = scene.triangles.size();
  reference.hash = contentHash(scene);
  return reference;
}

bool isSameScene(const SceneReference& reference, const Scene& scene) {
  if (reference.triangles == 0 && reference.hash == 0) return true;
  return reference.triangles == scene.triangles.size() && reference.hash == contentHash(scene);
}

}  // namespace bumper
