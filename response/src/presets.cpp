#include "bumper/response/presets.h"

#include <algorithm>
#include <array>

namespace bumper {

namespace {

constexpr std::array<std::string_view, 4> names = {"paper", "macmillan", "modern_car",
                                                   "reconstruction"};
constexpr std::array<ResponseSettings (*)(), names.size()> makers = {
    paperSettings, macmillanSettings, modernCarSettings, reconstructionSettings};

}  // namespace

ResponseSettings paperSettings() { return {}; }

ResponseSettings macmillanSettings() {
  ResponseSettings result;
  result.restitution = AngleCurve::constant(0.15);
  result.friction = AngleCurve::constant(0.15);
  return result;
}

ResponseSettings modernCarSettings() {
  constexpr double measured = 0.17;
  ResponseSettings result;
  result.restitution = AngleCurve::cosine(0.3, measured);
  result.energyRemaining = AngleCurve::cosine(0.92, measured * measured);
  return result;
}

ResponseSettings reconstructionSettings() {
  ResponseSettings result;
  result.restitution = AngleCurve::constant(0.0);
  result.friction = AngleCurve::constant(1.0);
  result.frictionKind = Friction::Kind::fraction_of_critical;
  result.penetrationTime = 0.07;
  return result;
}

std::span<const std::string_view> presetNames() { return names; }

std::optional<ResponseSettings> findPreset(std::string_view name) {
  const auto* const found = std::ranges::find(names, name);
  if (found == names.end()) return std::nullopt;
  return makers[static_cast<std::size_t>(found - names.begin())]();
}

}  // namespace bumper
