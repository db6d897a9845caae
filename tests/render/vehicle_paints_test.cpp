// Whether vehicles can be told apart by their paint, also by the colour-blind.

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "vehicle_shape.h"

namespace bumper {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

double linear(double share) {
  return share <= 0.04045 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4);
}

/// What the full lack of one kind of cone makes of linear sRGB (Machado, Oliveira & Fernandes,
/// IEEE TVCG 15 (2009), severity 1.0), and normal sight.
std::vector<Matrix3d> sights() {
  std::vector<Matrix3d> all(4);
  all[0].setIdentity();
  all[1] << 0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882, -0.048116,
      1.051998;  // protanopia
  all[2] << 0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.011820, 0.042940,
      0.968881;  // deuteranopia
  all[3] << 1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602, 0.004733, 0.691367,
      0.303900;  // tritanopia
  return all;
}

/// CIELAB under D65.
Vector3d lab(const Vector3d& rgb) {
  Matrix3d toXyz;
  toXyz << 0.4124564, 0.3575761, 0.1804375, 0.2126729, 0.7151522, 0.0721750, 0.0193339, 0.1191920,
      0.9503041;
  const Vector3d white(0.95047, 1.0, 1.08883);
  const Vector3d xyz = (toXyz * rgb.cwiseMax(0.0).cwiseMin(1.0)).cwiseQuotient(white);
  const auto f = [](double t) {
    return t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0;
  };
  const Vector3d g(f(xyz.x()), f(xyz.y()), f(xyz.z()));
  return {116.0 * g.y() - 16.0, 500.0 * (g.x() - g.y()), 200.0 * (g.y() - g.z())};
}

/// How far apart two colours are to whom they are nearest.
double difference(const Vector3d& a, const Vector3d& b) {
  double least = std::numeric_limits<double>::infinity();
  for (const Matrix3d& sight : sights()) {
    const auto seen = [&](const Vector3d& colour) {
      return lab(sight * colour.unaryExpr(&linear));
    };
    least = std::min(least, (seen(a) - seen(b)).norm());
  }
  return least;
}

TEST(VehiclePaints, CanBeToldApartByTheColourBlindToo) {
  // Ten times what is just noticed side by side.
  constexpr double wanted = 25.0;
  const Vector3d ground(0.955, 0.955, 0.945);  // of close-ups
  for (std::size_t a = 0; a < drawing::paintCount; ++a) {
    const Vector3d paint = drawing::paintOf(a).cast<double>();
    EXPECT_GT(difference(paint, ground), wanted) << a;
    for (std::size_t b = a + 1; b < drawing::paintCount; ++b)
      EXPECT_GT(difference(paint, drawing::paintOf(b).cast<double>()), wanted) << a << " and " << b;
  }
  EXPECT_EQ(drawing::paintOf(drawing::paintCount), drawing::paintOf(0)) << "they come again";
  // Red and olive are one to many: what the measure is for.
  EXPECT_LT(difference({0.60, 0.20, 0.15}, {0.42, 0.38, 0.12}), wanted);
}

}  // namespace
}  // namespace bumper
