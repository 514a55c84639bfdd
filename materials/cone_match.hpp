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

/// sqrt(2/27) M for the cone that touches Mohr-Coulomb at a corner: M = 6 sin/(3 -+ sin).
inline double corner_slope(double sine, bool compression) {
  return std::sqrt(2.0 / 27.0) * 6 * sine / (compression ? 3 - sine : 3 + sine);
}

/// Slopes for a friction and a dilation angle [rad], 0 <= dilation <= friction < pi/2.
/// In plane strain the flow has no component out of the plane, n_zz = -a, hence
/// sin psi = 3 a/sqrt(2 - 3 a^2) and sin phi = 3 alpha sqrt(2 - 3 a^2)/(2 - 3 alpha a): M = sqrt(3)
/// sin phi at constant volume, M = 3 sin phi/sqrt(3 + sin^2 phi) for associated flow.
inline ConeSlopes cone_slopes(Match match, double friction, double dilation) {
  const double phi = std::sin(friction), psi = std::sin(dilation);
  if (match != Match::plane_strain) {
    const bool outer = match == Match::compression;
    return {corner_slope(phi, outer), corner_slope(psi, outer)};
  }
  const double a = psi * std::sqrt(2 / (9 + 3 * psi * psi));
  return {2 * phi / (3 * std::sqrt(2 - 3 * a * a) + 3 * phi * a), a};
}

}  // namespace scree
