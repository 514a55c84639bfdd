// SPDX-License-Identifier: Apache-2.0
/// \file
/// The implicit return map of modified Cam clay, as one equation in the stress ratio.
#pragma once

#include "solver/base/math.hpp"
#include "solver/base/pack.hpp"

namespace scree {

/// ln(p/pc) at which soil has fallen apart: at a pressure of 3e-7 pc it is taken to carry no shear
/// and not to soften any more. The specific volume goes on, so it carries load again when it has
/// come together to where it parted. (The largest q there is M pc e^-7.5: 6e-4 of pc.)
inline constexpr double cam_clay_apart = -15;

/// Trial state of a step; stresses in units of pc at its start.
template <class V>
struct CamClayTrial {
  V log_ratio, ratio;  ///< ln(p/pc) on the swelling line of pc; p/pc, at most 1
  V shear;             ///< q
  V three_shear;       ///< 3 G, constant during the step
  V volume;            ///< specific volume at the end of the step
};

/// What the step ends with; stresses in units of pc at its end.
template <class V>
struct CamClayEnd {
  V ratio;         ///< p
  V keep;          ///< q over its trial value, each in its unit
  V hardening;     ///< growth of ln pc
  V shear_strain;  ///< plastic shear strain
};

namespace detail {

/// The equation of the return, (5) of docs/materials/modified_cam_clay.md. Unknown: t = q/(M p),
/// the stress ratio over that of the critical state. On the yield surface pc/p = 1 + t^2. With d
/// the growth of ln pc, the volume is held: d = (kappa/lambda)(ln(p/pc) of the trial + ln(1 +
/// t^2)); the plastic volume strain is (lambda - kappa) d/v, the plastic shear strain that times 2
/// t/(M (1 - t^2)) (associated flow). Then q* - q = 3 G times the plastic shear strain reads g(t) =
/// 0 with
///
///     g = (q* - M t p)(1 - t^2) - h t d,   p = exp(d)/(1 + t^2),   h = 6 G (lambda - kappa)/(M v)
///
/// which is smooth also at the critical state t = 1 and on the p axis t = 0.
template <class V, class T>
struct CamClayEquation {
  T m, softness;  ///< M, kappa/lambda
  V log_ratio, shear, h;

  V growth, pressure, value, slope;  ///< d, p, g and g' at t

  SCREE_FN void evaluate(V t) {
    const V square = t * t, sum = T(1) + square;
    const V logarithm = log1p(square);
    growth = softness * (log_ratio + logarithm);
    pressure = exp(growth - logarithm);
    const V rest = shear - m * t * pressure, side = T(1) - square;
    const V turn = T(2) * square / sum;  // t d ln(1 + t^2)/dt
    value = rest * side - h * t * growth;
    slope = -m * pressure * (T(1) - (T(1) - softness) * turn) * side - T(2) * t * rest -
            h * (growth + softness * turn);
  }
};

/// The root of g between lower and upper, from a first guess: Newton's method, kept inside the
/// bracket by bisection. Only for the lanes of `active`; converged lanes are frozen, so a lane does
/// not depend on others.
template <class V, class T>
SCREE_FN V cam_clay_root(CamClayEquation<V, T>& g, const V& guess, V lower, V upper,
                         MaskOf<V> active) {
  const V zero = broadcast<V>(0);
  V t = min(max(guess, lower), upper);
  // Newton converges quadratically: an error e leaves about e^2. A halved bracket has no such
  // bonus: it ends at the rounding of T. Bisection alone would need the digits of T and those of
  // the widest bracket, about 80 steps.
  constexpr T converged = sizeof(T) == 4 ? T(3e-5) : T(3e-9);
  constexpr T rounding = sizeof(T) == 4 ? T(2.4e-7) : T(4.4e-16);
  for (int iteration = 0; iteration < 100 && any(active); ++iteration) {
    g.evaluate(t);
    const auto left = g.value > zero;
    lower = select(left, t, lower);
    upper = select(left, upper, t);
    // The quotient is only formed where it stays inside the bracket.
    const auto inside = (g.slope < zero) & (abs(g.value) <= -g.slope * (upper - lower));
    const V newton = t - g.value / select(inside, g.slope, T(-1));
    const V next = select(inside, min(max(newton, lower), upper), T(0.5) * (lower + upper));
    const V change = abs(next - t);
    t = select(active, next, t);
    active =
        active & (change > select(inside, broadcast<V>(converged), broadcast<V>(rounding)) * next);
  }
  return t;
}

}  // namespace detail

/// Closest state on the yield surface, or the trial state itself inside it. The root lies between
/// the ratio without hardening and the critical state; without a lane that yields nothing is
/// solved.
template <class V, class T>
SCREE_FN CamClayEnd<V> cam_clay_return(T m, T lambda, T kappa, const CamClayTrial<V>& trial) {
  const V zero = broadcast<V>(0), one = broadcast<V>(1);
  CamClayEnd<V> end{trial.ratio, one, zero, zero};
  const MaskOf<V> apart = trial.log_ratio <= T(cam_clay_apart);
  end.keep = select(apart, zero, one);
  // t on the surface at the trial pressure. Near the p axis its root turns an error e of ln(p/pc)
  // into sqrt(e). So the trial state yields if it is outside this very end of the bracket; with 1 -
  // p/pc, which cancels there, states on the surface would be sent to sqrt(e).
  const V start = sqrt(max(expm1(-trial.log_ratio), zero));
  const V found = trial.shear / (m * trial.ratio);
  const MaskOf<V> yields = ((found > start) | (trial.log_ratio > T(0))) & !apart;
  if (!any(yields)) return end;
  const V h = (T(2) * (lambda - kappa) / m) * trial.three_shear / trial.volume;
  detail::CamClayEquation<V, T> g{
      m, kappa / lambda, trial.log_ratio, trial.shear, h, zero, zero, zero, zero};
  const V t = detail::cam_clay_root(g, found, min(start, one), max(start, one), yields);
  g.evaluate(t);
  const V shear = m * t * g.pressure;
  const V smallest = broadcast<V>(sizeof(T) == 4 ? T(1e-30) : T(1e-200));
  const V ratio = one / (one + t * t);
  end.ratio = select(yields, ratio, trial.ratio);
  end.keep = select(yields, m * t * ratio / max(trial.shear, smallest), end.keep);
  end.hardening = select(yields, g.growth, zero);
  end.shear_strain =
      select(yields, max(trial.shear - shear, zero) / max(trial.three_shear, smallest), zero);
  return end;
}

}  // namespace scree
