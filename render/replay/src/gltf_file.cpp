#include "gltf_file.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "bumper/base/output_file.h"
#include "bumper/response/error.h"

namespace bumper::drawing {

namespace {

using Json = nlohmann::json;

static_assert(std::endian::native == std::endian::little, "a GLB file is little-endian");
static_assert(sizeof(Eigen::Vector3f) == 12 && sizeof(Eigen::Quaternionf) == 16,
              "written as they lie in memory");

// Constants of the standard.
constexpr int unsignedByte = 5121;
constexpr int unsignedInt = 5125;
constexpr int singleFloat = 5126;
constexpr int forVertices = 34962;
constexpr int forIndices = 34963;
constexpr int forNeither = 0;
constexpr std::uint32_t magic = 0x46546C67;
constexpr std::uint32_t version = 2;
constexpr std::uint32_t jsonChunk = 0x4E4F534A;
constexpr std::uint32_t binaryChunk = 0x004E4942;

/// glTF's colours are linear.
float linear(float value) {
  const float c = std::clamp(value, 0.0F, 1.0F);
  return c <= 0.04045F ? c / 12.92F : std::pow((c + 0.055F) / 1.055F, 2.4F);
}

std::string bytesOf(std::initializer_list<std::uint32_t> values) {
  return {reinterpret_cast<const char*>(values.begin()), values.size() * sizeof(std::uint32_t)};
}

/// The extent of a list, which the standard requires beside it.
template <typename Vector>
std::pair<Vector, Vector> extentOf(std::span<const Vector> values) {
  Vector low = values.front();
  Vector high = low;
  for (const Vector& value : values) {
    low = low.cwiseMin(value);
    high = high.cwiseMax(value);
  }
  return {low, high};
}

Json toJson(const Eigen::Vector3f& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

GltfFile::GltfFile() {
  json["asset"] = {{"version", "2.0"}, {"generator", "bumper"}};
  json["scene"] = 0;
}

std::size_t GltfFile::addMaterial(std::string_view name, const Eigen::Vector3f& colour) {
  Json material;
  material["name"] = name;
  material["pbrMetallicRoughness"] = {
      {"baseColorFactor", {linear(colour.x()), linear(colour.y()), linear(colour.z()), 1.0}},
      {"metallicFactor", 0.0},
      {"roughnessFactor", 0.8}};
  material["doubleSided"] = true;
  json["materials"].push_back(std::move(material));
  return json["materials"].size() - 1;
}

std::size_t GltfFile::addUnlitVertexColours(std::string_view name) {
  json["extensionsUsed"] = Json::array({"KHR_materials_unlit"});
  Json material;
  material["name"] = name;
  material["extensions"]["KHR_materials_unlit"] = Json::object();
  material["doubleSided"] = true;
  json["materials"].push_back(std::move(material));
  return json["materials"].size() - 1;
}

std::size_t GltfFile::addAccessor(std::span<const std::byte> bytes, std::size_t count,
                                  int componentType, const char* type, int target) {
  Json view;
  view["buffer"] = 0;
  view["byteOffset"] = binary_.size();
  view["byteLength"] = bytes.size();
  if (target != forNeither) view["target"] = target;
  json["bufferViews"].push_back(std::move(view));
  binary_.insert(binary_.end(), bytes.begin(), bytes.end());  // all lengths are multiples of four

  Json accessor;
  accessor["bufferView"] = json["bufferViews"].size() - 1;
  accessor["componentType"] = componentType;
  accessor["count"] = count;
  accessor["type"] = type;
  json["accessors"].push_back(std::move(accessor));
  return json["accessors"].size() - 1;
}

std::size_t GltfFile::addPositions(std::span<const Eigen::Vector3f> positions) {
  const std::size_t index =
      addAccessor(std::as_bytes(positions), positions.size(), singleFloat, "VEC3", forVertices);
  const auto [low, high] = extentOf(positions);
  json["accessors"][index]["min"] = toJson(low);
  json["accessors"][index]["max"] = toJson(high);
  return index;
}

std::size_t GltfFile::addColours(std::span<const Eigen::Vector3f> colours) {
  std::vector<std::array<std::uint8_t, 4>> bytes;
  bytes.reserve(colours.size());
  const auto level = [](float value) {
    return static_cast<std::uint8_t>(std::lround(255.0F * linear(value)));
  };
  for (const Eigen::Vector3f& c : colours)
    bytes.push_back({level(c.x()), level(c.y()), level(c.z()), 255});
  const std::size_t index = addAccessor(std::as_bytes(std::span(bytes)), colours.size(),
                                        unsignedByte, "VEC4", forVertices);
  json["accessors"][index]["normalized"] = true;
  return index;
}

std::size_t GltfFile::addIndices(std::span<const std::uint32_t> indices) {
  return addAccessor(std::as_bytes(indices), indices.size(), unsignedInt, "SCALAR", forIndices);
}

std::size_t GltfFile::addNode(Json node) {
  json["nodes"].push_back(std::move(node));
  return json["nodes"].size() - 1;
}

void GltfFile::addChild(std::size_t node, std::size_t child) {
  json["nodes"][node]["children"].push_back(child);
}

std::size_t GltfFile::addTimes(std::span<const float> times) {
  const std::size_t index =
      addAccessor(std::as_bytes(times), times.size(), singleFloat, "SCALAR", forNeither);
  json["accessors"][index]["min"] = Json::array({times.front()});
  json["accessors"][index]["max"] = Json::array({times.back()});
  return index;
}

void GltfFile::animate(std::size_t node, const char* path, std::size_t times, std::size_t values) {
  Json& animation = json["animations"][0];
  if (animation.is_null()) animation["name"] = "run";
  animation["channels"].push_back(
      {{"sampler", animation["samplers"].size()}, {"target", {{"node", node}, {"path", path}}}});
  animation["samplers"].push_back({{"input", times}, {"output", values}});
}

void GltfFile::animateTranslation(std::size_t node, std::size_t times,
                                  std::span<const Eigen::Vector3f> values) {
  animate(node, "translation", times,
          addAccessor(std::as_bytes(values), values.size(), singleFloat, "VEC3", forNeither));
}

void GltfFile::animateRotation(std::size_t node, std::size_t times,
                               std::span<const Eigen::Quaternionf> values) {
  animate(node, "rotation", times,
          addAccessor(std::as_bytes(values), values.size(), singleFloat, "VEC4", forNeither));
}

void GltfFile::animateScale(std::size_t node, std::size_t times,
                            std::span<const Eigen::Vector3f> values) {
  animate(node, "scale", times,
          addAccessor(std::as_bytes(values), values.size(), singleFloat, "VEC3", forNeither));
}

void GltfFile::write(const std::filesystem::path& file) const {
  Json complete = json;
  complete["buffers"].push_back(Json::object({{"byteLength", binary_.size()}}));
  std::string text = complete.dump(-1, ' ', false, Json::error_handler_t::replace);
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const std::size_t total = 12 + 8 + text.size() + 8 + binary_.size();
  if (total > std::numeric_limits<std::uint32_t>::max()) {
    throw Error("cannot write " + file.string() + ": it would have " + std::to_string(total) +
                " bytes, a GLB file at most 4294967295; leave out keys or scene");
  }

  const auto length = [](const auto& part) { return static_cast<std::uint32_t>(part.size()); };
  OutputFile output(file);
  output.write({bytesOf({magic, version, static_cast<std::uint32_t>(total)}),
                bytesOf({length(text), jsonChunk}),
                text,
                bytesOf({length(binary_), binaryChunk}),
                {reinterpret_cast<const char*>(binary_.data()), binary_.size()}});
  output.moveToPlace();
}

}  // namespace bumper::drawing
