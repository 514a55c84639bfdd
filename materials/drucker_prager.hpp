// SPDX-License-Identifier: Apache-2.0
/// \file
/// Sand: Hencky elasticity with a Drucker-Prager cone in strain form.
/// Klar, Gast, Pradhana, Fu, Schroeder, Jiang, Teran, Drucker-Prager elastoplasticity for sand
/// animation, ACM TOG 35(4), 2016; volume correction of Tampubolon et al., Multi-species simulation
/// of porous sand and water mixtures, ACM TOG 36(4), 2017.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "materials/cone_match.hpp"
#include "materials/consistent_history.hpp"
#include "materials/friction_hardening.hpp"
#include "materials/hencky_solid.hpp"
#include "solver/base/anew.hpp"

namespace scree {

/// tau = U diag(2 mu ln S_i + lambda tr ln S) U^T; cone q = M p + k with M from friction angle and
/// match, tensile tip at p = -c cot phi. Differences to the paper: always the three-dimensional
/// return (also in plane strain), cohesion in Pa, dilation, choice of the cone; the volume
/// correction is reset when the grains are in contact again, so a cycle of expansion and equal
/// compression ends free of stress. With the keys h0 to h3 the friction angle depends on the
/// plastic shear strain q of the same step (the paper: of the steps before), and opening does not
/// count in q; the tip stays where the first friction angle puts it. Numbers of equations below are
/// those of docs/materials/drucker_prager.md: the cone is (1), the return (2) to (5).
struct DruckerPrager : HenckySolid {
  static constexpr const char* name = "drucker_prager";
  static constexpr bool effective_stress = true;

  struct Input {
    double youngs_modulus = std::numeric_limits<double>::quiet_NaN();  ///< Pa
    double poissons_ratio = std::numeric_limits<double>::quiet_NaN();
    double friction_angle = std::numeric_limits<double>::quiet_NaN();  ///< rad
    double cohesion = 0;                                               ///< Pa
    double dilation_angle = 0;                                         ///< rad
    Match match = Match::by_dimension;
    /// Friction hardening, all or none: h0, h1, h3 in rad.
    double h0 = std::numeric_limits<double>::quiet_NaN();
    double h1 = std::numeric_limits<double>::quiet_NaN();
    double h2 = std::numeric_limits<double>::quiet_NaN();
    double h3 = std::numeric_limits<double>::quiet_NaN();

    FrictionHardening hardening() const { return {h0, h1, h2, h3}; }
  };

  static Schema<Input> schema();

  template <class T>
  struct Params {
    T lambda, mu, inverse_density;
    T cone;             ///< (3 lambda + 2 mu)/(2 mu) alpha
    T dilation;         ///< a
    T consistency;      ///< 1/(1 + 9 K alpha a/(2 mu))
    T cohesion_strain;  ///< c_s = c cot phi/(3 lambda + 2 mu)
    T flow_stiffness;  ///< 9 K^2 (alpha - a)^2/(8 mu (1 + 9 K alpha a/(2 mu))) [Pa], see wave_speed
    bool hardens;
    T h0, h1, h2, h3;       ///< of hardening; zero without
    T scale, base, change;  ///< cone = scale sin(phi)/(base + change sin(phi))
    T softening;            ///< largest loss of the cone slope per plastic strain, times 3
  };

  template <class T>
  static Params<T> params(const Input& in, double density, int dimension) {
    const auto [lambda, mu] = lame_constants(in.youngs_modulus, in.poissons_ratio);
    const Match match = resolve_match(in.match, dimension);
    const FrictionHardening h = in.hardening();
    const bool hardens = h.given();
    const double first = hardens ? h.angle(0) : in.friction_angle;
    const double highest = hardens ? h.highest_angle() : in.friction_angle;
    const double a = dilation_slope(match, in.dilation_angle);
    const FrictionSlope slope = friction_slope(match, a);
    const double three_bulk = 3 * lambda + 2 * mu, ratio = three_bulk / (2 * mu);
    const double alpha = slope(std::sin(first)), most = slope(std::sin(highest));
    const double flow =
        three_bulk * three_bulk * (most - a) * (most - a) / (8 * mu) / (1 + 3 * ratio * most * a);
    const double steepest = slope.scale / slope.base *
                            std::max(1.0, std::pow(slope.base / (slope.base + slope.change), 2));
    return {T(lambda),
            T(mu),
            T(1) / T(density),
            T(ratio * alpha),
            T(a),
            T(1 / (1 + 3 * ratio * alpha * a)),
            T(in.cohesion / std::tan(first) / three_bulk),
            T(flow),
            hardens,
            T(hardens ? h.h0 : 0),
            T(hardens ? h.h1 : 0),
            T(hardens ? h.h2 : 0),
            T(hardens ? h.h3 : 0),
            T(ratio * slope.scale),
            T(slope.base),
            T(slope.change),
            T(hardens ? 3 * ratio * steepest * h.steepest_loss() : 0)};
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
    // 1. Trial state, and its distance to the cone in the strain measured from the cone's tip.
    const auto trial = detail::hencky_trial(s.F, s.log_volume_ratio, L);
    const detail::StrainDeviator<V> shear(trial.strain);
    const V gap = s.volume_correction * T(1.0 / 3.0);
    const V mean = shear.mean + (gap - p.cohesion_strain);
    // 2. Plastic shear strain, (2): to the tip where the cone's return would pass it, |ehat| < dg,
    // which is mean > a |ehat| whatever the cone; else to the cone (flow n + a I), or nothing.
    const auto tip = mean >= p.dilation * shear.length;
    const Flow<V, T> flow_at{p, mean, shear.length, tip};
    V flow;
    if (p.hardens) {
      const V start = s.equivalent_plastic_strain * T(1.2247448713915890);
      const V end = detail::consistent_history(start, flow_at);
      flow = flow_at(end);
      s.equivalent_plastic_strain = end * T(0.81649658092772603);
    } else {
      flow = flow_at.on(p.cone, p.consistency);
      s.equivalent_plastic_strain = s.equivalent_plastic_strain + T(0.81649658092772603) * flow;
    }
    // 3. Elastic strain, (3) to (5). At the tip, what dilation does not explain opens a gap.
    const V opening = mean - p.dilation * shear.length;
    const V closing = gap - p.dilation * flow;
    const V turned = flow * shear.inverse_length;
    const V at = anew(shear.mean);  // else the deviator waits while step 2 iterates
    Vec3<V> change, strain;
    SCREE_UNROLL for (int i = 0; i < 3; ++i) {
      change[i] = select(tip, p.cohesion_strain - trial.strain[i],
                         closing - turned * (trial.strain[i] - at));
      strain[i] = trial.strain[i] + change[i];
    }
    s.volume_correction = select(tip, T(3) * opening, T(0));
    detail::change_strain(s.F, trial.axes, change);
    return detail::hencky_stress(p.lambda, p.mu, trial.axes, strain);
  }

  /// (|dev tau| - 3 alpha (p + c cot phi))/(2 mu).
  template <class V, class T>
  SCREE_FN static V yield_value(const Params<T>& p, const State<V>& s) {
    const detail::StrainDeviator<V> shear(detail::principal_strain(s.F).strain);
    V cone = broadcast<V>(p.cone);
    if (p.hardens) cone = cone_at(p, s.equivalent_plastic_strain * T(1.2247448713915890));
    return shear.length + T(3) * cone * (shear.mean - p.cohesion_strain);
  }

  /// Flow that is not associated can be stiffer than elasticity: on the cone, the work of a small
  /// strain w with x = n : w, t = tr w changes by -(x + cone t)(2 mu x + 3 K a t) consistency, at
  /// most flow_stiffness t^2, and |t| <= 1 for a wave. (Unloading of an oedometer at failure, K (1
  /// + 2 M/3) against K + 4 mu/3 in elasticity, is such a case.) flow_stiffness grows with alpha:
  /// under hardening it is that of the highest friction angle; loss of friction divides it by 1 -
  /// 3 dcone/dq |mean|.
  template <class V, class T>
  SCREE_FN static V wave_speed(const Params<T>& p, const State<V>& s) {
    const auto bounds = detail::strain_bounds(s.F);
    V flow = broadcast<V>(p.flow_stiffness);
    if (p.hardens) {
      const V loss = min(p.softening * (bounds.size + p.cohesion_strain),
                         broadcast<V>(T(detail::largest_softening)));
      flow = flow / (T(1) - loss);
    }
    const V stiffness = detail::hencky_stiffness(p.lambda, p.mu, bounds) + flow;
    return sqrt(stiffness * p.inverse_density);
  }

 private:
  /// Slope of the cone after the plastic shear strain q.
  template <class V, class T>
  SCREE_FN static V cone_at(const Params<T>& p, V q) {
    const V sine = sin(p.h0 + (p.h1 * q - p.h3) * exp(-p.h2 * q));
    return p.scale * sine * rcp(p.base + p.change * sine);
  }

  /// Length of the plastic strain's deviator, as a function of cone or history.
  template <class V, class T>
  struct Flow {
    const Params<T>& p;
    V mean, length;
    MaskOf<V> tip;

    template <class S>
    SCREE_FN V on(S cone, S consistency) const {
      const V excess = (length + cone * (T(3) * mean)) * consistency;
      return select(tip, length, max(excess, broadcast<V>(0)));
    }
    SCREE_FN V operator()(V q) const {
      const V cone = cone_at(p, q);
      return on(cone, rcp(T(1) + T(3) * p.dilation * cone));
    }
  };
};

}  // namespace scree

#include "materials/drucker_prager_schema.hpp"
