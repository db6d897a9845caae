#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace bumper::drawing {

/// A glTF 2.0 file in the making: its JSON part, which the caller completes with nodes and meshes,
/// and its binary part, which the functions below fill. They return indices.
class GltfFile {
 public:
  GltfFile();

  nlohmann::json json;

  /// Colours are sRGB in [0, 1]. Lit and seen from both sides.
  std::size_t addMaterial(std::string_view name, const Eigen::Vector3f& colour);
  /// Takes its colour from the vertices; the same from every direction.
  std::size_t addUnlitVertexColours(std::string_view name);

  std::size_t addPositions(std::span<const Eigen::Vector3f> positions);
  /// sRGB in [0, 1], one for each position.
  std::size_t addColours(std::span<const Eigen::Vector3f> colours);
  std::size_t addIndices(std::span<const std::uint32_t> indices);

  std::size_t addNode(nlohmann::json node);
  /// `child` becomes one of the node's children.
  void addChild(std::size_t node, std::size_t child);

  /// Seconds in ascending order, for the channels below.
  std::size_t addTimes(std::span<const float> times);
  /// All of one animation; as many values as times. Straight lines between them.
  void animateTranslation(std::size_t node, std::size_t times,
                          std::span<const Eigen::Vector3f> values);
  void animateRotation(std::size_t node, std::size_t times,
                       std::span<const Eigen::Quaternionf> values);
  void animateScale(std::size_t node, std::size_t times, std::span<const Eigen::Vector3f> values);

  /// As GLB. Throws Error, naming the file, if it cannot be written or is larger than 4 GB.
  void write(const std::filesystem::path& file) const;

 private:
  std::size_t addAccessor(std::span<const std::byte> bytes, std::size_t count, int componentType,
                          const char* type, int target);
  void animate(std::size_t node, const char* path, std::size_t times, std::size_t values);

  std::vector<std::byte> binary_;
};

}  // namespace bumper::drawing
