// SPDX-License-Identifier: Apache-2.0
//
// What the grid update does to the records {vector, mass} of many nodes, one after the other.
#pragma once

#include <cstddef>
#include <vector>

#include "solver/base/tensor.hpp"
#include "solver/grid/grid.hpp"
#include "solver/grid/node_contact.hpp"

namespace scree {

/// A node's record {vector, mass} in one register.
template <class T>
using Record [[gnu::vector_size(4 * sizeof(T)), gnu::may_alias]] = T;

/// Adds mass x kick to each momentum; returns the sum of the masses.
template <class T>
double kick_nodes(T* nodes, std::size_t count, const T (&kick)[3]) {
  const Record<T> step{kick[0], kick[1], kick[2], T(0)};
  double sum[4] = {0, 0, 0, 0};  // of every fourth node: sums that do not wait for each other
  for (std::size_t i = 0; i < count; ++i) {
    Record<T>& node = reinterpret_cast<Record<T>*>(nodes)[i];
    const T mass = node[mass_slot];
    node += mass * step;
    sum[i % 4] += mass;
  }
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

/// Momentum -> velocity x keep; nodes without mass rest.
template <class T>
void divide_by_mass(T* nodes, std::size_t count, T keep) {
  for (std::size_t i = 0; i < count; ++i) {
    Record<T>& node = reinterpret_cast<Record<T>*>(nodes)[i];
    const T mass = node[mass_slot];
    if (!(mass > T(0))) {
      node = Record<T>{T(0), T(0), T(0), mass};
      continue;
    }
    node = node / mass * keep;
    node[mass_slot] = mass;
  }
}

/// Momenta q, of nodes whose masses stand in p, become velocities.
template <int D, class T>
void divide_by_mass_of(const T* p, T* q, std::size_t count) {
  for (std::size_t i = 0; i < count * node_values; i += node_values) {
    const T mass = p[i + mass_slot];
    for (int a = 0; a < D; ++a) q[i + a] = mass > T(0) ? q[i + a] / mass : T(0);
  }
}

/// What a collider holds of a node's velocity: all of it, or what lies along a normal.
struct HeldDirection {
  bool all;
  Vec3<double> normal;
};

/// Local damping of a node that colliders hold.
template <int D, class T>
void damp_node(T* v, const T* before, T fraction, const std::vector<HeldDirection>& held) {
  double change[3] = {0, 0, 0};
  local_damping<D>(v, before, fraction, change);
  for (const HeldDirection& direction : held) {
    if (direction.all) return;
    remove_along<D>(direction.normal, change);
  }
  for (int a = 0; a < D; ++a) v[a] += T(change[a]);
}

/// q <- p - q: the velocity change.
template <int D, class T>
void subtract_from(const T* p, T* q, std::size_t count) {
  for (std::size_t i = 0; i < count * node_values; i += node_values) {
    for (int a = 0; a < D; ++a) q[i + a] = p[i + a] - q[i + a];
  }
}

}  // namespace scree
