// SPDX-License-Identifier: Apache-2.0
/// \file
/// Weakly compressible fluid that remembers its volume ratio only.
#pragma once

#include <limits>
#include <optional>
#include <string>

#include "materials/compressible_fluid.hpp"

namespace scree {

/// p = B (J^-gamma - 1), tau = J (eta (grad v + grad v^T) - p I): (2) and (3) of
/// docs/materials/j_fluid.md. The bulk modulus at small strain is B gamma. Tension is not cut off.
struct JFluid : CompressibleFluid {
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
    s.cite("Cole, Underwater Explosions, Princeton University Press 1948");
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

  template <class V, class T>
  SCREE_FN static State<V> initial(const Params<T>& p) {
    const V o = broadcast<V>(0);
    return {broadcast<V>(p.initial), {o, o, o, o, o, o}};
  }

  template <class V, class T>
  SCREE_FN static Sym3<V> kirchhoff(const Params<T>& p, State<V>& s, const Mat3<V>& L, T dt) {
    advance(s, L, trace(L), dt);
    const V j = bounded_strain(p, s);
    const V J = j + T(1);
    const V pressure = p.bulk * relative_pressure(p, j);
    return detail::plus_diagonal(s.strain_rate * (J * (T(2) * p.viscosity)), -(J * pressure));
  }

  template <class V, class T>
  SCREE_FN static V wave_speed(const Params<T>& p, const State<V>& s) {
    return wave_speed_of(p, s, p.bulk * p.gamma, true);
  }

  /// Of longitudinal motion, the fastest: 2 eta/rho, for the viscous stress is not a deviator.
  template <class V, class T>
  SCREE_FN static V momentum_diffusivity(const Params<T>& p, const State<V>& s) {
    return diffusivity(p, s.volume_strain + T(1), T(2));
  }

  /// Integral of -p dJ from J = 1.
  template <class V, class T>
  SCREE_FN static V energy_density(const Params<T>& p, const State<V>& s) {
    return p.bulk * relative_energy(p, bounded_strain(p, s));
  }
};

}  // namespace scree
