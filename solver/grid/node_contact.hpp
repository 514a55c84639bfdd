// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "solver/boundary/contact.hpp"

/// What colliders and local damping do to the velocity of one node, for host and device code.
namespace scree {

/// One collider at a node of mass `mass` [kg] and velocity v [m/s]: v becomes that in contact;
/// impulse [kg m/s]: on the collider. True if the collider holds something of the velocity.
template <int D, class T>
SCREE_FN bool touch_surface(ContactType type, double coefficient, const Vec3<double>& velocity,
                            const Vec3<double>& normal, double mass, T* v, Vec3<double>& impulse) {
  Vec3<double> old{};
  for (int a = 0; a < D; ++a) old[a] = double(v[a]);
  const Vec3<double> now = contact_velocity<double, D>(type, coefficient, old, velocity, normal);
  bool holds = false;
  for (int a = 0; a < D; ++a) {
    impulse[a] = mass * (old[a] - now[a]);
    holds = holds || old[a] != now[a];
    v[a] = T(now[a]);
  }
  return holds;
}

/// Cundall's damping as a change of velocity [m/s]: a fraction of the unbalanced force opposes the
/// velocity before it. A component that a wall holds at rest is in balance.
template <int D, class T>
SCREE_FN void local_damping(const T* v, const T* before, T fraction, double (&change)[3]) {
  for (int a = 0; a < D; ++a) {
    if (v[a] == T(0)) continue;
    const T force = v[a] - before[a];
    const double damping = double(fraction * (force < T(0) ? -force : force));
    change[a] = before[a] > T(0) ? -damping : before[a] < T(0) ? damping : 0.0;
  }
}

/// What a collider holds of the velocity stays as it is: its force is part of the balance there.
template <int D>
SCREE_FN void remove_along(const Vec3<double>& normal, double (&change)[3]) {
  double along = 0;
  for (int a = 0; a < D; ++a) along += change[a] * normal[a];
  for (int a = 0; a < D; ++a) change[a] -= along * normal[a];
}

}  // namespace scree
