// What it costs to make a barrier of a million triangles, 40,000 of them walls, beside what ODE
// takes to build its tree of all of them. Minima of several interleaved runs.

#include <malloc.h>
#include <ode/ode.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "bumper/engine_adapter/responder.h"
#include "bumper/scenes/paper_scenes.h"
#include "bumper/scenes/scene_files.h"

namespace {

using namespace bumper;
using Clock = std::chrono::steady_clock;

constexpr int repetitions = 5;

template <typename Work>
void takeLeast(double& least, const Work& work) {
  const auto begin = Clock::now();
  work();
  const std::chrono::duration<double, std::milli> took = Clock::now() - begin;
  least = std::min(least, took.count());
}

constexpr double unknown = std::numeric_limits<double>::infinity();

std::size_t bytesInUse() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

/// ODE's trimesh of some triangles of a scene, corners shared as in the scene.
class OdeMesh {
 public:
  template <typename Triangles>
  OdeMesh(const Scene& scene, const Triangles& triangles) {
    std::vector<int> number(scene.vertices.size(), -1);
    for (const int triangle : triangles) {
      for (const std::uint32_t corner :
           scene.triangles[static_cast<std::size_t>(triangle)].corners) {
        if (number[corner] < 0) {
          number[corner] = static_cast<int>(vertices_.size() / 3);
          const Eigen::Vector3d& v = scene.vertices[corner];
          vertices_.insert(vertices_.end(), {v.x(), v.y(), v.z()});
        }
        indices_.push_back(static_cast<dTriIndex>(number[corner]));
      }
    }
  }

  void build() {
    data_ = dGeomTriMeshDataCreate();
    dGeomTriMeshDataBuildDouble(data_, vertices_.data(), 3 * sizeof(double),
                                static_cast<int>(vertices_.size() / 3), indices_.data(),
                                static_cast<int>(indices_.size()), 3 * sizeof(dTriIndex));
    mesh_ = dCreateTriMesh(nullptr, data_, nullptr, nullptr, nullptr);
  }
  void destroy() {
    dGeomDestroy(mesh_);
    dGeomTriMeshDataDestroy(data_);
  }
  [[nodiscard]] std::size_t arrays() const {
    return vertices_.size() * sizeof(double) + indices_.size() * sizeof(dTriIndex);
  }

 private:
  std::vector<double> vertices_;
  std::vector<dTriIndex> indices_;
  dTriMeshDataID data_ = nullptr;
  dGeomID mesh_ = nullptr;
};

void compareBuilding(const Scene& scene) {
  std::vector<int> all(scene.triangles.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
  std::vector<int> reduced;
  for (const Wall& wall : selectWalls(scene).walls) reduced.push_back(wall.triangle);
  OdeMesh whole(scene, all);
  OdeMesh walls(scene, reduced);

  double ode = unknown;
  double odeOfWalls = unknown;
  double slope = unknown;
  double everything = unknown;
  double barrier = unknown;
  std::size_t odeMemory = 0;
  std::size_t memory = 0;
  std::size_t said = 0;
  for (int i = 0; i < repetitions; ++i) {
    takeLeast(ode, [&] { whole.build(); });
    whole.destroy();
    std::size_t before = bytesInUse();
    takeLeast(odeOfWalls, [&] { walls.build(); });
    odeMemory = bytesInUse() - before + walls.arrays();
    walls.destroy();
    takeLeast(slope,
              [&] { selectWalls(scene, {.dropRepeated = false, .groundReach = std::nullopt}); });
    takeLeast(everything, [&] { selectWalls(scene); });
    const dWorldID world = dWorldCreate();
    {
      Responder responder(world);
      before = bytesInUse();
      BarrierId id;
      takeLeast(barrier, [&] { id = responder.addBarrier(scene); });
      memory = bytesInUse() - before;
      said = responder.report(id).memory;
    }
    dWorldDestroy(world);
  }
  const auto megabytes = [](std::size_t bytes) { return 1e-6 * static_cast<double>(bytes); };
  std::printf("%zu triangles, %zu of them walls within reach\n", scene.triangles.size(),
              reduced.size());
  std::printf("ODE's tree of all triangles          %8.0f ms\n", ode);
  std::printf("ODE's tree of the walls alone        %8.0f ms\n", odeOfWalls);
  std::printf("selectWalls, by slope alone          %8.0f ms\n", slope);
  std::printf("selectWalls, all reductions          %8.0f ms\n", everything);
  std::printf("addBarrier: all of that and the tree %8.0f ms, %.2f of ODE's\n", barrier,
              barrier / ode);
  std::printf("memory: ODE's mesh of the walls %.2f MB, Bumper's %.2f MB (%.2f; it says %.2f MB)\n",
              megabytes(odeMemory), megabytes(memory),
              static_cast<double>(memory) / static_cast<double>(odeMemory), megabytes(said));
}

/// The stages of reading the same scene from a file.
void timeLoading(const Scene& scene) {
  std::string pattern = (std::filesystem::temp_directory_path() / "bumper-cost-XXXXXX").string();
  const std::filesystem::path folder = mkdtemp(pattern.data());
  const std::filesystem::path file = folder / "scene.glb";
  saveScene(scene, file);
  std::array<double, 4> took{};
  Clock::time_point begun;
  loadTrustedScene(file, {.progress = [&](LoadStage stage, double share) {
                     if (share == 0.0) begun = Clock::now();
                     const std::chrono::duration<double, std::milli> passed = Clock::now() - begun;
                     took.at(static_cast<std::size_t>(stage)) = passed.count();
                   }});
  std::filesystem::remove_all(folder);
  std::printf(
      "loadScene of it as GLB: reading %.0f, converting %.0f, welding %.0f, dropping %.0f ms\n",
      took[0], took[1], took[2], took[3]);
}

}  // namespace

int main() {
  dInitODE2(0);
  try {
    // The course with panels of 0.54 m on fine ground.
    const Scene scene = course(
        {.innerPanels = 10000, .outerPanels = 10000, .groundAlong = 40000, .groundAcross = 12});
    compareBuilding(scene);
    timeLoading(scene);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "load_cost: %s\n", error.what());
    return 1;
  }
  dCloseODE();
  return 0;
}
