// SPDX-License-Identifier: Apache-2.0
/// \file
/// Dense granular flow: Jop, Forterre, Pouliquen, A constitutive law for dense granular flows,
/// Nature 441, 2006; elastic-plastic form and closed-form return of Dunatunga, Kamrin, Continuum
/// modelling and simulation of granular flows through their many phases, J. Fluid Mech. 779, 2015.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "materials/elastic_keys.hpp"
#include "materials/hencky_solid.hpp"

namespace scree {

/// mu(I) = mu_s + (mu_2 - mu_s)/(1 + i0/I),  I = g d/sqrt(p/rho_s): (1) of docs/materials/mu_i.md,
/// whose (2) is the flow below and (3) the implicit step.
///
/// Norms: the shear stress is |tau| = sqrt(s:s/2), the shear rate g = sqrt(2 D:D) with D the
/// deviatoric plastic rate of strain, both those of simple shear; flow obeys |tau| = mu(I) p, which
/// in triaxial invariants is q = sqrt(3) mu(I) p. Stresses are Kirchhoff's: their ratio is that of
/// Cauchy's, and in grains that touch, J is 1 to within p/K.
///
/// Elasticity is Hencky's, flow keeps the volume. Grains out of contact (trial pressure below
/// zero) are free of stress; the volume they have gained is remembered and must be given back
/// before they touch again, as in DruckerPrager. The solid fraction is density/(grain_density J);
/// it does not depend on I.
struct MuI : HenckySolid {
  static constexpr const char* name = "mu_i";

  struct Input {
    double youngs_modulus = std::numeric_limits<double>::quiet_NaN();  ///< Pa
    double poissons_ratio = std::numeric_limits<double>::quiet_NaN();
    double mu_s = std::numeric_limits<double>::quiet_NaN();
    double mu_2 = std::numeric_limits<double>::quiet_NaN();
    double i0 = std::numeric_limits<double>::quiet_NaN();
    double grain_diameter = std::numeric_limits<double>::quiet_NaN();  ///< m
    double grain_density = std::numeric_limits<double>::quiet_NaN();   ///< kg/m^3
  };

  static Schema<Input> schema();

  /// K0 of one-dimensional compression: elastic, or as much as slow flow leaves, q = sqrt(3) mu_s
  /// p with q over p = 3 (1 - K0)/(1 + 2 K0).
  static double rest_ratio(const Input& in) {
    const double slope = std::sqrt(3.0) * in.mu_s;
    return std::max(in.poissons_ratio / (1 - in.poissons_ratio), (3 - slope) / (3 + 2 * slope));
  }
  static std::optional<Finding> density_fault(const Input& in, double density);

  template <class T>
  struct Params {
    T lambda, mu, density;
    T three_bulk;  ///< 3 K
    T mu_s, mu_2;
    T rate;            ///< mu i0/(d sqrt(rho_s)): times sqrt(p) it is a [Pa/s], see kirchhoff
    T grain_volume;    ///< rho_s/rho0 = 1 + initial void ratio
    T flow_stiffness;  ///< K^2 mu_2^2/(4 mu) [Pa], see wave_speed
  };

  template <class T>
  static Params<T> params(const Input& in, double density, int /*dimension*/) {
    const auto [lambda, mu] = lame_constants(in.youngs_modulus, in.poissons_ratio);
    const double bulk = lambda + 2 * mu / 3;
    return {T(lambda),
            T(mu),
            T(density),
            T(3 * bulk),
            T(in.mu_s),
            T(in.mu_2),
            T(mu * in.i0 / (in.grain_diameter * std::sqrt(in.grain_density))),
            T(in.grain_density / density),
            T(bulk * bulk * in.mu_2 * in.mu_2 / (4 * mu))};
  }

  template <class V>
  struct State {
    Mat3<V> F;  ///< elastic part
    V volume_correction, plastic_shear_rate, equivalent_plastic_strain, log_volume_ratio;
  };

  static std::vector<StateField> fields() {
    return {
        {"deformation_gradient", 9, "1", "Elastic part of the deformation gradient.", true},
        {"volume_correction", 1, "1", "Logarithmic volume strain of grains out of contact.", true},
        {"plastic_shear_rate", 1, "1/s", "sqrt(2 D:D) of the plastic flow of the last step.", true},
        {"equivalent_plastic_strain", 1, "1",
         "Sum of sqrt(2/3) |deviator of the plastic strain increment|.", true},
        {"log_volume_ratio", 1, "1", "ln J, elastic and plastic.", true}};
  }

  template <class V, class T>
  SCREE_FN static State<V> initial(const Params<T>&) {
    const V zero = broadcast<V>(0);
    return {identity3<V>(), zero, zero, zero, zero};
  }

  template <class V, class T>
  SCREE_FN static Sym3<V> kirchhoff(const Params<T>& p, State<V>& s, const Mat3<V>& L, T dt) {
    constexpr T root_two = T(1.4142135623730951);
    // 1. Trial state: strains measured from where the grains begin to touch.
    const auto trial = detail::hencky_trial(s.F, s.log_volume_ratio, L);
    const V gap = s.volume_correction * T(1.0 / 3.0);
    const Vec3<V> touching = {
        {trial.strain[0] + gap, trial.strain[1] + gap, trial.strain[2] + gap}};
    const detail::StrainDeviator<V> e(touching);
    const auto apart = e.mean >= T(0);
    // 2. Shear stress after the step, and the plastic strain that takes off the rest.
    const V pressure = max(-p.three_bulk * e.mean, broadcast<V>(T(0)));
    const V shear = (root_two * p.mu) * e.length;
    const V flow = (shear - flowing_stress(p, shear, pressure, dt)) * (T(1) / (root_two * p.mu));
    const V turned = flow * e.inverse_length;
    Vec3<V> change, strain;
    SCREE_UNROLL for (int i = 0; i < 3; ++i) {
      change[i] = select(apart, -trial.strain[i], gap - turned * e.deviator[i]);
      strain[i] = trial.strain[i] + change[i];
    }
    // 3. History.
    const V slid = select(apart, e.length, flow);
    s.equivalent_plastic_strain = s.equivalent_plastic_strain + T(0.81649658092772603) * slid;
    if (dt > T(0)) s.plastic_shear_rate = slid * (root_two / dt);
    s.volume_correction = select(apart, T(3) * e.mean, T(0));
    detail::change_strain(s.F, trial.axes, change);
    return detail::hencky_stress(p.lambda, p.mu, trial.axes, strain);
  }

  /// Elastic waves as for Hencky; flow at constant volume is not associated and may be stiffer than
  /// elasticity, as explained at DruckerPrager::wave_speed, here by K^2 M^2/(12 mu) with M =
  /// sqrt(3) mu_2, the steepest slope of q over p. The viscosity of the flow is no limit of the
  /// time step: it is integrated implicitly.
  template <class V, class T>
  SCREE_FN static V wave_speed(const Params<T>& p, const State<V>& s) {
    const V stiffness = detail::hencky_stiffness(p.lambda, p.mu, detail::strain_bounds(s.F));
    return sqrt((stiffness + p.flow_stiffness) * (T(1) / p.density));
  }

  /// (|tau| - mu_2 p)/mu, mu the shear modulus: distance to the surface of the fastest flow, which
  /// no state exceeds. (Slower flow lies between mu_s p and mu_2 p.)
  template <class V, class T>
  SCREE_FN static V yield_value(const Params<T>& p, const State<V>& s) {
    const detail::StrainDeviator<V> e(detail::principal_strain(s.F).strain);
    return T(1.4142135623730951) * e.length + (p.mu_2 * p.three_bulk / p.mu) * e.mean;
  }

  /// Pore volume over grain volume.
  template <class V, class T>
  SCREE_FN static V void_ratio(const Params<T>& p, const State<V>& s) {
    return p.grain_volume * exp(s.log_volume_ratio) - T(1);
  }

 private:
  /// Shear stress t after a step from the trial value t*. With t = t* - mu dt g, and mu(I) solved
  /// for the rate, g = i0 sqrt(p/rho_s)/d (t - mu_s p)/(mu_2 p - t): t is the smaller root of (t* -
  /// t)(mu_2 p - t) = a (t - mu_s p), a = mu dt i0 sqrt(p/rho_s)/d (Dunatunga, Kamrin 2015). The
  /// discriminant is written as a sum of positive terms; in dt = 0 the root is t* itself.
  template <class V, class T>
  SCREE_FN static V flowing_stress(const Params<T>& p, V trial, V pressure, T dt) {
    const V slow = p.mu_s * pressure, fast = p.mu_2 * pressure;
    const V a = (p.rate * dt) * sqrt(pressure);
    const V distance = fast - trial;
    const V above = max(trial - slow, broadcast<V>(T(0)));
    const V discriminant = distance * distance + a * (a + T(2) * (above + (fast - slow)));
    const V sum = fast + trial + a + sqrt(discriminant);
    const V product = fast * trial + slow * a;
    const V tiny = broadcast<V>(sizeof(T) == 4 ? T(1e-25) : T(1e-200));
    return select(trial > slow, min(T(2) * product / max(sum, tiny), trial), trial);
  }
};

/// Grains that touch leave pores.
inline std::optional<Finding> MuI::density_fault(const Input& in, double density) {
  if (density < in.grain_density) return std::nullopt;
  return Finding{"density", "leaves no pores between the grains",
                 "below grain_density, " + write_number(in.grain_density) + " kg/m^3",
                 "give the density of the bulk, some 0.6 of that of the grains"};
}

inline Schema<MuI::Input> MuI::schema() {
  Schema<Input> s(name, "Dense granular flow: mu(I) rheology with elastic grains.");
  elastic_keys(s);
  s.number("mu_s", &Input::mu_s).typical(0.38).above(0).doc("Friction coefficient of slow flow.");
  s.number("mu_2", &Input::mu_2)
      .typical(0.64)
      .above(0)
      .doc("Friction coefficient of fast flow, at least mu_s.");
  s.number("i0", &Input::i0)
      .typical(0.279)
      .above(0)
      .doc("Inertial number halfway from mu_s to mu_2.");
  s.number("grain_diameter", &Input::grain_diameter, Unit::length)
      .typical(1e-3)
      .above(0)
      .doc("Grain diameter d in I = g d/sqrt(p/rho_s).");
  s.number("grain_density", &Input::grain_density, Unit::density)
      .typical(2500)
      .above(0)
      .doc(
          "Density rho_s of the grains, above density; density over grain_density is the solid "
          "fraction.");
  s.check({"mu_s", "mu_2"}, [](const Input& in, const SchemaContext&) -> std::optional<Finding> {
    if (in.mu_2 >= in.mu_s) return std::nullopt;
    return Finding{"mu_2", "friction that falls with the shear rate has no steady flow",
                   "at least mu_s", "raise mu_2 or lower mu_s"};
  });
  s.cite(
      "Jop, Forterre, Pouliquen, A constitutive law for dense granular flows, Nature 441, 2006, "
      "doi 10.1038/nature04801");
  s.cite(
      "Dunatunga, Kamrin, Continuum modelling and simulation of granular flows through their many "
      "phases, J. Fluid Mech. 779, 2015, doi 10.1017/jfm.2015.383");
  return s;
}

}  // namespace scree
