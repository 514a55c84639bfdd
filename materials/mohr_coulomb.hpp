// SPDX-License-Identifier: Apache-2.0
/// \file
/// Soil: Hencky elasticity with the Mohr-Coulomb pyramid, dilation, tension cut-off and softening.
/// Return map of de Souza Neto, Peric, Owen, Computational Methods for Plasticity, Wiley 2008,
/// chapters 8 and 14, in closed form.
#pragma once

#include <limits>

#include "materials/consistent_history.hpp"
#include "materials/elastic_keys.hpp"
#include "materials/hencky_solid.hpp"
#include "materials/mohr_coulomb_return.hpp"

namespace scree {

/// (tau_1 - tau_3) + (tau_1 + tau_3) sin phi <= 2 c cos phi and tau_1 <= tension_cutoff for the
/// principal Kirchhoff stresses, tension positive; flow with the dilation angle on the pyramid,
/// associated on the cut-off: (1) and (2) of docs/materials/mohr_coulomb.md. Friction, cohesion and
/// dilation may fall linearly with the equivalent plastic strain to residual values. Friction zero
/// is Tresca's law.
struct MohrCoulomb : HenckySolid {
  static constexpr const char* name = "mohr_coulomb";
  static constexpr bool effective_stress = true;

  struct Input {
    double youngs_modulus = std::numeric_limits<double>::quiet_NaN();  ///< Pa
    double poissons_ratio = std::numeric_limits<double>::quiet_NaN();
    double friction_angle = std::numeric_limits<double>::quiet_NaN();  ///< rad
    double cohesion = 0;                                               ///< Pa
    double dilation_angle = 0;                                         ///< rad
    /// Pa; NaN: none
    double tension_cutoff = std::numeric_limits<double>::quiet_NaN();
    /// Softening: none where softening_strain is NaN; the others default to the peak values.
    double residual_friction_angle = std::numeric_limits<double>::quiet_NaN();  ///< rad
    double residual_cohesion = std::numeric_limits<double>::quiet_NaN();        ///< Pa
    double residual_dilation_angle = std::numeric_limits<double>::quiet_NaN();  ///< rad
    double softening_strain = std::numeric_limits<double>::quiet_NaN();
  };

  static Schema<Input> schema();

  template <class T>
  struct Params {
    T lambda, mu, density;
    T ratio;                                  ///< lambda/(2 mu)
    detail::MohrCoulombStrength<T> strength;  ///< at the peak
    bool cuts;
    T tension;  ///< tension_cutoff/(2 mu); zero without
    bool softens;
    T friction, friction_loss;  ///< rad, in all
    T cohesion, cohesion_loss;  ///< over 2 mu
    T dilation, dilation_loss;  ///< rad
    T decay;                    ///< 1/softening_strain
    T flow_stiffness;           ///< Pa, see wave_speed
    T softening;                ///< growth of flow_stiffness with the strain, see wave_speed
  };

  template <class T>
  static Params<T> params(const Input& in, double density, int dimension);

  template <class V>
  struct State {
    Mat3<V> F;  ///< elastic part
    V equivalent_plastic_strain, log_volume_ratio;
  };

  static std::vector<StateField> fields() {
    return {{"deformation_gradient", 9, "1", "Elastic part of the deformation gradient.", true},
            {"equivalent_plastic_strain", 1, "1",
             "Sum of sqrt(2/3) |deviator of the plastic strain increment|.", true},
            {"log_volume_ratio", 1, "1", "ln J, elastic and plastic.", true}};
  }

  template <class V, class T>
  SCREE_FN static State<V> initial(const Params<T>&) {
    const V zero = broadcast<V>(0);
    return {identity3<V>(), zero, zero};
  }

  template <class V, class T>
  SCREE_FN static Sym3<V> kirchhoff(const Params<T>& p, State<V>& s, const Mat3<V>& L, T /*dt*/) {
    const auto trial = detail::hencky_trial(s.F, s.log_volume_ratio, L);
    const detail::Descending<V> order(trial.strain);
    const Return<V, T> to_surface{p, order.sorted, detail::scaled_stress(order.sorted, p.ratio)};
    Vec3<V> change;
    if (p.softens) {
      const V start = s.equivalent_plastic_strain;
      const SofteningFlow<V, T> flow{to_surface};
      s.equivalent_plastic_strain = detail::consistent_history(start, flow);
      change = to_surface(strength_at(p, s.equivalent_plastic_strain));
    } else {
      change = to_surface(p.strength);
      s.equivalent_plastic_strain = s.equivalent_plastic_strain + shear_of(change);
    }
    change = order.undo(change);
    detail::change_strain(s.F, trial.axes, change);
    return detail::hencky_stress(p.lambda, p.mu, trial.axes, trial.strain + change);
  }

  /// The larger of ((tau_1 - tau_3) + (tau_1 + tau_3) sin phi - 2 c cos phi)/(2 mu) and (tau_1 -
  /// tension_cutoff)/(2 mu).
  template <class V, class T>
  SCREE_FN static V yield_value(const Params<T>& p, const State<V>& s) {
    const detail::Descending<V> order(detail::principal_strain(s.F).strain);
    const Vec3<V> t = detail::scaled_stress(order.sorted, p.ratio);
    V value = p.softens ? detail::mohr_coulomb_excess(strength_at(p, s.equivalent_plastic_strain),
                                                      t[0], t[2])
                        : detail::mohr_coulomb_excess(p.strength, t[0], t[2]);
    if (p.cuts) value = max(value, t[0] - p.tension);
    return value;
  }

  /// Flow that is not associated can be stiffer than elasticity. In principal strains e the tangent
  /// is C - C M N C/(N C M) on a plane and r s/(s C^-1 r) on an edge, with r along the edge and s
  /// normal to both flow directions there; flow_stiffness is the largest eigenvalue of the
  /// symmetric part of any of these less C, and e_i = w_i n_i of a wave has |e| <= 1. Softening by
  /// rho = -df/dgamma/(N C M) divides this by 1 - rho; rho has a part that grows with the stress,
  /// bounded by the strains.
  template <class V, class T>
  SCREE_FN static V wave_speed(const Params<T>& p, const State<V>& s) {
    const auto bounds = detail::strain_bounds(s.F);
    V flow = broadcast<V>(p.flow_stiffness);
    if (p.softens) {
      const V loss = min(p.softening * bounds.size, broadcast<V>(T(detail::largest_softening)));
      flow = flow / (T(1) - loss);
    }
    const V stiffness = detail::hencky_stiffness(p.lambda, p.mu, bounds) + flow;
    return sqrt(stiffness * (T(1) / p.density));
  }

 private:
  /// Equivalent plastic strain of a plastic strain.
  template <class V>
  SCREE_FN static V shear_of(const Vec3<V>& change) {
    using T = Scalar<V>;
    const V mean = (change[0] + change[1] + change[2]) * T(1.0 / 3.0);
    const Vec3<V> d = {{change[0] - mean, change[1] - mean, change[2] - mean}};
    const V square = T(2.0 / 3.0) * dot(d, d);
    return square * rsqrt(max(square, broadcast<V>(sizeof(T) == 4 ? T(1e-30) : T(1e-200))));
  }

  template <class V, class T>
  SCREE_FN static detail::MohrCoulombStrength<V> strength_at(const Params<T>& p, V plastic_strain) {
    const V part = min(plastic_strain * p.decay, broadcast<V>(1));
    const V friction = sin(p.friction - p.friction_loss * part);
    const V cosine = sqrt(max(T(1) - friction * friction, broadcast<V>(0)));
    const V dilation = sin(p.dilation - p.dilation_loss * part);
    return detail::mohr_coulomb_strength(friction, cosine, dilation,
                                         p.cohesion - p.cohesion_loss * part, p.ratio);
  }

  /// Change of the sorted trial strains by the whole return: sides and edges, apex, cut-off.
  template <class V, class T>
  struct Return {
    const Params<T>& p;
    Vec3<V> strain, stress;  ///< sorted; stress over 2 mu

    template <class S>
    SCREE_FN Vec3<V> operator()(const detail::MohrCoulombStrength<S>& k) const {
      Vec3<V> change = detail::return_to_sides(k, stress);
      const V volume = p.ratio * (change[0] + change[1] + change[2]);
      const V largest = stress[0] + change[0] + volume;
      const auto beyond = largest > k.apex;
      const auto at_apex = (T(1) / (T(1) + T(3) * p.ratio)) * k.apex;
      SCREE_UNROLL for (int i = 0; i < 3; ++i) change[i] =
          select(beyond, at_apex - strain[i], change[i]);
      if (p.cuts) {
        const auto torn = min(largest, broadcast<V>(0) + k.apex) > p.tension;
        const Vec3<V> t = detail::return_to_tension(k, p.ratio, p.tension, strain, stress);
        const V mean = (p.ratio / (T(1) + T(3) * p.ratio)) * (t[0] + t[1] + t[2]);
        SCREE_UNROLL for (int i = 0; i < 3; ++i) change[i] =
            select(torn, t[i] - mean - strain[i], change[i]);
      }
      return change;
    }
  };

  /// Plastic strain of the return with the strength at a history.
  template <class V, class T>
  struct SofteningFlow {
    const Return<V, T>& to_surface;
    SCREE_FN V operator()(V plastic_strain) const {
      return shear_of(to_surface(strength_at(to_surface.p, plastic_strain)));
    }
  };
};

}  // namespace scree

#include "materials/mohr_coulomb_params.hpp"
