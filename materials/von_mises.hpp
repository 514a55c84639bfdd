// SPDX-License-Identifier: Apache-2.0
/// \file
/// Metal, and clay without drainage: Hencky elasticity, von Mises yield, linear hardening. Radial
/// return: Simo and Hughes, Computational Inelasticity, Springer 1998, box 3.1, here in logarithmic
/// strains (Simo, Comput. Methods Appl. Mech. Eng. 99, 1992).
#pragma once

#include <limits>

#include "materials/elastic_keys.hpp"
#include "materials/hencky_solid.hpp"

namespace scree {

/// |dev tau| <= sqrt(2/3) (Y + H eps_p), associated flow; Y and H are those of a uniaxial test in
/// Kirchhoff stress and logarithmic strain. This is (1) of docs/materials/von_mises.md, its return
/// (2).
struct VonMises : HenckySolid {
  static constexpr const char* name = "von_mises";
  static constexpr bool effective_stress = true;

  struct Input {
    double youngs_modulus = std::numeric_limits<double>::quiet_NaN();  ///< Pa
    double poissons_ratio = std::numeric_limits<double>::quiet_NaN();
    double yield_stress = std::numeric_limits<double>::quiet_NaN();  ///< Pa
    double hardening_modulus = 0;                                    ///< Pa
  };

  static Schema<Input> schema() {
    Schema<Input> s(name, "Metal, or clay without drainage: von Mises yield, linear hardening.");
    elastic_keys(s);
    s.number("yield_stress", &Input::yield_stress, Unit::pressure)
        .typical(1e5)
        .above(0)
        .doc("Yield stress in uniaxial tension; twice the undrained strength of clay.");
    s.number("hardening_modulus", &Input::hardening_modulus, Unit::pressure)
        .at_least(0)
        .fallback(0.0)
        .doc("Growth of the yield stress per equivalent plastic strain.");
    s.cite(
        "Simo, Algorithms for static and dynamic multiplicative plasticity that preserve the "
        "classical return mapping schemes of the infinitesimal theory, Computer Methods in Applied "
        "Mechanics and Engineering 99, 1992, doi 10.1016/0045-7825(92)90123-2");
    return s;
  }

  template <class T>
  struct Params {
    T lambda, mu, density;
    T radius;     ///< sqrt(2/3) Y/(2 mu): the yield strain
    T hardening;  ///< sqrt(2/3) H/(2 mu)
    T softness;   ///< 1/(1 + H/(3 mu))
  };

  template <class T>
  static Params<T> params(const Input& in, double density, int /*dimension*/) {
    const auto [lambda, mu] = lame_constants(in.youngs_modulus, in.poissons_ratio);
    const double root = 0.81649658092772603;  // sqrt(2/3)
    return {T(lambda),
            T(mu),
            T(density),
            T(root * in.yield_stress / (2 * mu)),
            T(root * in.hardening_modulus / (2 * mu)),
            T(1 / (1 + in.hardening_modulus / (3 * mu)))};
  }

  template <class V>
  struct State {
    Mat3<V> F;  ///< elastic part
    V equivalent_plastic_strain, log_volume_ratio;
  };

  static std::vector<StateField> fields() {
    return {{"deformation_gradient", 9, "1", "Elastic part of the deformation gradient.", true},
            {"equivalent_plastic_strain", 1, "1",
             "Sum of sqrt(2/3) |plastic strain increment|, logarithmic.", true},
            {"log_volume_ratio", 1, "1", "ln J; plastic flow keeps the volume.", true}};
  }

  template <class V, class T>
  SCREE_FN static State<V> initial(const Params<T>&) {
    const V zero = broadcast<V>(0);
    return {identity3<V>(), zero, zero};
  }

  template <class V, class T>
  SCREE_FN static Sym3<V> kirchhoff(const Params<T>& p, State<V>& s, const Mat3<V>& L, T /*dt*/) {
    const auto trial = detail::hencky_trial(s.F, s.log_volume_ratio, L);
    const detail::StrainDeviator<V> shear(trial.strain);
    const V excess = shear.length - p.radius - p.hardening * s.equivalent_plastic_strain;
    const V flow = max(excess, broadcast<V>(0)) * p.softness;
    const V turned = flow * shear.inverse_length;
    Vec3<V> change, strain;
    SCREE_UNROLL for (int i = 0; i < 3; ++i) {
      change[i] = -(turned * shear.deviator[i]);
      strain[i] = trial.strain[i] + change[i];
    }
    s.equivalent_plastic_strain = s.equivalent_plastic_strain + T(0.81649658092772603) * flow;
    detail::change_strain(s.F, trial.axes, change);
    return detail::hencky_stress(p.lambda, p.mu, trial.axes, strain);
  }

  /// (|dev tau| - sqrt(2/3)(Y + H eps_p))/(2 mu).
  template <class V, class T>
  SCREE_FN static V yield_value(const Params<T>& p, const State<V>& s) {
    const detail::StrainDeviator<V> shear(detail::principal_strain(s.F).strain);
    return shear.length - p.radius - p.hardening * s.equivalent_plastic_strain;
  }
};

}  // namespace scree
