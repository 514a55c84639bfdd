// SPDX-License-Identifier: Apache-2.0
/// \file
/// Compressible neo-Hookean elasticity in the form that the literature of manufactured solutions
/// uses: Bonet, Wood, Nonlinear Continuum Mechanics for Finite Element Analysis, 2nd ed., Cambridge
/// 2008, section 6.4.3.
#pragma once

#include <limits>

#include "materials/elastic_keys.hpp"
#include "materials/material.hpp"
#include "solver/base/math.hpp"
#include "solver/base/polar.hpp"

namespace scree {

/// psi = mu/2 (tr b - 3) - mu ln J + lambda/2 (ln J)^2,  tau = mu (b - I) + lambda ln J I: (1) and
/// (2) of docs/materials/neo_hookean.md.
struct NeoHookean {
  static constexpr const char* name = "neo_hookean";
  static constexpr bool effective_stress = true;

  struct Input {
    double youngs_modulus = std::numeric_limits<double>::quiet_NaN();  ///< Pa
    double poissons_ratio = std::numeric_limits<double>::quiet_NaN();
  };

  static Schema<Input> schema() {
    Schema<Input> s(name, "Elastic solid, rubber-like: compressible neo-Hookean hyperelasticity.");
    elastic_keys(s);
    s.cite(
        "Bonet, Wood, Nonlinear Continuum Mechanics for Finite Element Analysis, 2nd ed., "
        "Cambridge University Press 2008, doi 10.1017/CBO9780511755446");
    return s;
  }

  template <class T>
  struct Params {
    T lambda, mu, density;
  };

  template <class T>
  static Params<T> params(const Input& in, double density, int /*dimension*/) {
    const LameConstants c = lame_constants(in.youngs_modulus, in.poissons_ratio);
    return {T(c.lambda), T(c.mu), T(density)};
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
    const Sym3<V> strain = detail::plus_diagonal(symmetric_product(s.F), broadcast<V>(T(-1)));
    return detail::plus_diagonal(strain * broadcast<V>(p.mu), p.lambda * log_volume(s.F));
  }

  /// With a_ijkl = F_jJ F_lL dP_iJ/dF_kL the acoustic tensor of a wave along n is exactly mu (n.b
  /// n) I + (mu + lambda (1 - ln J)) n n^T.
  template <class V, class T>
  SCREE_FN static V wave_speed(const Params<T>& p, const State<V>& s) {
    const V square = detail::eigenvalue_bounds(symmetric_product(s.F)).upper;
    const V along = p.mu + p.lambda * (T(1) - log_volume(s.F));
    return sqrt((p.mu * square + max(along, broadcast<V>(T(0)))) * (T(1) / p.density));
  }

  template <class V, class T>
  SCREE_FN static V energy_density(const Params<T>& p, const State<V>& s) {
    const V logarithm = log_volume(s.F);
    const V squares = trace(symmetric_product(s.F)) - T(3);
    return p.mu * (T(0.5) * squares - logarithm) + (T(0.5) * p.lambda) * logarithm * logarithm;
  }

  template <class V, class T>
  SCREE_FN static V volume_ratio(const Params<T>&, const State<V>& s) {
    return det(s.F);
  }

  template <class V, class T>
  SCREE_FN static MaskOf<V> admissible(const Params<T>&, const State<V>& s) {
    return det(s.F) > detail::PolarLimits<T>::det_min;
  }

 private:
  /// ln J; J is kept positive where F is not admissible.
  template <class V>
  SCREE_FN static V log_volume(const Mat3<V>& f) {
    return log(max(det(f), broadcast<V>(detail::PolarLimits<Scalar<V>>::det_min)));
  }
};

}  // namespace scree
