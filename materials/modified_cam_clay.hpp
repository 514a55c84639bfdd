// SPDX-License-Identifier: Apache-2.0
/// \file
/// Modified Cam clay: Roscoe, Burland, On the generalised stress-strain behaviour of 'wet' clay,
/// in: Engineering Plasticity, Cambridge University Press 1968; Wood, Soil Behaviour and Critical
/// State Soil Mechanics, Cambridge University Press 1990.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "materials/cam_clay_return.hpp"
#include "materials/log_determinant.hpp"
#include "materials/material.hpp"
#include "solver/base/eigen_closed.hpp"

namespace scree {

/// Effective Cauchy stress sigma = s - p I (p compression positive), specific volume v = 1 + e:
///
///     v = N - lambda ln pc + kappa ln(pc/p)     swelling line of pc; N at 1 kPa
///     f = q^2 - M^2 p (pc - p) <= 0             associated flow
///     ds = 2 G d(dev strain), G = 3 (1 - 2 nu)/(2 (1 + nu)) v p/kappa
///
/// which are (1), (2) and (4) of docs/materials/modified_cam_clay.md; the hardening (3) is (1) at
/// constant p.
///
/// The swelling line is not integrated: v follows from the motion (v/v0 = J), so p is a function of
/// v and pc, and normal and swelling lines hold to rounding, whatever the steps.
///
/// With a constant nu the law is not hyperelastic: a closed elastic cycle of p and q may gain or
/// lose energy (Zytynski, Randolph, Nova, Wroth, Int. J. Numer. Anal. Meth. Geomech. 2, 1978).
/// Hyperelastic variants (Borja, Tamagnini, CMAME 155, 1998) make p depend on shear strain and so
/// change the classic undrained path and K0, therefore they are not used here. The stress is state:
/// each step turns the deviator by the rotation of the increment and adds 2 G times the deviator
/// of its logarithmic strain, G being the mean of the step's ends on the swelling line. A step and
/// its reversal therefore cancel.
struct ModifiedCamClay {
  static constexpr const char* name = "modified_cam_clay";
  static constexpr bool effective_stress = true;
  static constexpr bool long_chains = true;
  /// The stress is no derivative of energy_density: see above.
  static constexpr bool hyperelastic = false;
  static constexpr InadmissibleText inadmissible{
      "has no voids left", "lower the loads, raise reference_void_ratio, or lower time.cfl"};

  struct Input {
    double m = std::numeric_limits<double>::quiet_NaN();
    double lambda = std::numeric_limits<double>::quiet_NaN();
    double kappa = std::numeric_limits<double>::quiet_NaN();
    double poissons_ratio = std::numeric_limits<double>::quiet_NaN();
    double reference_void_ratio = std::numeric_limits<double>::quiet_NaN();  ///< N - 1
    double initial_pressure = std::numeric_limits<double>::quiet_NaN();      ///< Pa
    std::optional<double> preconsolidation_pressure;                         ///< Pa
    std::optional<double> ocr;  ///< preconsolidation over initial pressure
  };

  static Schema<Input> schema();

  // Ground at the start; modified_cam_clay_ground.hpp.
  /// K0 of normally consolidated ground: what the law itself comes to in one-dimensional
  /// compression.
  static double rest_ratio(const Input& in);
  template <class V>
  struct State;
  /// On the swelling line of its pc, exact: pc is ocr times that of the yield surface through the
  /// stress, or else preconsolidation_pressure, and v follows from pc and p. Nothing where the
  /// stress is outside of the yield surface, no compression, or leaves no voids.
  static std::optional<State<double>> state_under(const Input& in,
                                                  const std::array<double, 3>& stress);
  static std::string stress_repair(const Input& in);
  /// Averages of volume changes are of the whole one (no elastic part is known apart), and clay
  /// that is overconsolidated more than twice dilates. Nothing is said of a
  /// preconsolidation_pressure under an initial stress, for the ratio is another one at each place.
  static std::string averaging_doubt(const Input& in, bool stressed);

  template <class T>
  struct Params {
    T m, lambda, kappa, density;
    T preconsolidation;    ///< pc at the start [Pa]
    T log_ratio;           ///< ln(p/pc) at the start
    T specific_volume;     ///< v at the start
    T three_shear_factor;  ///< 3 G kappa/(v p)
  };

  template <class T>
  static Params<T> params(const Input& in, double density, int /*dimension*/) {
    const double nu = in.poissons_ratio;
    return {T(in.m),
            T(in.lambda),
            T(in.kappa),
            T(density),
            T(preconsolidation(in)),
            T(std::log(in.initial_pressure / preconsolidation(in))),
            T(specific_volume(in)),
            T(9 * (1 - 2 * nu) / (2 * (1 + nu)))};
  }

  /// The deviator is in units of the present pc, so that its entries stay below M. The volume
  /// appears twice: v belongs to the material, ln J counts from wherever the body's initial state
  /// was set.
  template <class V>
  struct State {
    Sym3<V> normalized_deviator;
    V log_specific_volume, log_preconsolidation, equivalent_plastic_strain, log_volume_ratio;
  };

  static std::vector<StateField> fields() {
    return {{"normalized_deviator", 6, "1",
             "Deviator of the effective Cauchy stress over the preconsolidation pressure.", true},
            {"log_specific_volume", 1, "1",
             "ln of the specific volume over that of the material's keys.", true},
            {"log_preconsolidation", 1, "1",
             "ln of the preconsolidation pressure over that of the material's keys.", true},
            {"equivalent_plastic_strain", 1, "1",
             "Sum of sqrt(2/3) |deviator of the plastic strain increment|.", true},
            {"log_volume_ratio", 1, "1", "ln J, elastic and plastic.", true}};
  }

  template <class V, class T>
  SCREE_FN static State<V> initial(const Params<T>&) {
    const V o = broadcast<V>(0);
    return {{o, o, o, o, o, o}, o, o, o, o};
  }

  template <class V, class T>
  SCREE_FN static Sym3<V> kirchhoff(const Params<T>& p, State<V>& s, const Mat3<V>& L, T /*dt*/) {
    // 1. Volume, and with it the trial pressure on the present swelling line. Stresses are in units
    // of the present pc.
    const Swelling<V> begin(p, s);
    const V growth = detail::log_determinant(L);
    s.log_specific_volume = s.log_specific_volume + growth;
    s.log_volume_ratio = s.log_volume_ratio + growth;
    const Swelling<V> moved(p, s);
    CamClayTrial<V> trial{moved.log_ratio, moved.ratio(), {}, {}, moved.volume};
    // 2. Trial deviator.
    const V pressures = begin.ratio() + trial.ratio;
    trial.three_shear =
        (T(0.25) * p.three_shear_factor / p.kappa) * (begin.volume + moved.volume) * pressures;
    const Sym3<V> deviator =
        turned_and_strained(s.normalized_deviator, L, T(2.0 / 3.0) * trial.three_shear);
    trial.shear = T(1.2247448713915890) * norm(deviator);
    // 3. Return, (5).
    const auto end = cam_clay_return(p.m, p.lambda, p.kappa, trial);
    s.normalized_deviator = deviator * end.keep;
    s.log_preconsolidation = s.log_preconsolidation + end.hardening;
    s.equivalent_plastic_strain = s.equivalent_plastic_strain + end.shear_strain;
    return detail::plus_diagonal(s.normalized_deviator, -end.ratio) *
           kirchhoff_preconsolidation(p, s);
  }

  /// With L = w n^T the work of the stress rate is K (w.n)^2 + G (1 + (w.n)^2/3) + (n.sn - w.sw)/2,
  /// below K + 4 G/3 + |s|/sqrt(2) [Cauchy]; times J in the reference configuration. Plastic flow
  /// is associated, hence softer.
  template <class V, class T>
  SCREE_FN static V wave_speed(const Params<T>& p, const State<V>& s) {
    const Swelling<V> line(p, s);
    const V bulk = line.volume * line.ratio() * (T(1) / p.kappa);
    const V stiffness = bulk * (T(1) + T(4.0 / 9.0) * p.three_shear_factor) +
                        T(0.70710678118654752) * norm(s.normalized_deviator);
    return sqrt(stiffness * kirchhoff_preconsolidation(p, s) * (T(1) / p.density));
  }

  /// J (kappa p/v + |s|^2/(4 G)): the first term is what the pressure gives back along its swelling
  /// line, exactly; the second what the deviator gives back at constant volume.
  template <class V, class T>
  SCREE_FN static V energy_density(const Params<T>& p, const State<V>& s) {
    const Swelling<V> line(p, s);
    const V ratio = line.ratio(), size = norm(s.normalized_deviator);
    const V shear = (T(0.75) / p.three_shear_factor) * (size * size / ratio);
    return kirchhoff_preconsolidation(p, s) * (p.kappa / line.volume) * (ratio + shear);
  }

  /// f/(M pc)^2, pc the present preconsolidation pressure.
  template <class V, class T>
  SCREE_FN static V yield_value(const Params<T>& p, const State<V>& s) {
    const V size = norm(s.normalized_deviator) * (T(1) / p.m);
    const V r = Swelling<V>(p, s).log_ratio;
    return T(1.5) * size * size + exp(r) * expm1(r);
  }

  /// e = v - 1.
  template <class V, class T>
  SCREE_FN static V void_ratio(const Params<T>& p, const State<V>& s) {
    return Swelling<V>(p, s).volume - T(1);
  }

  template <class V, class T>
  SCREE_FN static V volume_ratio(const Params<T>&, const State<V>& s) {
    return exp(s.log_volume_ratio);
  }

  /// There must be voids. (An increment with det(I + L) <= 0 leaves none.)
  template <class V, class T>
  SCREE_FN static MaskOf<V> admissible(const Params<T>& p, const State<V>& s) {
    return Swelling<V>(p, s).volume > T(1);
  }

 private:
  static double preconsolidation(const Input& in) {
    return in.ocr ? *in.ocr * in.initial_pressure : in.preconsolidation_pressure.value_or(0);
  }
  /// v at the pressure p on the swelling line of pc.
  static double specific_volume(const Input& in, double pc, double p) {
    constexpr double unit = 1000;  // N is at 1 kPa
    return 1 + in.reference_void_ratio - in.lambda * std::log(pc / unit) +
           in.kappa * std::log(pc / p);
  }
  /// v at the start.
  static double specific_volume(const Input& in) {
    return specific_volume(in, preconsolidation(in), in.initial_pressure);
  }

  /// Where the state is on the swelling line of its pc.
  template <class V>
  struct Swelling {
    V volume, log_ratio;  ///< v, ln(p/pc)

    /// p/pc, at most 1: no elastic state has more pressure than pc.
    SCREE_FN V ratio() const { return exp(min(log_ratio, broadcast<V>(0))); }

    /// From the differences to the initial state: in single precision v itself would carry the
    /// rounding of its last digit, times 1/kappa. The ratio has a lower bound, that of soil which
    /// has fallen apart (see cam_clay_return), and an upper one that only soil without voids would
    /// reach: pc would grow by e^40 in a step.
    template <class T>
    SCREE_FN Swelling(const Params<T>& p, const State<V>& s) {
      const V change = p.specific_volume * expm1(s.log_specific_volume);
      volume = p.specific_volume + change;
      const V r = p.log_ratio - (change + p.lambda * s.log_preconsolidation) * (T(1) / p.kappa);
      log_ratio =
          min(max(r, broadcast<V>(T(cam_clay_apart))), broadcast<V>(40 * p.lambda / p.kappa));
    }
  };

  /// p_c J [Pa]
  template <class V, class T>
  SCREE_FN static V kirchhoff_preconsolidation(const Params<T>& p, const State<V>& s) {
    return p.preconsolidation * exp(s.log_preconsolidation + s.log_volume_ratio);
  }

  /// (I + L)(I + L)^T - I. In a large rotation L and L L^T cancel, and what is left is stiffness
  /// over strength times as large in the stress: the fused products are spelt out, so that no
  /// compiler rounds them in another order in lanes than in a scalar.
  template <class V>
  SCREE_FN static Sym3<V> stretch_growth(const Mat3<V>& L) {
    const auto rows = [&L](int i, int j) {
      const V linear = L(i, j) + L(j, i);
      return mul_add(L(i, 0), L(j, 0),
                     mul_add(L(i, 1), L(j, 1), mul_add(L(i, 2), L(j, 2), linear)));
    };
    return {rows(0, 0), rows(0, 1), rows(0, 2), rows(1, 1), rows(1, 2), rows(2, 2)};
  }

  /// R s R^T + two_shear dev ln U with I + L = U R: both parts from the eigenproblem of (I + L)(I +
  /// L)^T - I, which is small with L, and added as increments, so that rounding does not pile up in
  /// a body at rest.
  template <class V>
  SCREE_FN static Sym3<V> turned_and_strained(const Sym3<V>& s, const Mat3<V>& L, V two_shear) {
    using T = Scalar<V>;
    const SymEigen<V> eigen = eigen_symmetric_closed(stretch_growth(L));
    Vec3<V> strain, back;
    SCREE_UNROLL for (int i = 0; i < 3; ++i) {
      strain[i] = T(0.5) * log1p(max(eigen.values[i], broadcast<V>(T(-0.999999))));
      back[i] = expm1(-strain[i]);
    }
    const V mean = (strain[0] + strain[1] + strain[2]) * T(1.0 / 3.0);
    SCREE_UNROLL for (int i = 0; i < 3; ++i) strain[i] = (strain[i] - mean) * two_shear;
    const Mat3<V> E = to_mat(from_principal(eigen.vectors, back));
    const Mat3<V> turn = E + L + E * L;  // R - I
    const Mat3<V> moved = turn * to_mat(s);
    const Sym3<V> added = sym(moved) * broadcast<V>(T(2)) + sym(moved * transpose(turn));
    return s + added + from_principal(eigen.vectors, strain);
  }
};

}  // namespace scree

#include "materials/modified_cam_clay_ground.hpp"
#include "materials/modified_cam_clay_schema.hpp"
