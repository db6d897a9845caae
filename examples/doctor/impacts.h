#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "places.h"
#include "rig.h"

namespace bumper::doctor {

/// Energy is gained if there is this much more than before the impact.
inline constexpr double gainedRatio = 1.001;

struct ImpactTrial {
  std::size_t place = 0;  ///< index
  TestDrive drive{};
  double energy = 0.0;  ///< the most after the impact, as a ratio to that before
  bool isThrough = false;

  [[nodiscard]] bool isGained() const { return energy > gainedRatio; }
};

/// Impacts at 20°, 45° and 90° at all places, from where there is room.
class Impacts {
 public:
  Impacts(const Subject& subject, std::span<const Place> places);

  std::vector<ImpactTrial> driven(Rig& rig) const;
  [[nodiscard]] std::size_t count() const { return drives_.size(); }

 private:
  std::span<const Place> places_;
  std::vector<ImpactTrial> drives_;
};

}  // namespace bumper::doctor
