// SPDX-License-Identifier: Apache-2.0
/// \file
/// What the weakly compressible fluids share: the state and the power law of the pressure.
#pragma once

#include <cmath>

#include "materials/material.hpp"
#include "solver/base/math.hpp"

namespace scree {

/// Base of laws with a pressure of B (J^-gamma - 1), B a scale of the law's own, and with the
/// parameters gamma, viscosity, density and lowest (J - 1 below which the law is not evaluated). P:
/// the law's Params.
struct CompressibleFluid {
  /// The whole stiffness is against changes of volume: see lone_particle_courant().
  static constexpr bool fluid = true;

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

  template <class V, class P>
  SCREE_FN static V volume_ratio(const P&, const State<V>& s) {
    return s.volume_strain + decltype(P::lowest)(1);
  }

  template <class V, class P>
  SCREE_FN static MaskOf<V> admissible(const P& p, const State<V>& s) {
    return s.volume_strain > p.lowest;
  }

 protected:
  /// The step with L = dt grad v; growth: relative change of J.
  template <class V, class T>
  SCREE_FN static void advance(State<V>& s, const Mat3<V>& L, V growth, T dt) {
    s.volume_strain = s.volume_strain + (s.volume_strain + T(1)) * growth;
    if (dt > T(0)) s.strain_rate = sym(L) * broadcast<V>(T(1) / dt);
  }

  /// J - 1, bounded below where the state is not admissible.
  template <class V, class P>
  SCREE_FN static V bounded_strain(const P& p, const State<V>& s) {
    return max(s.volume_strain, broadcast<V>(p.lowest));
  }

  /// J^-gamma - 1 as a function of j = J - 1.
  template <class V, class P>
  SCREE_FN static V relative_pressure(const P& p, V j) {
    return expm1(-p.gamma * log1p(j));
  }

  /// Integral of -(J^-gamma - 1) dJ from J = 1: (J^(1-gamma) - 1)/(gamma - 1) + J - 1, and J - 1 -
  /// ln J for gamma = 1.
  template <class V, class P>
  SCREE_FN static V relative_energy(const P& p, V j) {
    using T = decltype(P::gamma);
    const V logarithm = log1p(j);
    const T power = p.gamma - T(1);
    if (abs(power) < T(1e-6)) return j - logarithm;
    return expm1(-power * logarithm) * (T(1) / power) + j;
  }

  /// Sound: rho c^2 = -J dp/dJ, hence rho0 c^2 = K J^(1 - gamma), K [Pa] the bulk modulus at rest.
  /// Viscosity limits the step by diffusion, not through a speed: see momentum_diffusivity().
  ///
  /// Tension (where `tension`) carries waves as that of a string does, rho c^2 = -p, and both add
  /// up to d tau/d ln J over rho0: it is this that pulls a particle together which has its nodes to
  /// itself, and it grows with J while the speed of sound falls.
  template <class V, class P, class T>
  SCREE_FN static V wave_speed_of(const P& p, const State<V>& s, T bulk_modulus, bool tension) {
    const V j = bounded_strain(p, s);
    const V power = exp((T(1) - p.gamma) * log1p(j));
    V square = power * bulk_modulus;
    if (tension) {
      const V pull = (j + T(1) - power) * (bulk_modulus / p.gamma);
      square = square + max(pull, broadcast<V>(T(0)));
    }
    return sqrt(square * (T(1) / p.density));
  }

  /// factor eta/rho; J: volume ratio of what is viscous.
  template <class V, class P, class T>
  SCREE_FN static V diffusivity(const P& p, const V& J, T factor) {
    return (factor * p.viscosity / p.density) * max(J, broadcast<V>(T(0)));
  }

  /// Where the pressure has reached e^40 B, or 1e-6: beyond any fluid, and still a number in single
  /// precision.
  static double lowest_volume_ratio(double gamma) {
    const double ratio = std::exp(-40 / gamma);
    return ratio > 1e-6 ? ratio : 1e-6;
  }
};

}  // namespace scree
