#include "scene_stream.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>
#include <vector>

namespace bumper {

namespace {

/// Changes with the layout: a program and a library of different versions do not understand each
/// other by accident.
constexpr std::uint64_t magic = 0x3130'6E63'7362'6D62ULL;

enum class Kind : std::uint64_t { scene = 1, message = 2 };

constexpr std::uint64_t noAxis = 3;

/// A mesh without names, bytes: their lengths and the colour.
constexpr std::size_t smallestMesh = 2 * sizeof(std::uint64_t) + 3 * sizeof(float);

/// What there is of a scene once, with its name and format, or a message: bytes.
constexpr std::size_t mostAround = std::size_t{1} << 16U;

class Packer {
 public:
  template <typename T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    putBytes(&value, sizeof value);
  }

  void put(const std::string& text) {
    put<std::uint64_t>(text.size());
    putBytes(text.data(), text.size());
  }

  template <typename T>
  void putArray(const std::vector<T>& values) {
    put<std::uint64_t>(values.size());
    putBytes(values.data(), values.size() * sizeof(T));
  }

  std::string take() { return std::move(bytes_); }

 private:
  void putBytes(const void* data, std::size_t size) {
    bytes_.append(static_cast<const char*>(data), size);
  }

  std::string bytes_;
};

/// Once something does not fit, everything after it is empty and ok() false.
class Unpacker {
 public:
  explicit Unpacker(std::string_view bytes) : bytes_(bytes) {}

  template <typename T>
  T get() {
    T value{};
    getBytes(&value, sizeof value);
    return value;
  }

  std::string getText() {
    std::string text(getCount(1), '\0');
    getBytes(text.data(), text.size());
    return text;
  }

  template <typename T>
  std::vector<T> getArray() {
    std::vector<T> values(getCount(sizeof(T)));
    getBytes(values.data(), values.size() * sizeof(T));
    return values;
  }

  /// A number of things of at least this size that are still to come.
  std::size_t getCount(std::size_t size) {
    const auto count = get<std::uint64_t>();
    if (count > bytes_.size() / size) ok_ = false;
    return ok_ ? static_cast<std::size_t>(count) : 0;
  }

  [[nodiscard]] bool ok() const { return ok_; }
  [[nodiscard]] bool finished() const { return ok_ && bytes_.empty(); }

 private:
  void getBytes(void* data, std::size_t size) {
    ok_ = ok_ && size <= bytes_.size();
    if (!ok_ || size == 0) return;
    std::memcpy(data, bytes_.data(), size);
    bytes_.remove_prefix(size);
  }

  std::string_view bytes_;
  bool ok_ = true;
};

void pack(Packer& packer, const FileScene& file) {
  packer.put(file.scene.name);
  packer.putArray(file.scene.vertices);
  packer.putArray(file.scene.triangles);
  packer.put<std::uint64_t>(file.scene.meshes.size());
  for (const SceneMesh& mesh : file.scene.meshes) {
    packer.put(mesh.name);
    packer.put(mesh.material);
    for (const float part : mesh.colour) packer.put(part);
  }
  packer.put(file.format);
  packer.put<std::uint64_t>(file.up ? static_cast<std::uint64_t>(*file.up) : noAxis);
  packer.put(file.metresPerUnit);
  packer.put<std::uint64_t>(file.pointsAndLines);
  packer.put<std::uint64_t>(file.emptyMeshes);
}

std::optional<FileScene> unpackScene(Unpacker& unpacker, const SceneBudget& budget) {
  FileScene file;
  file.scene.name = unpacker.getText();
  file.scene.vertices = unpacker.getArray<Eigen::Vector3d>();
  file.scene.triangles = unpacker.getArray<Scene::Triangle>();
  const std::size_t meshes = unpacker.getCount(smallestMesh);
  if (meshes > budget.nodes) return {};
  file.scene.meshes.resize(meshes);
  for (SceneMesh& mesh : file.scene.meshes) {
    mesh.name = unpacker.getText();
    mesh.material = unpacker.getText();
    for (float& part : mesh.colour) part = unpacker.get<float>();
  }
  file.format = unpacker.getText();
  const auto axis = unpacker.get<std::uint64_t>();
  if (axis < noAxis) file.up = static_cast<UpAxis>(axis);
  file.metresPerUnit = unpacker.get<double>();
  file.pointsAndLines = unpacker.get<std::uint64_t>();
  file.emptyMeshes = unpacker.get<std::uint64_t>();
  if (!unpacker.finished() || axis > noAxis || !std::isfinite(file.metresPerUnit)) return {};
  return file;
}

}  // namespace

std::string pack(const ReadResult& result) {
  Packer packer;
  packer.put(magic);
  if (const auto* file = std::get_if<FileScene>(&result)) {
    packer.put(Kind::scene);
    pack(packer, *file);
  } else {
    packer.put(Kind::message);
    packer.put(std::get<std::string>(result));
  }
  return packer.take();
}

std::optional<ReadResult> unpack(std::string_view bytes, const SceneBudget& budget) {
  Unpacker unpacker(bytes);
  if (unpacker.get<std::uint64_t>() != magic) return {};
  switch (unpacker.get<Kind>()) {
    case Kind::scene:
      if (std::optional<FileScene> file = unpackScene(unpacker, budget)) return std::move(*file);
      return {};
    case Kind::message: {
      std::string message = unpacker.getText();
      if (unpacker.finished()) return message;
      return {};
    }
  }
  return {};
}

std::size_t longestAnswer(const SceneBudget& budget) {
  const double bytes = static_cast<double>(budget.triangles) *
                           (sizeof(Scene::Triangle) + 3 * sizeof(Eigen::Vector3d)) +
                       static_cast<double>(budget.nodes) * smallestMesh +
                       static_cast<double>(budget.names) + mostAround;
  return bytes < 1e18 ? static_cast<std::size_t>(bytes) : std::numeric_limits<std::size_t>::max();
}

}  // namespace bumper
