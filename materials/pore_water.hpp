// SPDX-License-Identifier: Apache-2.0
/// \file
/// Water in the pores of a soil that cannot drain: total stress = effective stress - u I (Terzaghi;
/// Biot's alpha = 1, incompressible grains).
#pragma once

#include "materials/log_determinant.hpp"
#include "materials/material.hpp"

/// The excess pore pressure u [Pa], compression positive, is one number beside the state of any law
/// of effective stresses. Grains do not change their volume, so the water in the pores takes up
/// every change of the volume: du = -K_u d(ln J), K_u = K_f/n the bulk modulus of the water over
/// the porosity. In isotropic undrained loading of a skeleton of bulk modulus K, Skempton's B =
/// du/dsigma = K_u/(K_u + K).
namespace scree::pore_water {

/// The pressure after a step with the increment L = dt grad v.
template <class V, class T>
SCREE_FN V advance(const V& pressure, T bulk_modulus, const Mat3<V>& L) {
  return pressure - bulk_modulus * detail::log_determinant(L);
}

/// Kirchhoff stress of soil and water, tau - J u I.
template <class V>
SCREE_FN Sym3<V> total(const Sym3<V>& effective, const V& volume_ratio, const V& pressure) {
  return detail::plus_diagonal(effective, -(volume_ratio * pressure));
}

/// Bound of the wave speed of soil and water. The water adds J K_u n n^T to the acoustic tensor
/// rho0 c^2 of direction n: J^2 psi'' n n^T with psi' = -u, psi'' = K_u/J. Eigenvalues of a sum are
/// at most the sum of the largest ones.
template <class V, class T>
SCREE_FN V wave_speed(const V& skeleton, const V& volume_ratio, T bulk_over_density) {
  return sqrt(skeleton * skeleton + bulk_over_density * max(volume_ratio, broadcast<V>(0)));
}

/// Elastic energy of the water per reference volume [J/m^3] since its pressure was zero. The work
/// -J u d(ln J) with d(ln J) = -du/K_u integrates to J K_u (exp(s) - 1 - s), s = u/K_u; that is
/// J u^2/(2 K_u) for small s.
inline double energy_density(double volume_ratio, double pressure, double bulk_modulus) {
  const double s = pressure / bulk_modulus;
  // Below 1e-2 the series to s^6 (relative error s^5/2520) is better than the difference.
  const double series = 0.5 * s * s * (1 + s / 3 * (1 + s / 4 * (1 + s / 5 * (1 + s / 6))));
  const double difference = expm1(s) - s;
  return volume_ratio * bulk_modulus * (s > -1e-2 && s < 1e-2 ? series : difference);
}

/// The entry that a soil with pore water has after those of its law.
inline StateField field() {
  return {"pore_pressure", 1, "Pa", "Excess pore pressure, compression positive.", true};
}

}  // namespace scree::pore_water
