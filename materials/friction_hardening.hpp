// SPDX-License-Identifier: Apache-2.0
/// \file
/// Friction angle of sand as a function of the plastic shear strain.
#pragma once

#include <cmath>

namespace scree {

/// phi(q) = h0 + (h1 q - h3) exp(-h2 q), q the sum of the lengths of the plastic strain increments:
/// (6) of docs/materials/drucker_prager.md; Klar et al. 2016, hardening (there in degrees: h0 = 35,
/// h1 = 9, h2 = 0.2, h3 = 10). It starts at h0 - h3, passes a highest value and tends to h0.
struct FrictionHardening {
  double h0, h1;  ///< rad
  double h2;      ///< 1
  double h3;      ///< rad

  bool given() const { return !std::isnan(h0); }
  bool all_given() const { return !std::isnan(h0 + h1 + h2 + h3); }
  bool none_given() const {
    return std::isnan(h0) && std::isnan(h1) && std::isnan(h2) && std::isnan(h3);
  }
  double angle(double q) const { return h0 + (h1 * q - h3) * std::exp(-h2 * q); }
  /// At q = 1/h2 + h3/h1; without h1 the angle grows towards h0.
  double highest_angle() const { return h1 > 0 ? h0 + h1 / h2 * std::exp(-1 - h2 * h3 / h1) : h0; }
  /// Largest -d phi/dq: at q = 2/h2 + h3/h1.
  double steepest_loss() const { return h1 > 0 ? h1 * std::exp(-2 - h2 * h3 / h1) : 0; }
};

}  // namespace scree
