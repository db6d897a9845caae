#include "turn.h"

#include <cmath>

namespace bumper {

Turn::Turn(const Eigen::Matrix3d& rows) : rows_(rows) {
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d axis = rows.row(i);
    int along = 0;
    axis.cwiseAbs().maxCoeff(&along);
    const auto number = static_cast<std::size_t>(i);
    from_[number] = along;
    sign_[number] = axis[along] < 0.0 ? -1.0 : 1.0;
    isSwap_ = isSwap_ && axis == sign_[number] * Eigen::Vector3d::Unit(along);
    isNone_ = isNone_ && axis == Eigen::Vector3d::Unit(i);
  }
}

Eigen::Matrix3d Turn::ofColumns(const Eigen::Matrix3d& m) const {
  Eigen::Matrix3d result;
  for (int k = 0; k < 3; ++k) result.col(k) = (*this)(m.col(k));
  return result;
}

}  // namespace bumper
