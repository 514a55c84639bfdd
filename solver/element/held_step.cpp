// SPDX-License-Identifier: Apache-2.0
#include "solver/element/held_step.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace scree {
namespace {

/// Of the residual, relative to the largest stress.
constexpr double tolerance = 1e-10;
/// Most that one iteration changes the logarithmic stretch.
constexpr double longest = 0.05;
constexpr int most_iterations = 100;

}  // namespace

Sym3<double> cauchy_stress(const MaterialPoint& point) {
  return point.stress() * (1 / point.volume_ratio());
}

std::string inadmissible_cause(const MaterialPoint& point, const std::string& what) {
  const double voids = point.void_ratio().value_or(1);
  if (voids > 0) return "the law cannot represent " + what;
  char text[64];
  std::snprintf(text, sizeof text, "no voids are left (void ratio %.3g)", voids);
  return text;
}

double held_component(const Sym3<double>& s, HeldStress held) {
  if (held == HeldStress::mean) return -trace(s) / 3;
  return held == HeldStress::axis_2 ? -s.yy : -0.5 * (s.yy + s.zz);
}

HeldStep::Trial HeldStep::evaluate(double free) {
  ++evaluations_;
  point_.set_entries(saved_);
  point_.advance(motion_.increment(from_, {control_, free}), dt_);
  if (!point_.admissible()) return {};
  const Sym3<double> s = cauchy_stress(point_);
  const double residual = held_component(s, held_) - wanted_;
  const double largest =
      std::max({std::abs(s.xx), std::abs(s.yy), std::abs(s.zz), std::abs(wanted_)});
  return {residual, std::max(tolerance * largest, rounding_), std::isfinite(residual)};
}

double HeldStep::next(double free, const Trial& trial, int iteration) {
  const bool compressed = trial.residual > 0;
  (compressed ? bracket_.low : bracket_.high) = free;
  const double middle = bracket_.closed() ? 0.5 * (bracket_.low + bracket_.high) : free;
  // Every third step halves the interval: Newton's steps can creep towards a kink from one side.
  if (bracket_.closed() && iteration % 3 == 2) return middle;
  // The square root of the rounding unit balances truncation and rounding.
  constexpr double h = 1.5e-8;
  const Trial beside = evaluate(free - h);
  const double slope = beside.usable ? (trial.residual - beside.residual) / h : 0;
  double step = compressed ? longest : -longest;
  if (slope < 0) step = std::clamp(-trial.residual / slope, -longest, longest);
  const double x = free + step;
  return x > bracket_.low && x < bracket_.high ? x : middle;
}

bool HeldStep::search(double guess, HeldOutcome& best) {
  double x = guess, good = from_.free;
  double least = std::numeric_limits<double>::max();
  for (int i = 0; i < most_iterations; ++i) {
    const Trial trial = evaluate(x);
    if (!trial.usable) {  // back towards a state that the law can represent
      best.cause = inadmissible_cause(point_, "the states on the way");
      x = 0.5 * (x + good);
      continue;
    }
    good = x;
    if (std::abs(trial.residual) < least) {
      least = std::abs(trial.residual);
      best.free = x;
      best.stress = trial.residual + wanted_;
    }
    if (std::abs(trial.residual) <= trial.tolerance) return true;
    x = next(x, trial, i);
    best.cause =
        bracket_.closed() ? "the stress jumps there" : "the law does not reach that stress";
  }
  return false;
}

HeldOutcome HeldStep::take(const PathState& from, double control, double wanted, double guess) {
  saved_ = point_.entries();
  from_ = from;
  control_ = control;
  wanted_ = wanted;
  evaluations_ = 0;
  bracket_ = {};
  // Some units of the stiffness rho c^2, which multiplies strains of order one.
  const double speed = point_.wave_speed();
  rounding_ = 8 * std::numeric_limits<double>::epsilon() * density_ * speed * speed;
  HeldOutcome best{false, guess, 0, 0, ""};
  best.converged = search(guess, best);
  if (best.converged) {
    evaluate(best.free);
  } else {
    point_.set_entries(saved_);
  }
  best.evaluations = evaluations_;
  return best;
}

}  // namespace scree
