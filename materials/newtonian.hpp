// SPDX-License-Identifier: Apache-2.0
/// \file
/// Weakly compressible Newtonian fluid.
#pragma once

#include <limits>

#include "materials/compressible_fluid.hpp"
#include "materials/log_determinant.hpp"

namespace scree {

/// p = K/gamma (J^-gamma - 1) (Cole 1948, Monaghan 1994), tau = J (2 eta dev D - p I), D = sym grad
/// v: (2) and (3) of docs/materials/newtonian.md. gamma = 1 is the linear law p = K (rho/rho0 - 1).
///
/// Differences to JFluid: bulk_modulus is the bulk modulus at rest itself, not a prefactor; the
/// viscous stress is deviatoric (Stokes' hypothesis), so that a change of volume makes pressure
/// only; J is multiplied by det(I + L), hence exactly that of the motion; tension may be cut off,
/// and then tau = min(J, 1) 2 eta dev D - J max(p, 0) I.
struct Newtonian : CompressibleFluid {
  static constexpr const char* name = "newtonian";

  struct Input {
    double bulk_modulus = std::numeric_limits<double>::quiet_NaN();  ///< K at rest [Pa]
    double viscosity = 0;                                            ///< eta [Pa s]
    double gamma = 7;
    bool tension = true;
  };

  static Schema<Input> schema();

  template <class T>
  struct Params {
    T bulk, gamma, viscosity, density;
    T lowest;   ///< J - 1 below which the law is not evaluated
    T weakest;  ///< lower bound of the pressure [K/gamma]: 0 without tension, else -1
  };

  template <class T>
  static Params<T> params(const Input& in, double density, int /*dimension*/) {
    return {T(in.bulk_modulus),
            T(in.gamma),
            T(in.viscosity),
            T(density),
            T(lowest_volume_ratio(in.gamma) - 1),
            T(in.tension ? -1 : 0)};
  }

  template <class V, class T>
  SCREE_FN static State<V> initial(const Params<T>&) {
    const V o = broadcast<V>(0);
    return {o, {o, o, o, o, o, o}};
  }

  template <class V, class T>
  SCREE_FN static Sym3<V> kirchhoff(const Params<T>& p, State<V>& s, const Mat3<V>& L, T dt) {
    advance(s, L, volume_growth(L), dt);
    const V j = bounded_strain(p, s);
    const V J = j + T(1);
    const V pressure = max(relative_pressure(p, j), broadcast<V>(p.weakest));
    return detail::plus_diagonal(deviator(s.strain_rate) * (liquid(p, J) * (T(2) * p.viscosity)),
                                 -(J * pressure) * (p.bulk / p.gamma));
  }

  template <class V, class T>
  SCREE_FN static V wave_speed(const Params<T>& p, const State<V>& s) {
    return wave_speed_of(p, s, p.bulk, p.weakest < T(0));
  }

  /// Of longitudinal motion, the fastest: 4/3 eta/rho.
  template <class V, class T>
  SCREE_FN static V momentum_diffusivity(const Params<T>& p, const State<V>& s) {
    return diffusivity(p, liquid(p, s.volume_strain + T(1)), T(4.0 / 3.0));
  }

  /// Integral of -p dJ from J = 1; nothing beyond J = 1 where tension is cut off.
  template <class V, class T>
  SCREE_FN static V energy_density(const Params<T>& p, const State<V>& s) {
    V j = bounded_strain(p, s);
    if (p.weakest == T(0)) j = min(j, broadcast<V>(T(0)));
    return (p.bulk / p.gamma) * relative_energy(p, j);
  }

 private:
  /// Volume ratio of the liquid in a volume ratio of J: where it parts, the rest is empty and not
  /// viscous. (With the whole J the viscous force on a drop, and the shortness of the step, would
  /// grow with the distance to the next one.)
  template <class V, class T>
  SCREE_FN static V liquid(const Params<T>& p, const V& J) {
    return p.weakest < T(0) ? J : min(J, broadcast<V>(T(1)));
  }
};

inline Schema<Newtonian::Input> Newtonian::schema() {
  Schema<Input> s(name, "Weakly compressible fluid with Newtonian viscosity.");
  s.number("bulk_modulus", &Input::bulk_modulus, Unit::pressure)
      .typical(1e6)
      .above(0)
      .doc(
          "Bulk modulus at rest, rho0 c0^2; about (10 v_max)^2 rho0 keeps the density within 1 %.");
  s.number("viscosity", &Input::viscosity, Unit::viscosity)
      .at_least(0)
      .fallback(0.0)
      .doc("Dynamic viscosity eta; acts on the deviator of the rate of strain.");
  s.number("gamma", &Input::gamma)
      .above(0)
      .fallback(7.0)
      .doc("Exponent of the pressure K/gamma (J^-gamma - 1); 1: linear in the density.");
  s.flag("tension", &Input::tension)
      .fallback(true)
      .doc("false: the pressure is never negative, the fluid parts without resistance.");
  s.cite(
      "Monaghan, Simulating free surface flows with SPH, J. Computational Physics 110(2), 1994, "
      "doi 10.1006/jcph.1994.1034");
  return s;
}

}  // namespace scree
