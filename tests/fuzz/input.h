#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "bumper/scenes/scene.h"

namespace bumper::fuzz {

/// Takes numbers from the front of a byte string; zeros after its end.
class Input {
 public:
  Input(const std::uint8_t* data, std::size_t size) : bytes_(data, size) {}

  std::uint8_t byte() {
    if (bytes_.empty()) return 0;
    const std::uint8_t value = bytes_.front();
    bytes_ = bytes_.subspan(1);
    return value;
  }
  /// In steps of 1/256, up to 128 to either side; or any double at all where `isWild`.
  double number(bool isWild = false) {
    if (!isWild)
      return static_cast<double>(static_cast<std::int16_t>(byte() | byte() << 8)) / 256.0;
    std::uint64_t bits = 0;
    for (unsigned i = 0; i < 8; ++i) bits |= std::uint64_t{byte()} << (8 * i);
    double value = 0.0;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }
  [[nodiscard]] bool isEmpty() const { return bytes_.empty(); }

 private:
  std::span<const std::uint8_t> bytes_;
};

/// A scene as the parser's own code hands it over: any triangles between up to 64 corners, of two
/// materials. Indices may be out of range, and coordinates anything, where the bytes say so.
inline Scene sceneFrom(Input& input) {
  Scene scene;
  scene.name = "fuzz";
  scene.meshes.push_back({.name = "a", .material = "concrete"});
  scene.meshes.push_back({.name = "b", .material = "steel"});
  const std::uint8_t kind = input.byte();
  const bool isWild = (kind & 3U) == 3U;
  const auto corners = static_cast<std::size_t>(input.byte() % 64);
  const auto triangles = static_cast<std::size_t>(input.byte() % 128);
  for (std::size_t i = 0; i < corners; ++i) {
    const double x = input.number(isWild);
    const double y = input.number(isWild);
    scene.vertices.emplace_back(x, y, input.number(isWild));
  }
  const std::uint32_t range = (kind & 12U) == 12U ? 256 : static_cast<std::uint32_t>(corners);
  if (range == 0) return scene;
  for (std::size_t i = 0; i < triangles; ++i) {
    Scene::Triangle triangle{};
    for (std::uint32_t& corner : triangle.corners) corner = input.byte() % range;
    triangle.mesh = input.byte() % ((kind & 48U) == 48U ? 3 : 2);
    scene.triangles.push_back(triangle);
  }
  return scene;
}

}  // namespace bumper::fuzz
