// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/simulation/schedule.hpp"

namespace scree {

/// Time, the coming step and the one after it are fixed one step ahead: the fused pass scatters the
/// forces of the next step and must know its length.
struct StepClock {
  double time = 0;       ///< [s]
  double dt = 0;         ///< the coming step [s]
  double next_time = 0;  ///< time after the coming step; exactly an event's time where it hits one
  double last_dt = 0;    ///< the step that ended at time
};

/// A step of at most `stable` from t that lands exactly on the next event, the last two steps
/// before it being equal.
struct PlannedStep {
  double dt;
  double end;
};

inline PlannedStep plan_step(const Schedule& schedule, double t, double stable) {
  const double event = schedule.next_event(t);
  const double rest = event - t;
  if (!(rest > 0)) return {stable, t + stable};  // past the end; only when driven beyond it
  const double steps = std::ceil(rest / stable * (1 - 1e-12));
  if (steps <= 1) return {rest, event};
  if (steps <= 2) return {rest / 2, t + rest / 2};
  return {stable, t + stable};
}

/// The particles' extremes that bound the step.
struct MotionBounds {
  double max_speed = 0;      ///< max |v_a| [m/s]
  double max_signal = 0;     ///< max of wave speed + |v| [m/s]
  double max_excursion = 0;  ///< farthest stray outside a home block [cells]
};

/// dt = min(cfl dx / max(c + |v|), dx / (5 max |v_a|)).
inline double stable_step(const MotionBounds& bounds, double cell_size, double cfl) {
  if (!(bounds.max_signal > 0))
    return std::numeric_limits<double>::infinity();  // no particles left
  const double wave = cfl * cell_size / bounds.max_signal;
  return bounds.max_speed > 0 ? std::min(wave, cell_size / (5 * bounds.max_speed)) : wave;
}

}  // namespace scree
