// SPDX-License-Identifier: Apache-2.0
/// \file
/// Hencky elasticity: stress linear in the logarithmic strain.
#pragma once

#include <limits>

#include "materials/elastic_keys.hpp"
#include "materials/hencky_solid.hpp"

namespace scree {

/// psi = mu |ln S|^2 + lambda/2 (ln J)^2,  tau = U diag(2 mu ln S_i + lambda ln J) U^T: (1) of
/// docs/materials/hencky.md.
struct Hencky : HenckySolid {
  static constexpr const char* name = "hencky";
  static constexpr bool effective_stress = true;

  struct Input {
    double youngs_modulus = std::numeric_limits<double>::quiet_NaN();  ///< Pa
    double poissons_ratio = std::numeric_limits<double>::quiet_NaN();
  };

  static Schema<Input> schema() {
    Schema<Input> s(name, "Elastic solid, linear in the logarithmic strain.");
    elastic_keys(s);
    s.cite(
        "Hencky, Ueber die Form des Elastizitaetsgesetzes bei ideal elastischen Stoffen, "
        "Zeitschrift fuer technische Physik 9, 1928");
    return s;
  }

  template <class T>
  struct Params {
    T lambda, mu, density;
  };

  template <class T>
  static Params<T> params(const Input& in, double density, int /*dimension*/) {
    const auto [lambda, mu] = lame_constants(in.youngs_modulus, in.poissons_ratio);
    return {T(lambda), T(mu), T(density)};
  }

  template <class V>
  struct State {
    Mat3<V> F;
    V log_volume_ratio;
  };

  static std::vector<StateField> fields() {
    return {{"deformation_gradient", 9, "1", "Deformation gradient F.", true},
            {"log_volume_ratio", 1, "1", "ln J.", true}};
  }

  template <class V, class T>
  SCREE_FN static State<V> initial(const Params<T>&) {
    return {identity3<V>(), broadcast<V>(0)};
  }

  template <class V, class T>
  SCREE_FN static Sym3<V> kirchhoff(const Params<T>& p, State<V>& s, const Mat3<V>& L, T /*dt*/) {
    advance(p, s, L);
    return stress(p, s);
  }

  template <class V, class T>
  SCREE_FN static void advance(const Params<T>&, State<V>& s, const Mat3<V>& L) {
    detail::hencky_advance(s.F, s.log_volume_ratio, L);
  }

  template <class V, class T>
  SCREE_FN static Sym3<V> stress(const Params<T>& p, const State<V>& s) {
    const auto principal = detail::principal_strain(s.F);
    return detail::hencky_stress(p.lambda, p.mu, principal.axes, principal.strain);
  }
};

}  // namespace scree
