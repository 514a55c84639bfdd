// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "verification/conformance/checks.hpp"

namespace scree::testing {

void Worst::add(double e) {
  error = std::isnan(e) ? std::numeric_limits<double>::infinity() : std::max(error, e);
  ++samples;
  large += !(e <= 1e-4);
}

void Worst::add(const Worst& other) {
  error = std::max(error, other.error);
  samples += other.samples;
  large += other.large;
}

Worst change_without_strain(const Law& law, MatrixSource& source, int count) {
  Worst worst;
  for (int n = 0; n < count; ++n) {
    State state = state_of_any_size(law, source, 0.1);
    const Sym3<double> last = advance(law, state, source.entries(0.03));
    if (!law.exact->admissible(state)) continue;
    State again = state;
    const Sym3<double> now = law.exact->kirchhoff(again, zero3<double>(), 0.0);
    worst.add(norm(now - last) / stress_scale(law, state, last));
    worst.add(distance_of_entries(state, again));
  }
  return worst;
}

namespace {

/// Differences of the scalars of two states that a rotation must not change.
double scalar_distance(const Law& law, const State& a, const State& b, double scale) {
  const Point<double>& p = *law.exact;
  return std::max({std::abs(p.volume_ratio(a) / p.volume_ratio(b) - 1),
                   std::abs(p.energy_density(a) - p.energy_density(b)) / scale,
                   std::abs(p.wave_speed(a) / p.wave_speed(b) - 1)});
}

/// Error of the stress after a rotation as an increment, from a state where steps are elastic: flow
/// may go on where it depends on the rate or where hardening is explicit. A fluid sees the rate.
double loss_in_a_turn(const Law& law, MatrixSource& source) {
  const auto start = elastic_state(law, source);
  if (!start || !law.has_field("deformation_gradient")) return 0;
  State state = *start;
  const Eigen::Matrix3d q = source.rotation();
  const Sym3<double> before = stress_at_rest(law, state);
  advance(law, state, q - Eigen::Matrix3d::Identity());
  const Eigen::Matrix3d after = to_eigen(stress_at_rest(law, state));
  return (after - q * to_eigen(before) * q.transpose()).norm() / stress_scale(law, state, before);
}

}  // namespace

Worst loss_of_objectivity(const Law& law, MatrixSource& source, int count) {
  Worst worst;
  for (int n = 0; n < count; ++n) {
    State state = state_of_any_size(law, source, 0.1);
    if (!law.exact->admissible(state)) continue;
    const Eigen::Matrix3d q = source.rotation(), L = source.entries(0.05);
    State other = turned(law, state, q);
    const Sym3<double> tau = advance(law, state, L);
    const Sym3<double> seen = advance(law, other, q * L * q.transpose());
    const double scale = stress_scale(law, state, tau);
    worst.add((to_eigen(seen) - q * to_eigen(tau) * q.transpose()).norm() / scale);
    worst.add(scalar_distance(law, state, other, scale));
    worst.add(distance_of_entries(turned(law, state, q), other));
    worst.add(loss_in_a_turn(law, source));
  }
  return worst;
}

Worst loss_of_isotropy(const Law& law, MatrixSource& source, int count) {
  Worst worst;
  for (int n = 0; n < count; ++n) {
    State state = state_of_any_size(law, source, 0.1);
    if (!law.exact->admissible(state)) continue;
    const Eigen::Matrix3d q = source.rotation(), L = source.entries(0.05);
    State other = turned_before(law, state, q);
    const Sym3<double> tau = advance(law, state, L), same = advance(law, other, L);
    const double scale = stress_scale(law, state, tau);
    worst.add(norm(tau - same) / scale);
    worst.add(scalar_distance(law, state, other, scale));
    worst.add(distance_of_entries(turned_before(law, state, q), other));
  }
  return worst;
}

Worst loss_of_volume(const Law& law, MatrixSource& source, int steps) {
  State state = law.exact->initial();
  double by_determinant = law.exact->volume_ratio(state), by_trace = by_determinant;
  const bool solid = law.has_field("deformation_gradient") || law.has_field("log_volume_ratio");
  Worst worst;
  for (int n = 0; n < steps; ++n) {
    const Eigen::Matrix3d L = source.entries(0.02);
    advance(law, state, L);
    by_determinant *= (Eigen::Matrix3d::Identity() + L).determinant();
    by_trace *= 1 + L.trace();
    const double J = law.exact->volume_ratio(state);
    const double error = std::abs(J / by_determinant - 1);
    worst.add(solid ? error : std::min(error, std::abs(J / by_trace - 1)));
  }
  return worst;
}

}  // namespace scree::testing
