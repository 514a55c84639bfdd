// SPDX-License-Identifier: Apache-2.0
/// \file
/// What the tests of code over scalars and lanes share: the type list, random input, lane
/// comparison.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <random>

#include "solver/base/tensor.hpp"

namespace scree::testing {

using RealTypes = ::testing::Types<float, double>;
using LaneTypes = ::testing::Types<float, double, Lanes<float>, Lanes<double>>;

template <class T>
inline constexpr T epsilon = std::numeric_limits<T>::epsilon();

/// Distance |x - exact| in units in the last place of T at `exact`.
template <class T>
double ulps(T x, long double exact) {
  const T rounded = T(exact);
  const T next = std::nextafter(std::abs(rounded), std::numeric_limits<T>::infinity());
  const long double unit = (long double)next - (long double)std::abs(rounded);
  return double(std::abs((long double)x - exact) / unit);
}

/// Lane i of a matrix.
template <class V>
Mat3<Scalar<V>> lane_of(const Mat3<V>& a, int i) {
  Mat3<Scalar<V>> r;
  for (int k = 0; k < 9; ++k) r(k / 3, k % 3) = lane(a(k / 3, k % 3), i);
  return r;
}

template <class V>
void set_lane_of(Mat3<V>& a, int i, const Mat3<Scalar<V>>& value) {
  for (int k = 0; k < 9; ++k) set_lane(a(k / 3, k % 3), i, value(k / 3, k % 3));
}

template <class T>
Eigen::Matrix3d to_eigen(const Mat3<T>& a) {
  Eigen::Matrix3d r;
  for (int k = 0; k < 9; ++k) r(k / 3, k % 3) = double(a(k / 3, k % 3));
  return r;
}

template <class T>
Eigen::Matrix3d to_eigen(const Sym3<T>& a) {
  return to_eigen(to_mat(a));
}

template <class T>
Mat3<T> from_eigen(const Eigen::Matrix3d& a) {
  Mat3<T> r;
  for (int k = 0; k < 9; ++k) r(k / 3, k % 3) = T(a(k / 3, k % 3));
  return r;
}

/// Random matrices of a stated kind, the same in every run.
class MatrixSource {
 public:
  explicit MatrixSource(unsigned seed) : engine_(seed) {}

  double uniform(double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(engine_);
  }
  Eigen::Matrix3d entries(double bound) {
    Eigen::Matrix3d r;
    for (int k = 0; k < 9; ++k) r(k / 3, k % 3) = uniform(-bound, bound);
    return r;
  }
  Eigen::Matrix3d rotation() {
    const Eigen::Quaterniond q(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    return q.normalized().toRotationMatrix();
  }
  Eigen::Matrix3d with_stretches(double a, double b, double c) {
    return rotation() * Eigen::Vector3d(a, b, c).asDiagonal() * rotation();
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace scree::testing
