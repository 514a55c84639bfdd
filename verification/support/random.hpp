// SPDX-License-Identifier: Apache-2.0
//
// Seeded random numbers of the tests: std::mt19937_64 alone is the same everywhere, the standard
// distributions are not.
#pragma once

#include <Eigen/Core>
#include <random>

namespace scree::testing {

class Random {
 public:
  explicit Random(unsigned long long seed) : engine_(seed) {}

  /// Uniform in [low, high).
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }

  /// Entries uniform in [-size, size); the entries of axes >= dimension are zero.
  Eigen::Vector3d vector(double size, int dimension = 3) {
    Eigen::Vector3d v = Eigen::Vector3d::Zero();
    for (int a = 0; a < dimension; ++a) v[a] = uniform(-size, size);
    return v;
  }

  Eigen::Matrix3d matrix(double size, int dimension = 3) {
    Eigen::Matrix3d m = Eigen::Matrix3d::Zero();
    for (int a = 0; a < dimension; ++a)
      for (int b = 0; b < dimension; ++b) m(a, b) = uniform(-size, size);
    return m;
  }

  Eigen::Matrix3d symmetric(double size, int dimension = 3) {
    const Eigen::Matrix3d m = matrix(size, dimension);
    return 0.5 * (m + m.transpose());
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace scree::testing
