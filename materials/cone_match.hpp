// SPDX-License-Identifier: Apache-2.0
/// \file
/// Cones q = M p that stand for a Mohr-Coulomb friction angle, and their slopes in strain form.
#pragma once

#include <cmath>

namespace scree {

/// In which state of stress the cone coincides with Mohr-Coulomb.
enum class Match {
  by_dimension,  ///< plane_strain in 2D, compression in 3D
  compression,   ///< triaxial compression: the outer cone
  extension,     ///< triaxial extension
  plane_strain   ///< plane strain, plastic flow without strain out of the plane
};

inline Match resolve_match(Match match, int dimension) {
  if (match != Match::by_dimension) return match;
  return dimension == 2 ? Match::plane_strain : Match::compression;
}

/// Slopes of cone and plastic flow: |dev tau| = 3 alpha p on the cone, and the plastic strain
/// increment is along n + a I with n the unit deviator of stress. alpha = sqrt(2/27) M.
struct ConeSlopes {
  double alpha = 0;  ///< friction
  double a = 0;      ///< dilation, 0 at constant volume
};

/// alpha = scale sin(phi)/(base + change sin(phi)) at a given dilation slope a.
struct FrictionSlope {
  double scale, base, change;
  double operator()(double sine) const { return scale * sine / (base + change * sine); }
};

/// Cones that touch Mohr-Coulomb at a corner have M = 6 sin/(3 -+ sin). In plane strain the flow
/// has no component out of the plane, n_zz = -a, hence sin phi = 3 alpha sqrt(2 - 3 a^2)/(2 - 3
/// alpha a): M = sqrt(3) sin phi at constant volume, M = 3 sin phi/sqrt(3 + sin^2 phi) for
/// associated flow.
inline FrictionSlope friction_slope(Match match, double a) {
  if (match == Match::plane_strain) return {2, 3 * std::sqrt(2 - 3 * a * a), 3 * a};
  return {std::sqrt(2.0 / 27.0) * 6, 3, match == Match::compression ? -1.0 : 1.0};
}

/// Slope of the flow for a dilation angle [rad]; in plane strain sin psi = 3 a/sqrt(2 - 3 a^2).
inline double dilation_slope(Match match, double dilation) {
  const double sine = std::sin(dilation);
  if (match == Match::plane_strain) return sine * std::sqrt(2 / (9 + 3 * sine * sine));
  return friction_slope(match, 0)(sine);
}

/// Slopes for a friction and a dilation angle [rad], 0 <= dilation <= friction < pi/2.
inline ConeSlopes cone_slopes(Match match, double friction, double dilation) {
  const double a = dilation_slope(match, dilation);
  return {friction_slope(match, a)(std::sin(friction)), a};
}

}  // namespace scree
