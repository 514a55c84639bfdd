// SPDX-License-Identifier: Apache-2.0
// How long the coming step is, and what sets it.
#include <algorithm>
#include <cmath>

#include "solver/base/error.hpp"
#include "solver/simulation/simulation_impl.hpp"

namespace scree {
namespace {

/// A run whose steps fell below this share of the first has gone wrong: it would take more than a
/// million times as long as it began.
constexpr double least_share = 1e-6;

template <int D>
double fastest_axis(const Vec3<double>& velocity) {
  double speed = 0;
  for (int a = 0; a < D; ++a) speed = std::max(speed, std::abs(velocity[a]));
  return speed;
}

}  // namespace

template <int D, class T>
double SimulationImpl<D, T>::stable_dt() const {
  if (setup_.step) return *setup_.step;
  MotionBounds bounds = bounds_;
  for (const Collider& collider : colliders_) {
    bounds.max_speed = std::max(bounds.max_speed, fastest_axis<D>(collider.velocity()));
  }
  return stable_step(bounds, setup_.cell_size, setup_.cfl);
}

/// The first step of all.
template <int D, class T>
PlannedStep SimulationImpl<D, T>::plan_first() {
  const double stable = stable_dt();
  first_stable_ = std::isfinite(stable) ? stable : 0;
  return plan(0, 0);
}

/// The step from t on, which comes after `step` others. Throws RunFault where it would be so short
/// that the run never ends.
template <int D, class T>
PlannedStep SimulationImpl<D, T>::plan(double t, std::int64_t step) {
  stable_ = stable_dt();
  const PlannedStep next = plan_step(setup_.schedule, t, stable_);
  if (next.end > t && stable_ >= least_share * first_stable_) return next;
  throw RunFault(step_fault_text(step + 1, t, step_limit()));
}

template <int D, class T>
StepLimit SimulationImpl<D, T>::step_limit() const {
  StepLimit limit;
  limit.first = first_stable_;
  limit.now = stable_;
  limit.dimension = D;
  if (setup_.step) {
    limit.cause = StepLimit::Cause::fixed;
    return limit;
  }
  MotionBounds still = bounds_;
  still.max_speed = 0;
  const double of_waves = stable_step(still, setup_.cell_size, setup_.cfl);
  const bool waves = !(stable_ < of_waves);
  limit.cause = waves ? StepLimit::Cause::waves : StepLimit::Cause::motion;
  limit.speed = waves ? bounds_.max_signal : bounds_.max_speed;
  const BlockPlace<D>& place = waves ? stiffest_ : fastest_;
  if (place.body >= 0) {
    limit.name = bodies_[std::size_t(place.body)].body->info().material;
    for (int a = 0; a < D; ++a) {
      const double cells = block_cells * (place.block[std::size_t(a)] + 0.5) + home_begin;
      const double inside = std::clamp(cells, 0.0, double(domain_.cells[a]));
      limit.place[std::size_t(a)] = setup_.lower[std::size_t(a)] + setup_.cell_size * inside;
    }
  }
  for (const Collider& collider : colliders_) {
    const double speed = fastest_axis<D>(collider.velocity());
    if (waves || speed <= limit.speed) continue;
    limit.cause = StepLimit::Cause::collider;
    limit.speed = speed;
    limit.name = collider.name();
  }
  return limit;
}

template class SimulationImpl<2, float>;
template class SimulationImpl<2, double>;
template class SimulationImpl<3, float>;
template class SimulationImpl<3, double>;

}  // namespace scree
