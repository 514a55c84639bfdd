// SPDX-License-Identifier: Apache-2.0
/// \file
/// What the laws with Hencky elasticity share: principal logarithmic strains of the elastic part of
/// F, their stress and energy, a bound of the stiffness of waves, and the update of F after a
/// return map in principal strains.
///
///     tau = U diag(2 mu e_i + lambda tr e) U^T,   e_i = ln S_i,   b = F F^T = U S^2 U^T
///
/// which is (1) of docs/materials/hencky.md.
///
/// Hencky 1928; the return map in principal logarithmic strains of an isotropic law has the form of
/// small strains: de Souza Neto, Peric, Owen, Computational Methods for Plasticity, Wiley 2008,
/// section 14.4.
#pragma once

#include "materials/log_determinant.hpp"
#include "materials/material.hpp"
#include "solver/base/eigen_closed.hpp"
#include "solver/base/math.hpp"
#include "solver/base/polar.hpp"

namespace scree::detail {

/// ln S_i = ln(b_i)/2; b_i is kept positive where rounding or an inadmissible F made it vanish.
template <class V>
SCREE_FN Vec3<V> log_stretches(const SymEigen<V>& b) {
  using T = Scalar<V>;
  const V tiny = broadcast<V>(sizeof(T) == 4 ? T(1e-12) : T(1e-28));
  Vec3<V> r;
  SCREE_UNROLL for (int i = 0; i < 3; ++i) r[i] = T(0.5) * log(max(b.values[i], tiny));
  return r;
}

/// Principal axes (columns) and principal logarithmic strains, not sorted.
template <class V>
struct PrincipalStrain {
  Mat3<V> axes;
  Vec3<V> strain;
};

/// Of the left stretch; V of the singular value decomposition is not needed.
template <class V>
SCREE_FN PrincipalStrain<V> principal_strain(const Mat3<V>& F) {
  const SymEigen<V> b = eigen_symmetric_closed(symmetric_product(F));
  return {b.vectors, log_stretches(b)};
}

/// F <- (I + L) F, ln J likewise.
template <class V>
SCREE_FN void hencky_advance(Mat3<V>& F, V& log_volume_ratio, const Mat3<V>& L) {
  F = advance_gradient(L, F);
  log_volume_ratio = log_volume_ratio + log_determinant(L);
}

/// The trial state of a step, and its principal strains.
template <class V>
SCREE_FN PrincipalStrain<V> hencky_trial(Mat3<V>& F, V& log_volume_ratio, const Mat3<V>& L) {
  hencky_advance(F, log_volume_ratio, L);
  return principal_strain(F);
}

/// F <- U diag(exp(change)) U^T F, written as an increment: a change of zero leaves F alone to the
/// bit.
template <class V>
SCREE_FN void change_strain(Mat3<V>& F, const Mat3<V>& axes, const Vec3<V>& change) {
  const Vec3<V> factor = {{expm1(change[0]), expm1(change[1]), expm1(change[2])}};
  F = F + from_principal(axes, factor) * F;
}

/// Mean, deviator and its length of principal strains. The small number only keeps 0/0 away:
/// strains are far above its root or zero.
template <class V>
struct StrainDeviator {
  V mean;
  Vec3<V> deviator;
  V length, inverse_length;

  SCREE_FN explicit StrainDeviator(const Vec3<V>& strain) {
    using T = Scalar<V>;
    mean = (strain[0] + strain[1] + strain[2]) * T(1.0 / 3.0);
    deviator = {{strain[0] - mean, strain[1] - mean, strain[2] - mean}};
    const V square = dot(deviator, deviator) + (sizeof(T) == 4 ? T(1e-30) : T(1e-200));
    inverse_length = rsqrt(square);
    length = square * inverse_length;
  }
};

/// Kirchhoff stress [Pa] of principal logarithmic strains.
template <class V, class T>
SCREE_FN Sym3<V> hencky_stress(T lambda, T mu, const Mat3<V>& axes, const Vec3<V>& strain) {
  const V pressure = lambda * (strain[0] + strain[1] + strain[2]);
  const T two_mu = 2 * mu;
  return from_principal(axes, Vec3<V>{{two_mu * strain[0] + pressure, two_mu * strain[1] + pressure,
                                       two_mu * strain[2] + pressure}});
}

/// mu |e|^2 + lambda/2 (tr e)^2 [J/m^3].
template <class V, class T>
SCREE_FN V hencky_energy(T lambda, T mu, const Mat3<V>& F) {
  const Vec3<V> strain = principal_strain(F).strain;
  const V sum = strain[0] + strain[1] + strain[2];
  return mu * dot(strain, strain) + (T(0.5) * lambda) * sum * sum;
}

/// Bounds of the principal logarithmic strains without an eigenproblem: |e_i| <= size, |e_i - e_j|
/// <= range; from 2 ln S <= S^2 - 1 and 2 ln S >= 1 - S^-2.
template <class V>
struct StrainBounds {
  V size, range;
};

template <class V>
SCREE_FN StrainBounds<V> strain_bounds(const Mat3<V>& F) {
  using T = Scalar<V>;
  const V floor = broadcast<V>(PolarLimits<T>::det_min);
  const auto bounds = eigenvalue_bounds(symmetric_product(F));
  const V upper = max(bounds.upper, floor);
  const V ratio = det(F) / upper;
  const V lower = max(max(bounds.lower, ratio * ratio), floor);
  const V stretch = T(0.5) * (upper - T(1)), squeeze = T(0.5) / lower - T(0.5);
  return {max(stretch, squeeze), stretch + squeeze};
}

/// Upper bound of rho0 c^2 [Pa]. As for FixedCorotated, with tau_i = 2 mu e_i + lambda tr e:
/// a_ii = 2 mu + lambda - tau_i, a_ijij = mu y/(exp(y) - 1) with y = 2 (e_i - e_j), and with x =
/// e_i
/// - e_j a_iijj + a_ijji = lambda (1 - tr e) + mu (x coth x - e_i - e_j). For |e_i| <= e and |e_i -
/// e_j| <= r, since x coth x <= 1 + x^2/3, the largest eigenvalue is below |lambda| (1 + 3 e) + mu
/// (2 + 2 e + r + 2 r^2/3).
template <class V, class T>
SCREE_FN V hencky_stiffness(T lambda, T mu, const StrainBounds<V>& bounds) {
  const V e = bounds.size, r = bounds.range;
  const V shear = T(2) + T(2) * e + r + T(2.0 / 3.0) * r * r;
  return abs(lambda) * (T(1) + T(3) * e) + mu * shear;
}

}  // namespace scree::detail
