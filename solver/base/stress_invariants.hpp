// SPDX-License-Identifier: Apache-2.0
/// \file
/// What engineers read off a stress. Stresses come tension positive [Pa]; p, q and principal
/// stresses go out compression positive.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "solver/base/eigen.hpp"
#include "solver/base/tensor.hpp"

namespace scree {

/// p = -tr(sigma)/3
inline double mean_pressure(const Sym3<double>& stress) { return -trace(stress) / 3; }

/// q = sqrt(3/2) |s|, the von Mises stress
inline double deviatoric_stress(const Sym3<double>& stress) {
  return std::sqrt(1.5) * norm(deviator(stress));
}

/// Principal stresses in falling order, and their unit vectors as rows.
struct PrincipalStress {
  std::array<double, 3> value{};
  std::array<std::array<double, 3>, 3> direction{};
};

inline PrincipalStress principal_stress(const Sym3<double>& stress) {
  const SymEigen<double> eigen = eigen_symmetric(stress);
  std::array<int, 3> order{0, 1, 2};
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return eigen.values[a] < eigen.values[b]; });
  PrincipalStress result;
  for (std::size_t i = 0; i < 3; ++i) {
    result.value[i] = -eigen.values[order[i]];
    for (int a = 0; a < 3; ++a) result.direction[i][std::size_t(a)] = eigen.vectors(a, order[i]);
  }
  return result;
}

/// Lode angle from 0 (triaxial compression) to pi/3 (triaxial extension): tan(theta - pi/6) =
/// (2 s2 - s1 - s3)/(sqrt(3) (s1 - s3)). NaN where q is at most `negligible` of the stress.
inline double lode_angle(const std::array<double, 3>& s, double negligible = 1e-14) {
  const double range = s[0] - s[2];
  const double size = std::max(std::abs(s[0]), std::abs(s[2]));
  if (!(range > negligible * size)) return std::numeric_limits<double>::quiet_NaN();
  constexpr double sixth = 0.52359877559829887;  // pi/6
  return sixth + std::atan((2 * s[1] - s[0] - s[2]) / (std::sqrt(3.0) * range));
}

/// phi of sin phi = (s1 - s3)/(s1 + s3); NaN where s3 is tensile or there is no stress.
inline double mobilised_friction(const std::array<double, 3>& s) {
  if (!(s[2] >= 0) || !(s[0] > 0)) return std::numeric_limits<double>::quiet_NaN();
  return std::asin((s[0] - s[2]) / (s[0] + s[2]));
}

}  // namespace scree
