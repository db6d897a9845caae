#include <cstdint>
#include <limits>
#include <string>

#include "barrier_options.h"

namespace bumper::c_api {

namespace {

constexpr std::size_t mostTriangles = 715'827'882;
constexpr std::size_t mostNumbered = std::numeric_limits<std::uint32_t>::max();

Name element(const char* text, const Name& of, std::size_t index) {
  return {text, &of, static_cast<std::int64_t>(index)};
}

Scene scene(const bumper_scene* given) {
  const Name name{"scene"};
  const auto whole = completed(name, required("scene", given), inC<bumper_scene>());
  requireArray({"vertices", &name}, whole.vertices, whole.vertex_count, mostNumbered);
  requireArray({"triangles", &name}, whole.triangles, whole.triangle_count, mostTriangles);
  const bool hasMeshes = whole.meshes != nullptr || whole.mesh_count > 0;
  requireArray({"meshes", &name}, whole.meshes, whole.mesh_count, mostNumbered);

  Scene result;
  read({"name", &name}, whole.name, result.name);
  result.vertices.resize(whole.vertex_count);
  for (std::size_t i = 0; i < whole.vertex_count; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double coordinate = whole.vertices[3 * i + k];
      read(element("vertices", name, 3 * i + k), coordinate,
           result.vertices[i][static_cast<Eigen::Index>(k)]);
    }
  }
  result.triangles.resize(whole.triangle_count);
  for (std::size_t i = 0; i < whole.triangle_count; ++i) {
    Scene::Triangle& triangle = result.triangles[i];
    for (std::size_t k = 0; k < 3; ++k) triangle.corners[k] = whole.triangles[3 * i + k];
    if (whole.triangle_meshes != nullptr) triangle.mesh = whole.triangle_meshes[i];
  }
  if (!hasMeshes) result.meshes.resize(1);
  for (std::size_t i = 0; i < whole.mesh_count; ++i) {
    SceneMesh& mesh = result.meshes.emplace_back();
    read({"name", &name}, whole.meshes[i].name, mesh.name);
    read({"material", &name}, whole.meshes[i].material, mesh.material);
  }
  return result;
}

template <typename Source>
int add(const char* function, bumper_responder responder, bumper_barrier* barrier,
        const bumper_barrier_options* options, const Source& source) {
  return changing(function, responder, [&](Session& session) {
    required("barrier", barrier);
    const BarrierId id = session.responder.addBarrier(source(), barrierOptions(options));
    barrier->value = handleOf(session, id.value);
  });
}

}  // namespace

extern "C" {

int bumper_add_scene(bumper_responder responder, const bumper_scene* scene,
                     const bumper_barrier_options* options, bumper_barrier* barrier) {
  return add("bumper_add_scene", responder, barrier, options, [&] { return c_api::scene(scene); });
}

int bumper_add_geom(bumper_responder responder, dGeomID geom, const bumper_barrier_options* options,
                    bumper_barrier* barrier) {
  return add("bumper_add_geom", responder, barrier, options,
             [&] { return &required("geom", geom); });
}

int bumper_update_barrier(bumper_responder responder, bumper_barrier barrier) {
  return changing("bumper_update_barrier", responder, [&](Session& session) {
    session.responder.updateBarrier(idOf(session, "barrier", barrier));
  });
}

int bumper_update_scene(bumper_responder responder, bumper_barrier barrier,
                        const bumper_scene* scene) {
  return changing("bumper_update_scene", responder, [&](Session& session) {
    session.responder.updateBarrier(idOf(session, "barrier", barrier), c_api::scene(scene));
  });
}

int bumper_remove_barrier(bumper_responder responder, bumper_barrier barrier) {
  return changing("bumper_remove_barrier", responder, [&](Session& session) {
    session.responder.removeBarrier(idOf(session, "barrier", barrier));
  });
}

int bumper_get_geom(bumper_responder responder, bumper_barrier barrier, dGeomID* geom) {
  return asking("bumper_get_geom", responder, [&](const Session& session) {
    required("geom", geom) = session.responder.geom(idOf(session, "barrier", barrier));
  });
}

int bumper_get_wall_report(bumper_responder responder, bumper_barrier barrier,
                           bumper_wall_report* report) {
  return asking("bumper_get_wall_report", responder, [&](const Session& session) {
    give("report", report, session.responder.report(idOf(session, "barrier", barrier)));
  });
}

}  // extern "C"

}  // namespace bumper::c_api
