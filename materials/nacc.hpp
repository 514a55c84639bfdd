// SPDX-License-Identifier: Apache-2.0
/// \file
/// Non-associated Cam clay: Wolper, Fang, Li, Lu, Gao, Jiang, CD-MPM: Continuum damage material
/// point methods for dynamic fracture animation, ACM TOG 38(4), 2019.
#pragma once

#include <cmath>
#include <limits>
#include <optional>

#include "materials/elastic_keys.hpp"
#include "materials/hencky_elasticity.hpp"

namespace scree {

/// Numbers of equations are those of docs/materials/nacc.md, (1) to (4) in turn:
/// psi = mu/2 (J^(-2/3) tr b - 3) + K/2 ((J^2 - 1)/2 - ln J), hence tau = s - p I with s = mu
/// J^(-2/3) dev b and the pressure *stress* p = -K/2 (J^2 - 1) (not the energy); compression
/// positive. Yield surface y = (1 + 2 beta) q^2 + M^2 (p + beta p0)(p - p0) with q^2 = 3/2 |s|^2,
/// p0 = K (sinh(xi max(-alpha, 0)) + p0_offset); alpha is the plastic part of ln J.
///
/// The return, (5) and (6), is the paper's: beyond a tip of the ellipse to that tip;
/// else at the trial pressure, towards the p axis, keeping tr b. Hardening, once a step: alpha
/// grows by ln (J_trial/J) to the tip, or to the point where the ray from the trial stress to the
/// ellipse's centre meets the ellipse.
///
/// Two things follow from the paper's choices: keeping tr b changes J by the square of the shear
/// strain, and softening acts one step later (p0 of the return is that of the step's start). A
/// state may so lie outside its yield surface, by a distance of the size of the step. A step
/// without strain (no motion, or a rotation) does no return, so that it changes nothing.
struct Nacc {
  static constexpr const char* name = "nacc";
  static constexpr bool effective_stress = true;
  static constexpr bool long_chains = true;
  /// yield_value may exceed 0 by the size of a step: see above.
  static constexpr bool explicit_hardening = true;

  struct Input {
    double youngs_modulus = std::numeric_limits<double>::quiet_NaN();  ///< Pa
    double poissons_ratio = std::numeric_limits<double>::quiet_NaN();
    double alpha0 = std::numeric_limits<double>::quiet_NaN();  ///< alpha at the start, <= 0
    double beta = std::numeric_limits<double>::quiet_NaN();
    double xi = std::numeric_limits<double>::quiet_NaN();
    double m = std::numeric_limits<double>::quiet_NaN();  ///< M
    double p0_offset = 0;                                 ///< [K]
  };

  static Schema<Input> schema();

  /// Stresses of the return map are in units of K.
  template <class T>
  struct Params {
    T bulk, mu, density;
    T shear;           ///< sqrt(3/2) mu/K
    T m, beta, slope;  ///< slope: M/sqrt(1 + 2 beta), of q over p
    T xi, offset, alpha;
    T flow_stiffness;  ///< [Pa], see wave_speed
    T scale;           ///< 1/(M p0)^2 of the initial state, see yield_value
  };

  template <class T>
  static Params<T> params(const Input& in, double density, int /*dimension*/) {
    const auto [lambda, mu] = lame_constants(in.youngs_modulus, in.poissons_ratio);
    const double bulk = lambda + 2 * mu / 3;
    const double slope = in.m / std::sqrt(1 + 2 * in.beta);
    const double p0 = std::sinh(std::fmin(-in.xi * in.alpha0, largest_argument)) + in.p0_offset;
    const double scale = in.m * std::fmax(p0, 1e-3);
    return {T(bulk),
            T(mu),
            T(density),
            T(std::sqrt(1.5) * mu / bulk),
            T(in.m),
            T(in.beta),
            T(slope),
            T(in.xi),
            T(in.p0_offset),
            T(in.alpha0),
            T(bulk * bulk * 3 * slope * slope / (12 * mu)),
            T(1 / (scale * scale))};
  }

  template <class V>
  struct State {
    Mat3<V> F;  ///< elastic part
    V log_plastic_volume, log_volume_ratio;
  };

  static std::vector<StateField> fields() {
    return {{"deformation_gradient", 9, "1", "Elastic part of the deformation gradient.", true},
            {"log_plastic_volume", 1, "1",
             "alpha: plastic part of ln J, from alpha0; the more negative, the harder.", true},
            {"log_volume_ratio", 1, "1", "ln J, elastic and plastic.", true}};
  }

  template <class V, class T>
  SCREE_FN static State<V> initial(const Params<T>& p) {
    return {identity3<V>(), broadcast<V>(p.alpha), broadcast<V>(0)};
  }

  template <class V, class T>
  SCREE_FN static Sym3<V> kirchhoff(const Params<T>& p, State<V>& s, const Mat3<V>& L, T /*dt*/) {
    // 1. Trial state: b = U diag(B) U^T and, in units of K, p and q.
    s.F = detail::advance_gradient(L, s.F);
    s.log_volume_ratio = s.log_volume_ratio + detail::log_determinant(L);
    const SymEigen<V> b = eigen_symmetric_closed(symmetric_product(s.F));
    const V J = max(det(s.F), broadcast<V>(smallest<T>));
    const Stress<V> trial(p, b.values, J * J);
    const Surface<V> surface(p, s.log_plastic_volume);
    // 2. Which return, (5) or (6): case 1 and 2 of the paper bound J^2, case 3 lowers q at the same
    // p.
    const V square = min(max(J * J, T(1) - T(2) * surface.right), T(1) + T(2) * surface.left);
    const V from_left = trial.p + surface.left, from_right = surface.right - trial.p;
    const V room = from_left * from_right;  // half^2 - (p - centre)^2, which cancels in a long one
    const V q_yield = p.slope * sqrt(max(room, broadcast<V>(T(0))));
    const auto moves = deforms(L);
    const auto to_tip = (from_left < T(0)) | (from_right < T(0));
    const auto to_side = moves & !to_tip & (trial.q > q_yield);
    const auto tip = moves & to_tip;
    // 3. Hardening.
    const V harder = to_tip_or_ray(p, surface, trial, J * J, square, tip);
    const auto hardens = tip | (to_side & (room > T(0)));
    s.log_plastic_volume = s.log_plastic_volume + select(hardens, harder, T(0));
    // 4. New stretches; F <- U diag(S'/S) U^T F keeps its rotation, and is F itself without a
    // return.
    const V tip_B = exp(log(square) * T(1.0 / 3.0));
    const V keep = q_yield / max(trial.q, broadcast<V>(smallest<T>));
    Vec3<V> squares, factor;
    SCREE_UNROLL for (int i = 0; i < 3; ++i) {
      const V B = max(b.values[i], broadcast<V>(smallest<T>));
      const V side = trial.mean + keep * (B - trial.mean);
      squares[i] = select(tip, tip_B, select(to_side, side, B));
      factor[i] = select(tip | to_side, sqrt(squares[i] / B) - T(1), T(0));
    }
    s.F = s.F + from_principal(b.vectors, factor) * s.F;
    // 5. Stress, with the J after the return.
    const V J2 = max(squares[0] * squares[1] * squares[2], broadcast<V>(smallest<T>));
    return from_principal(b.vectors, principal_stress(p, squares, J2));
  }

  /// With a_ijkl = F_jJ F_lL dP_iJ/dF_kL the acoustic tensor of a wave along n is mu J^(-2/3) (n.b
  /// n I - 2/3 (bn n^T + n (bn)^T) + 5/9 tr b n n^T) + K/2 (J^2 + 1) n n^T. Its eigenvalues are
  /// below mu J^(-2/3) (max(5/9 tr b - b_min/3, b_max) + (b_max - b_min)/3) + K/2 (J^2 + 1).
  ///
  /// The return at constant pressure is not associated, so it may be stiffer than elasticity, as
  /// explained at DruckerPrager::wave_speed, by K^2 (dq/dp)^2/(12 mu). The slope dq/dp of the
  /// ellipse is counted up to half its height, sqrt(3) M/sqrt(1 + 2 beta): nearer to the tips it is
  /// steeper, but there q, on which it acts, vanishes.
  template <class V, class T>
  SCREE_FN static V wave_speed(const Params<T>& p, const State<V>& s) {
    const Sym3<V> b = symmetric_product(s.F);
    const auto bounds = detail::eigenvalue_bounds(b);
    const V lower = max(bounds.lower, broadcast<V>(T(0)));
    const V J = max(det(s.F), broadcast<V>(smallest<T>));
    const V along = max(T(5.0 / 9.0) * trace(b) - T(1.0 / 3.0) * lower, bounds.upper);
    const V shear = along + T(1.0 / 3.0) * (bounds.upper - lower);
    const V stiffness = (p.mu * exp(T(-2.0 / 3.0) * log(J))) * shear +
                        (T(0.5) * p.bulk) * (J * J + T(1)) + p.flow_stiffness;
    return sqrt(stiffness * (T(1) / p.density));
  }

  template <class V, class T>
  SCREE_FN static V energy_density(const Params<T>& p, const State<V>& s) {
    const V J = max(det(s.F), broadcast<V>(smallest<T>));
    const V logarithm = log(J);
    const V squares = trace(symmetric_product(s.F)) * exp(T(-2.0 / 3.0) * logarithm);
    return (T(0.5) * p.mu) * (squares - T(3)) +
           (T(0.5) * p.bulk) * (T(0.5) * (J * J - T(1)) - logarithm);
  }

  /// y over (M p0)^2, with the p0 of the initial state, but at least K/1000.
  template <class V, class T>
  SCREE_FN static V yield_value(const Params<T>& p, const State<V>& s) {
    const SymEigen<V> b = eigen_symmetric_closed(symmetric_product(s.F));
    const V J = max(det(s.F), broadcast<V>(smallest<T>));
    const Stress<V> stress(p, b.values, J * J);
    const Surface<V> surface(p, s.log_plastic_volume);
    const V y = (T(1) + T(2) * p.beta) * stress.q * stress.q +
                (p.m * p.m) * (stress.p + surface.left) * (stress.p - surface.right);
    return y * p.scale;
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
  /// sinh of more than this would leave single precision when squared; p of this elasticity never
  /// exceeds K/2 = K sinh(0.48).
  static constexpr double largest_argument = 40;
  /// Keeps J, stretches and q positive where F is not admissible.
  template <class T>
  static constexpr T smallest = sizeof(T) == 4 ? T(1e-18) : T(1e-90);

  /// p and q in units of K, and tr b/3.
  template <class V>
  struct Stress {
    V p, q, mean;

    template <class T>
    SCREE_FN Stress(const Params<T>& material, const Vec3<V>& B, V J2) {
      mean = (B[0] + B[1] + B[2]) * T(1.0 / 3.0);
      const Vec3<V> deviator = {{B[0] - mean, B[1] - mean, B[2] - mean}};
      p = T(0.5) * (T(1) - J2);
      q = material.shear * sqrt(dot(deviator, deviator)) * exp(T(-1.0 / 3.0) * log(J2));
    }
  };

  /// The ellipse: from p = -left to right, half its length.
  template <class V>
  struct Surface {
    V left, right, centre, half;

    template <class T>
    SCREE_FN Surface(const Params<T>& material, V alpha) {
      const V x =
          min(max(-material.xi * alpha, broadcast<V>(T(0))), broadcast<V>(T(largest_argument)));
      const V e = expm1(x);
      right = T(0.5) * (e + e / (e + T(1))) + material.offset;
      left = material.beta * right;
      centre = T(0.5) * (right - left);
      half = T(0.5) * (right + left);
    }
  };

  /// False if I + L is a rotation to within the rounding of L, or the identity.
  template <class V>
  SCREE_FN static MaskOf<V> deforms(const Mat3<V>& L) {
    using T = Scalar<V>;
    V size = broadcast<V>(0);
    SCREE_UNROLL for (int k = 0; k < 9; ++k) size = size + abs(L(k / 3, k % 3));
    const Sym3<V> e = sym(L) + symmetric_product(L) * broadcast<V>(T(0.5));
    const V strain = abs(e.xx) + abs(e.xy) + abs(e.xz) + abs(e.yy) + abs(e.yz) + abs(e.zz);
    return strain > (sizeof(T) == 4 ? T(1e-6) : T(2e-15)) * size;
  }

  /// ln(J_trial/J_x): J_x is that of the tip, or of the point where the ray from the trial stress
  /// to the centre meets the ellipse. If alpha is so low that the centre lies beyond every pressure
  /// of this elasticity, J_x may not exist: it is then J_trial/10, which a step of small strain
  /// never comes near.
  template <class V, class T>
  SCREE_FN static V to_tip_or_ray(const Params<T>& p, const Surface<V>& surface,
                                  const Stress<V>& trial, V J2, V tip_square, MaskOf<V> tip) {
    const V from_centre = trial.p - surface.centre;
    const V a = abs(p.slope * from_centre), q2 = trial.q * trial.q;
    const V length = sqrt(max(q2 + a * a, broadcast<V>(smallest<T>)));
    // From the nearer tip, half (1 - a/length): from the centre it would cancel in a long ellipse.
    const V from_tip = surface.half * (q2 / (length * (length + a)));
    const V pressure =
        select(from_centre > T(0), surface.right - from_tip, from_tip - surface.left);
    const V side_square = max(T(1) - T(2) * pressure, T(0.01) * J2);
    return T(0.5) * (log(J2) - log(select(tip, tip_square, side_square)));
  }

  template <class V, class T>
  SCREE_FN static Vec3<V> principal_stress(const Params<T>& p, const Vec3<V>& B, V J2) {
    const V mean = (B[0] + B[1] + B[2]) * T(1.0 / 3.0);
    const V shear = p.mu * exp(T(-1.0 / 3.0) * log(J2));
    const V volumetric = (T(0.5) * p.bulk) * (J2 - T(1));
    Vec3<V> r;
    SCREE_UNROLL for (int i = 0; i < 3; ++i) r[i] = shear * (B[i] - mean) + volumetric;
    return r;
  }
};

inline Schema<Nacc::Input> Nacc::schema() {
  Schema<Input> s(name, "Crushable solid (snow, soft rock, pumpkin): non-associated Cam clay.");
  elastic_keys(s);
  s.number("alpha0", &Input::alpha0)
      .typical(-0.04)
      .at_most(0)
      .doc("Plastic ln J at the start: p0 = K sinh(-xi alpha0).");
  s.number("beta", &Input::beta)
      .typical(0.5)
      .at_least(0)
      .doc("Cohesion: tensile strength over p0.");
  s.number("xi", &Input::xi).typical(3).above(0).doc("Hardening factor of plastic ln J.");
  s.number("m", &Input::m)
      .typical(1.2)
      .above(0)
      .doc("Slope M of the critical state line for beta = 0.");
  s.number("p0_offset", &Input::p0_offset)
      .at_least(0)
      .fallback(0.0)
      .doc("Strength that softening leaves, as a fraction of the bulk modulus.");
  s.check({"alpha0", "xi"}, [](const Input& in, const SchemaContext&) -> std::optional<Finding> {
    if (-in.xi * in.alpha0 <= largest_argument) return std::nullopt;
    return Finding{"alpha0", "p0 = K sinh(-xi alpha0) is beyond all bounds",
                   "xi times alpha0 of at least -40", "raise alpha0 or lower xi"};
  });
  s.cite(
      "Wolper, Fang, Li, Lu, Gao, Jiang, CD-MPM: Continuum damage material point methods for "
      "dynamic fracture animation, ACM TOG 38(4), 2019, doi 10.1145/3306346.3322949");
  return s;
}

}  // namespace scree
