#include "bumper/scenes/scene_hash.h"

#include <bit>
#include <cstddef>

namespace bumper {

namespace {

/// FNV-1a, Fowler, Noll and Vo: offset basis and prime for 64 bits.
class Fnv1a {
 public:
  template <typename Unsigned>
  void add(Unsigned value) {
    for (std::size_t k = 0; k < sizeof(value); ++k) {
      hash_ ^= (value >> (8U * k)) & 0xFFU;
      hash_ *= 0x100000001B3U;
    }
  }

  [[nodiscard]] std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xCBF29CE484222325U;
};

}  // namespace

std::uint64_t contentHash(const Scene& scene) {
  Fnv1a hash;
  hash.add(std::uint64_t{scene.vertices.size()});
  hash.add(std::uint64_t{scene.triangles.size()});
  for (const Eigen::Vector3d& vertex : scene.vertices) {
    for (const double coordinate : vertex) {
      hash.add(std::bit_cast<std::uint64_t>(coordinate == 0.0 ? 0.0 : coordinate));
    }
  }
  for (const Scene::Triangle& triangle : scene.triangles) {
    for (const std::uint32_t corner : triangle.corners) hash.add(corner);
    hash.add(triangle.mesh);
  }
  return hash.value();
}

}  // namespace bumper
