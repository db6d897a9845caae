#pragma once

#include <Eigen/Core>
#include <array>

namespace bumper {

/// A change of right-handed axes. One that swaps axes, with or without their sign, is exact, to the
/// sign of a zero.
class Turn {
 public:
  Turn() = default;
  /// The rows are the new axes, in the old ones.
  explicit Turn(const Eigen::Matrix3d& rows);

  [[nodiscard]] bool isNone() const { return isNone_; }

  /// From old to new axes, and back.
  [[nodiscard]] Eigen::Vector3d operator()(const Eigen::Vector3d& v) const {
    if (isNone_) return v;
    if (!isSwap_) return rows_ * v;
    return {sign_[0] * v[from_[0]], sign_[1] * v[from_[1]], sign_[2] * v[from_[2]]};
  }
  [[nodiscard]] Eigen::Vector3d back(const Eigen::Vector3d& v) const {
    if (isNone_) return v;
    if (!isSwap_) return rows_.transpose() * v;
    Eigen::Vector3d result;
    for (std::size_t i = 0; i < 3; ++i) result[from_[i]] = sign_[i] * v[static_cast<int>(i)];
    return result;
  }

  /// Of each column.
  [[nodiscard]] Eigen::Matrix3d ofColumns(const Eigen::Matrix3d& m) const;
  /// Of each row.
  [[nodiscard]] Eigen::Matrix3d ofRows(const Eigen::Matrix3d& m) const {
    return ofColumns(m.transpose()).transpose();
  }
  [[nodiscard]] const Eigen::Matrix3d& rows() const { return rows_; }

 private:
  Eigen::Matrix3d rows_ = Eigen::Matrix3d::Identity();
  bool isNone_ = true;
  bool isSwap_ = true;
  std::array<int, 3> from_{0, 1, 2};
  std::array<double, 3> sign_{1.0, 1.0, 1.0};
};

}  // namespace bumper
