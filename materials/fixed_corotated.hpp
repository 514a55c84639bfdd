// SPDX-License-Identifier: Apache-2.0
/// \file
/// Fixed-corotated elasticity: Stomakhin, Howes, Schroeder, Teran, Energetically consistent
/// invertible elasticity, SCA 2012. Not invertible here: det F <= 0 is a fault.
#pragma once

#include <limits>

#include "materials/material.hpp"
#include "solver/base/stretch.hpp"

namespace scree {

/// psi = mu |F - R|^2 + lambda/2 (J - 1)^2,  tau = 2 mu (F - R) F^T + lambda J (J - 1) I.
/// These are (1) and (2) of docs/materials/fixed_corotated.md.
/// In confined uniaxial strain P_11 = (lambda + 2 mu)(s - 1) exactly, at any amplitude.
struct FixedCorotated {
  static constexpr const char* name = "fixed_corotated";
  static constexpr bool effective_stress = true;
  static constexpr bool long_chains = true;

  struct Input {
    double youngs_modulus = std::numeric_limits<double>::quiet_NaN();  ///< Pa
    double poissons_ratio = std::numeric_limits<double>::quiet_NaN();
  };

  static Schema<Input> schema() {
    Schema<Input> s(name, "Elastic solid, linear in stretch: fixed-corotated hyperelasticity.");
    s.number("youngs_modulus", &Input::youngs_modulus, Unit::pressure)
        .typical(1e7)
        .above(0)
        .doc("Young's modulus at small strain.");
    s.number("poissons_ratio", &Input::poissons_ratio)
        .typical(0.3)
        .above(-1)
        .below(0.5)
        .doc("Poisson's ratio at small strain.");
    s.cite(
        "Stomakhin, Howes, Schroeder, Teran, Energetically consistent invertible elasticity, "
        "Symposium on Computer Animation 2012, doi 10.2312/SCA/SCA12/025-032");
    return s;
  }

  template <class T>
  struct Params {
    T lambda, mu, inverse_density;
  };

  template <class T>
  static Params<T> params(const Input& in, double density, int /*dimension*/) {
    const LameConstants c = lame_constants(in.youngs_modulus, in.poissons_ratio);
    return {T(c.lambda), T(c.mu), T(1) / T(density)};
  }

  template <class V>
  struct State {
    Mat3<V> F;
  };

  static std::vector<StateField> fields() {
    return {{"deformation_gradient", 9, "1", "Deformation gradient F.", true}};
  }

  template <class V, class T>
  SCREE_FN static State<V> initial(const Params<T>&) {
    return {identity3<V>()};
  }

  template <class V, class T>
  SCREE_FN static Sym3<V> kirchhoff(const Params<T>& p, State<V>& s, const Mat3<V>& L, T /*dt*/) {
    advance(p, s, L);
    return stress(p, s);
  }

  template <class V, class T>
  SCREE_FN static void advance(const Params<T>&, State<V>& s, const Mat3<V>& L) {
    s.F = detail::advance_gradient(L, s.F);
  }

  template <class V, class T>
  SCREE_FN static Sym3<V> stress(const Params<T>& p, const State<V>& s) {
    const V J = det(s.F);
    const Sym3<V> shear = stretch_excess(s.F, symmetric_product(s.F), J);
    return detail::plus_diagonal(shear * broadcast<V>(2 * p.mu), p.lambda * J * (J - T(1)));
  }

  /// The principal components of the spatial acoustic tensor, A_ik = a_ijkl n_j n_l / rho0 with
  /// a_ijkl = F_jJ F_lL dP_iJ/dF_kL, are a_ii = 2 mu s_i^2 + lambda J^2,
  /// a_ijij = 2 mu s_j^2 (1 - 1/(s_i + s_j)), a_iijj + a_ijji = lambda J^2 + 2 mu s_i s_j/(s_i +
  /// s_j). With unit vectors w (motion) and n (direction), |sum_{i != k} w_i n_i w_k n_k| <= sum_{i
  /// != j} w_i^2 n_j^2, so the largest eigenvalue is below max(a_ii, a_ijij + |a_iijj + a_ijji|),
  /// which is below 2 mu max(s^2, s/2) + |lambda| J^2, s the largest stretch; equality for F = I,
  /// lambda >= 0.
  template <class V, class T>
  SCREE_FN static V wave_speed(const Params<T>& p, const State<V>& s) {
    const V square = detail::eigenvalue_bounds(symmetric_product(s.F)).upper;
    const V J = det(s.F);
    const V stiffness = (2 * p.mu) * max(square, T(0.5) * sqrt(square)) + abs(p.lambda) * J * J;
    return sqrt(stiffness * p.inverse_density);
  }

  template <class V, class T>
  SCREE_FN static V energy_density(const Params<T>& p, const State<V>& s) {
    const V change = det(s.F) - T(1);
    const V length = norm(s.F - polar_rotation(s.F));
    return p.mu * length * length + (T(0.5) * p.lambda) * change * change;
  }

  template <class V, class T>
  SCREE_FN static V volume_ratio(const Params<T>&, const State<V>& s) {
    return det(s.F);
  }

  template <class V, class T>
  SCREE_FN static MaskOf<V> admissible(const Params<T>&, const State<V>& s) {
    return det(s.F) > detail::PolarLimits<T>::det_min;
  }
};

}  // namespace scree
