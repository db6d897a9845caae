#pragma once

#include <ode/ode.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace bumper {

/// ODE's arrays as Eigen values. ODE's 3 × 3 matrices have rows of four.
inline Eigen::Vector3d toVector(const dReal* v) { return {v[0], v[1], v[2]}; }

inline Eigen::Matrix3d toMatrix(const dReal* m) {
  Eigen::Matrix3d result;
  result << m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10];
  return result;
}

}  // namespace bumper
