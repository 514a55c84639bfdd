// SPDX-License-Identifier: Apache-2.0
/// \file
/// Weakly compressible fluid that remembers its volume ratio only.
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "materials/material.hpp"
#include "solver/base/math.hpp"

namespace scree {

/// p = B (J^-gamma - 1), tau = J (eta (grad v + grad v^T) - p I). The bulk modulus at small strain
/// is B gamma. Tension is not cut off.
struct JFluid {
  static constexpr const char* name = "j_fluid";

  struct Input {
    double bulk_modulus = std::numeric_limits<double>::quiet_NaN();  ///< the prefactor B [Pa]
    double gamma = std::numeric_limits<double>::quiet_NaN();
    double viscosity = 0;  ///< eta [Pa s]
    double initial_j = 1;
  };

  static Schema<Input> schema() {
    Schema<Input> s(name,
                    "Weakly compressible fluid: pressure B (J^-gamma - 1), Newtonian viscosity.");
    s.number("bulk_modulus", &Input::bulk_modulus, Unit::pressure)
        .typical(1e6)
        .above(0)
        .doc("Prefactor B of the pressure; the bulk modulus at small strain is B gamma.");
    s.number("gamma", &Input::gamma)
        .typical(7)
        .above(0)
        .doc("Exponent of the pressure, e.g. 7 for water.");
    s.number("viscosity", &Input::viscosity, Unit::viscosity)
        .at_least(0)
        .fallback(0.0)
        .doc("Dynamic viscosity eta.");
    s.number("initial_j", &Input::initial_j)
        .above(0)
        .fallback(1.0)
        .doc("Volume ratio J at the start, below 1: compressed.");
    s.check({"gamma", "initial_j"},
            [](const Input& in, const SchemaContext&) -> std::optional<Finding> {
              if (in.initial_j > lowest_volume_ratio(in.gamma)) return std::nullopt;
              return Finding{"initial_j", "pressure beyond all bounds",
                             "above " + std::to_string(lowest_volume_ratio(in.gamma)),
                             "raise initial_j"};
            });
    return s;
  }

  template <class T>
  struct Params {
    T bulk, gamma, viscosity, density;
    T initial;  ///< initial J - 1
    T lowest;   ///< J - 1 below which the law is not evaluated
  };

  template <class T>
  static Params<T> params(const Input& in, double density, int /*dimension*/) {
    return {T(in.bulk_modulus), T(in.gamma),         T(in.viscosity),
            T(density),         T(in.initial_j - 1), T(lowest_volume_ratio(in.gamma) - 1)};
  }

  /// J - 1 instead of J: in single precision the increments of a step would be lost in J.
  template <class V>
  struct State {
    V volume_strain;
    Sym3<V> strain_rate;  ///< of the last step, for the output of the viscous stress
  };

  static std::vector<StateField> fields() {
    return {{"volume_strain", 1, "1", "J - 1.", true},
            {"strain_rate", 6, "1/s", "Symmetric velocity gradient of the last step.", true}};
  }

  template <class V, class T>
  SCREE_FN static State<V> initial(const Params<T>& p) {
    const V o = broadcast<V>(0);
    return {broadcast<V>(p.initial), {o, o, o, o, o, o}};
  }

  template <class V, class T>
  SCREE_FN static Sym3<V> kirchhoff(const Params<T>& p, State<V>& s, const Mat3<V>& L, T dt) {
    s.volume_strain = s.volume_strain + (s.volume_strain + T(1)) * trace(L);
    if (dt > T(0)) s.strain_rate = sym(L) * broadcast<V>(T(1) / dt);
    const V j = max(s.volume_strain, broadcast<V>(p.lowest));
    const V J = j + T(1);
    const V pressure = p.bulk * expm1(-p.gamma * log1p(j));
    return detail::plus_diagonal(s.strain_rate * (J * (T(2) * p.viscosity)), -(J * pressure));
  }

  /// Sound: rho c^2 = -J dp/dJ, hence rho0 c^2 = B gamma J^(1 - gamma). Viscosity limits the step
  /// by diffusion, not through a speed: see momentum_diffusivity().
  template <class V, class T>
  SCREE_FN static V wave_speed(const Params<T>& p, const State<V>& s) {
    const V j = max(s.volume_strain, broadcast<V>(p.lowest));
    return exp((T(0.5) * (T(1) - p.gamma)) * log1p(j)) * sqrt(p.bulk * p.gamma / p.density);
  }

  /// Of longitudinal motion, the fastest: 2 eta/rho, for the viscous stress is not a deviator.
  template <class V, class T>
  SCREE_FN static V momentum_diffusivity(const Params<T>& p, const State<V>& s) {
    const V J = max(s.volume_strain + T(1), broadcast<V>(T(0)));
    return (T(2) * p.viscosity / p.density) * J;
  }

  /// Integral of -p dJ from J = 1: B ((J^(1-gamma) - 1)/(gamma - 1) + J - 1), and B (J - 1 - ln J)
  /// for gamma = 1.
  template <class V, class T>
  SCREE_FN static V energy_density(const Params<T>& p, const State<V>& s) {
    const V j = max(s.volume_strain, broadcast<V>(p.lowest));
    const V logarithm = log1p(j);
    const T power = p.gamma - T(1);
    if (abs(power) < T(1e-6)) return p.bulk * (j - logarithm);
    return p.bulk * (expm1(-power * logarithm) * (T(1) / power) + j);
  }

  template <class V, class T>
  SCREE_FN static V volume_ratio(const Params<T>&, const State<V>& s) {
    return s.volume_strain + T(1);
  }

  template <class V, class T>
  SCREE_FN static MaskOf<V> admissible(const Params<T>& p, const State<V>& s) {
    return s.volume_strain > p.lowest;
  }

 private:
  /// Where the pressure has reached e^40 B, or 1e-6: beyond any fluid, and still a number in single
  /// precision.
  static double lowest_volume_ratio(double gamma) {
    const double ratio = std::exp(-40 / gamma);
    return ratio > 1e-6 ? ratio : 1e-6;
  }
};

}  // namespace scree
