#include "barrier_options.h"

#include <cstdint>

namespace bumper::c_api {

namespace {

constexpr std::size_t mostMaterials = 65536;

}  // namespace

BarrierOptions barrierOptions(const bumper_barrier_options* given) {
  BarrierOptions result;
  if (given == nullptr) return result;
  const Name name{"options"};
  const auto whole = completed(name, *given, inC<bumper_barrier_options>());
  readFields(name, whole, result);
  requireArray({"materials", &name}, whole.materials, whole.material_count, mostMaterials);
  for (std::size_t i = 0; i < whole.material_count; ++i) {
    const Name material{"materials", &name, static_cast<std::int64_t>(i)};
    const auto& [which, response] = whole.materials[i];
    if (which == nullptr) refuse({"material", &material}, "is null");
    if (response == nullptr) refuse({"response", &material}, "is null");
    read({"response", &material}, response, result.materials[which]);
  }
  return result;
}

}  // namespace bumper::c_api
