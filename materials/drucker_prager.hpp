// SPDX-License-Identifier: Apache-2.0
/// \file
/// Sand: Hencky elasticity with a Drucker-Prager cone in strain form.
/// Klar, Gast, Pradhana, Fu, Schroeder, Jiang, Teran, Drucker-Prager elastoplasticity for sand
/// animation, ACM TOG 35(4), 2016; volume correction of Tampubolon et al., Multi-species simulation
/// of porous sand and water mixtures, ACM TOG 36(4), 2017.
#pragma once

#include <limits>
#include <optional>

#include "materials/cone_match.hpp"
#include "materials/material.hpp"
#include "solver/base/eigen.hpp"
#include "solver/base/math.hpp"
#include "solver/base/polar.hpp"

namespace scree {

/// tau = U diag(2 mu ln S_i + lambda tr ln S) U^T; cone q = M p + k with M from friction angle and
/// match, tensile tip at p = -c cot phi. Differences to the paper: always the three-dimensional
/// return (also in plane strain), cohesion in Pa, dilation, choice of the cone; the volume
/// correction is reset when the grains are in contact again, so a cycle of expansion and equal
/// compression ends free of stress.
struct DruckerPrager {
  static constexpr const char* name = "drucker_prager";
  static constexpr bool effective_stress = true;

  struct Input {
    double youngs_modulus = std::numeric_limits<double>::quiet_NaN();  ///< Pa
    double poissons_ratio = std::numeric_limits<double>::quiet_NaN();
    double friction_angle = std::numeric_limits<double>::quiet_NaN();  ///< rad
    double cohesion = 0;                                               ///< Pa
    double dilation_angle = 0;                                         ///< rad
    Match match = Match::by_dimension;
  };

  static Schema<Input> schema();

  template <class T>
  struct Params {
    T lambda, mu, density;
    T cone;             ///< (3 lambda + 2 mu)/(2 mu) alpha
    T dilation;         ///< a
    T consistency;      ///< 1/(1 + 9 K alpha a/(2 mu))
    T cohesion_strain;  ///< c_s = c cot phi/(3 lambda + 2 mu)
    T flow_stiffness;  ///< 9 K^2 (alpha - a)^2/(8 mu (1 + 9 K alpha a/(2 mu))) [Pa], see wave_speed
  };

  template <class T>
  static Params<T> params(const Input& in, double density, int dimension) {
    const auto [lambda, mu] = lame_constants(in.youngs_modulus, in.poissons_ratio);
    const Match match = resolve_match(in.match, dimension);
    const auto [alpha, a] = cone_slopes(match, in.friction_angle, in.dilation_angle);
    const double three_bulk = 3 * lambda + 2 * mu;
    const double consistency = 1 / (1 + 3 * three_bulk * alpha * a / (2 * mu));
    return {T(lambda),
            T(mu),
            T(density),
            T(three_bulk / (2 * mu) * alpha),
            T(a),
            T(consistency),
            T(in.cohesion / std::tan(in.friction_angle) / three_bulk),
            T(three_bulk * three_bulk * (alpha - a) * (alpha - a) / (8 * mu) * consistency)};
  }

  template <class V>
  struct State {
    Mat3<V> F;  ///< elastic part
    V volume_correction, equivalent_plastic_strain, log_volume_ratio;
  };

  static std::vector<StateField> fields() {
    return {
        {"deformation_gradient", 9, "1", "Elastic part of the deformation gradient.", true},
        {"volume_correction", 1, "1", "Logarithmic volume strain of grains out of contact.", true},
        {"equivalent_plastic_strain", 1, "1",
         "Sum of sqrt(2/3) |deviator of the plastic strain increment|.", true},
        {"log_volume_ratio", 1, "1", "ln J, elastic and plastic.", true}};
  }

  template <class V, class T>
  SCREE_FN static State<V> initial(const Params<T>&) {
    const V zero = broadcast<V>(0);
    return {identity3<V>(), zero, zero, zero};
  }

  template <class V, class T>
  SCREE_FN static Sym3<V> kirchhoff(const Params<T>& p, State<V>& s, const Mat3<V>& L, T /*dt*/) {
    // 1. Trial state: principal logarithmic strains of b = F F^T (V of the SVD is not needed).
    s.F = detail::advance_gradient(L, s.F);
    s.log_volume_ratio = s.log_volume_ratio + log_determinant(L);
    const SymEigen<V> b = eigen_symmetric(symmetric_product(s.F));
    const Vec3<V> trial = log_stretches(b);
    // 2. Distance to the cone in the strain e that is measured from the cone's tip.
    const V shift = s.volume_correction * T(1.0 / 3.0) - p.cohesion_strain;
    const V mean = (trial[0] + trial[1] + trial[2]) * T(1.0 / 3.0) + shift;
    const Vec3<V> deviator = {
        {trial[0] + shift - mean, trial[1] + shift - mean, trial[2] + shift - mean}};
    // The small number only keeps 0/0 away; strains are far above its root or zero.
    const V square = dot(deviator, deviator) + (sizeof(T) == 4 ? T(1e-30) : T(1e-200));
    const V inverse_length = rsqrt(square);
    const V length = square * inverse_length;
    const V excess = (length + p.cone * (T(3) * mean)) * p.consistency;
    const auto tip = mean >= T(0);
    // 3. Return to the tip, to the cone (flow n + a I), or nothing: `flow` and `dilation` are zero
    // then.
    const V flow = select(tip, T(0), max(excess, broadcast<V>(0)));
    const V turned = flow * inverse_length;
    const V closing = s.volume_correction * T(1.0 / 3.0) - p.dilation * flow;
    Vec3<V> change, strain;
    SCREE_UNROLL for (int i = 0; i < 3; ++i) {
      change[i] = select(tip, p.cohesion_strain - trial[i], closing - turned * deviator[i]);
      strain[i] = trial[i] + change[i];
    }
    s.equivalent_plastic_strain =
        s.equivalent_plastic_strain + T(0.81649658092772603) * select(tip, length, flow);
    s.volume_correction = select(tip, T(3) * mean, T(0));
    // 4. F <- U diag(S'/S) U^T F, written as an increment: an elastic step leaves F alone to the
    // bit.
    const Vec3<V> factor = {{expm1(change[0]), expm1(change[1]), expm1(change[2])}};
    s.F = s.F + from_principal(b.vectors, factor) * s.F;
    const V pressure = p.lambda * (strain[0] + strain[1] + strain[2]);
    const T two_mu = 2 * p.mu;
    return from_principal(b.vectors,
                          Vec3<V>{{two_mu * strain[0] + pressure, two_mu * strain[1] + pressure,
                                   two_mu * strain[2] + pressure}});
  }

  /// As for FixedCorotated, with tau_i = 2 mu e_i + lambda tr e, e = ln S: a_ii = 2 mu + lambda -
  /// tau_i, a_ijij = mu y/(exp(y) - 1) with y = 2 (e_i - e_j), and with x = e_i - e_j a_iijj +
  /// a_ijji = lambda (1 - tr e) + mu (x coth x - e_i - e_j). For |e_i| <= e and |e_i - e_j| <= r,
  /// since x coth x <= 1 + x^2/3, the largest eigenvalue is below |lambda| (1 + 3 e) + mu (2 + 2 e
  /// + r + 2 r^2/3). The strains are bounded by 2 ln S <= S^2 - 1 and 2 ln S >= 1 - S^-2.
  ///
  /// Flow that is not associated can be stiffer than elasticity: on the cone, the work of a small
  /// strain w with x = n : w, t = tr w changes by -(x + cone t)(2 mu x + 3 K a t) consistency, at
  /// most flow_stiffness t^2, and |t| <= 1 for a wave. (Unloading of an oedometer at failure, K (1
  /// + 2 M/3) against K + 4 mu/3 in elasticity, is such a case.)
  template <class V, class T>
  SCREE_FN static V wave_speed(const Params<T>& p, const State<V>& s) {
    const V floor = broadcast<V>(detail::PolarLimits<T>::det_min);
    const auto bounds = detail::eigenvalue_bounds(symmetric_product(s.F));
    const V upper = max(bounds.upper, floor);
    const V ratio = det(s.F) / upper;
    const V lower = max(max(bounds.lower, ratio * ratio), floor);
    const V stretch = T(0.5) * (upper - T(1)), squeeze = T(0.5) / lower - T(0.5);
    const V e = max(stretch, squeeze), r = stretch + squeeze;
    const V shear = T(2) + T(2) * e + r + T(2.0 / 3.0) * r * r;
    const V stiffness = abs(p.lambda) * (T(1) + T(3) * e) + p.mu * shear + p.flow_stiffness;
    return sqrt(stiffness * (T(1) / p.density));
  }

  template <class V, class T>
  SCREE_FN static V energy_density(const Params<T>& p, const State<V>& s) {
    const Vec3<V> strain = log_stretches(eigen_symmetric(symmetric_product(s.F)));
    const V sum = strain[0] + strain[1] + strain[2];
    return p.mu * dot(strain, strain) + (T(0.5) * p.lambda) * sum * sum;
  }

  template <class V, class T>
  SCREE_FN static V volume_ratio(const Params<T>&, const State<V>& s) {
    return exp(s.log_volume_ratio);
  }

  template <class V, class T>
  SCREE_FN static MaskOf<V> admissible(const Params<T>&, const State<V>& s) {
    return det(s.F) > detail::PolarLimits<T>::det_min;
  }

 private:
  /// ln det(I + L), to full relative accuracy for small L.
  template <class V>
  SCREE_FN static V log_determinant(const Mat3<V>& L) {
    using T = Scalar<V>;
    const V minors = L(0, 0) * L(1, 1) - L(0, 1) * L(1, 0) + L(1, 1) * L(2, 2) - L(1, 2) * L(2, 1) +
                     L(2, 2) * L(0, 0) - L(2, 0) * L(0, 2);
    const V growth = trace(L) + minors + det(L);
    return log1p(max(growth, broadcast<V>(T(-0.999))));  // a limit that no admissible step reaches
  }

  /// ln S_i = ln(b_i)/2; b_i is kept positive where rounding or an inadmissible F made it vanish.
  template <class V>
  SCREE_FN static Vec3<V> log_stretches(const SymEigen<V>& b) {
    using T = Scalar<V>;
    const V tiny = broadcast<V>(sizeof(T) == 4 ? T(1e-12) : T(1e-28));
    Vec3<V> r;
    SCREE_UNROLL for (int i = 0; i < 3; ++i) r[i] = T(0.5) * log(max(b.values[i], tiny));
    return r;
  }
};

}  // namespace scree

#include "materials/drucker_prager_schema.hpp"
