#include "accuracy_rows.h"

#include <algorithm>
#include <cmath>

namespace bumper::benchmark {

namespace {

constexpr double lost = 1e9;  // stands for an error that is not finite

double finite(double error) { return std::isfinite(error) ? std::min(error, lost) : lost; }

}  // namespace

Spread spreadOf(std::vector<double> errors) {
  if (errors.empty()) return {};
  std::ranges::transform(errors, errors.begin(), finite);
  std::ranges::sort(errors);
  const auto at = [&](double share) {
    const auto rank =
        static_cast<std::size_t>(std::ceil(share * static_cast<double>(errors.size())));
    return errors[std::max<std::size_t>(rank, 1) - 1];
  };
  return {.median = at(0.5), .p99 = at(0.99), .max = errors.back()};
}

void RowMaker::add(const EndError& error, double energyGain) {
  deltaV_.push_back(error.deltaV);
  yawRate_.push_back(error.yawRate);
  position_.push_back(error.position);
  energyGain_ = std::max(energyGain_, finite(energyGain));
}

Row RowMaker::row(Setting setting, const std::string& scheme, int wallTriangles,
                  double step) const {
  return {.setting = setting,
          .scheme = scheme,
          .wallTriangles = wallTriangles,
          .step = step,
          .count = deltaV_.size(),
          .deltaV = spreadOf(deltaV_),
          .yawRate = spreadOf(yawRate_),
          .position = spreadOf(position_),
          .gross = static_cast<std::size_t>(
              std::ranges::count_if(deltaV_, [](double e) { return !(e <= grossError); })),
          .energyGain = energyGain_};
}

}  // namespace bumper::benchmark
