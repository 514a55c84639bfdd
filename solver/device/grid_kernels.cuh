// SPDX-License-Identifier: Apache-2.0
/// \file
/// The grid update as kernels: what GridUpdate does on the processor, line by line.
#pragma once

#include "solver/boundary/contact.hpp"
#include "solver/device/kernels.hpp"
#include "solver/device/launch.cuh"
#include "solver/grid/face_fold.hpp"

namespace scree {
inline namespace SCREE_SIDE {
namespace kernels {

/// Contacts of one node that local damping takes account of.
inline constexpr int max_contacts = 16;

/// Shared memory for block_sum.
struct SumRoom {
  double value[block_threads];
};

/// A thread block a block of nodes. block_mass[b]: sum of its masses.
template <int D, class T>
__global__ void __launch_bounds__(block_threads)
    add_forces(const __grid_constant__ NodePass<T> pass, double* block_mass) {
  SCREE_SHARED(SumRoom, room);
  const std::int64_t first = std::int64_t(blockIdx.x) * pass.block_nodes;
  double mass = 0;
  for (int n = device::thread(); n < pass.block_nodes; n += device::threads()) {
    T* node = pass.p + (first + n) * node_values;
    mass += double(node[mass_slot]);
    for (int a = 0; a < D; ++a) {
      const T before = node[a];
      node[a] += node[mass_slot] * pass.kick[a];
      if (pass.q == nullptr) continue;
      T& other = pass.q[(first + n) * node_values + a];
      node[a] += other;
      other = before;
    }
  }
  const double sum = device::block_sum(mass, room.value);
  if (device::thread() == 0) block_mass[blockIdx.x] = sum;
}

/// One thread block. *out = sum of n values x factor. (A template, as an inline kernel may not be.)
template <class Real>
__global__ void __launch_bounds__(block_threads)
    sum_up(const Real* values, int n, Real factor, Real* out) {
  SCREE_SHARED(SumRoom, room);
  double part = 0;
  for (int i = device::thread(); i < n; i += device::threads()) part += values[i];
  const double sum = device::block_sum(part, room.value);
  if (device::thread() == 0) *out = sum * factor;
}

/// A thread a line.
template <int D, class T>
__global__ void fold(const __grid_constant__ FoldLines lines, bool held, T* p, T* before) {
  const std::int64_t line = element();
  if (line >= lines.lines) return;
  for (int i = lines.line_begin[line]; i < lines.line_begin[line + 1]; ++i) {
    const int side = lines.side[i];
    const FaceType type = lines.type[side];
    if ((type == FaceType::sticky) != held) continue;
    const T friction = T(lines.friction[side]);
    const std::int64_t image = lines.image[i] * node_values;
    const std::int64_t ghost = lines.ghost[i] * node_values;
    T* image_before = before == nullptr ? nullptr : before + image;
    if (ghost == image) {
      hold_wall_node<D>(type, friction, lines.axis, side, p + image, image_before);
    } else {
      T* ghost_before = before == nullptr ? nullptr : before + ghost;
      lines.folded[i] = fold_ghost<D>(type, friction, lines.axis, side, p + image, p + ghost,
                                      image_before, ghost_before);
    }
  }
}

template <class T>
__global__ void fold_periodic(const __grid_constant__ FoldLines lines, T* p) {
  const std::int64_t line = element();
  if (line >= lines.lines) return;
  for (int i = lines.line_begin[line]; i < lines.line_begin[line + 1]; ++i) {
    if (lines.type[lines.side[i]] != FaceType::periodic) continue;
    move_to_image(p + lines.image[i] * node_values, p + lines.ghost[i] * node_values);
  }
}

template <int D, class T>
__global__ void unfold(const __grid_constant__ FoldLines lines, bool held, T* p, T* q) {
  const std::int64_t line = element();
  if (line >= lines.lines) return;
  for (int i = lines.line_begin[line]; i < lines.line_begin[line + 1]; ++i) {
    const FaceType type = lines.type[lines.side[i]];
    if ((type == FaceType::sticky) != held) continue;
    const std::int64_t image = lines.image[i] * node_values;
    const std::int64_t ghost = lines.ghost[i] * node_values;
    if (lines.folded[i] == 0 || ghost == image) continue;
    unfold_ghost<D>(type, lines.axis, p + image, p + ghost);
    if (q != nullptr) unfold_ghost<D>(type, lines.axis, q + image, q + ghost);
  }
}

/// A thread a node.
template <int D, class T>
__global__ void divide(const __grid_constant__ NodePass<T> pass) {
  const std::int64_t i = element();
  if (i >= std::int64_t(pass.blocks) * pass.block_nodes) return;
  T* node = pass.p + i * node_values;
  const T mass = node[mass_slot];
  for (int a = 0; a < D; ++a) {
    node[a] = mass > T(0) ? node[a] / mass * pass.keep : T(0);
    if (pass.q == nullptr) continue;
    T& before = pass.q[i * node_values + a];
    before = mass > T(0) ? before / mass : T(0);
  }
}

/// Cundall's damping of one component: a fraction of the unbalanced force opposes the velocity
/// before it; a component that a wall holds at rest is in balance.
template <class T>
SCREE_FN double damping_change(T v, T before, T fraction) {
  if (v == T(0)) return 0;
  const T change = v - before;
  const double size = double(fraction * (change < T(0) ? -change : change));
  return before > T(0) ? -size : before < T(0) ? size : 0.0;
}

/// A thread a node.
template <int D, class T>
__global__ void damp(const __grid_constant__ NodePass<T> pass) {
  const std::int64_t i = element();
  if (i >= std::int64_t(pass.blocks) * pass.block_nodes) return;
  T* node = pass.p + i * node_values;
  if (!(node[mass_slot] > T(0))) return;
  for (int a = 0; a < D; ++a) {
    node[a] += T(damping_change(node[a], pass.q[i * node_values + a], pass.local));
  }
}

/// A thread a node in contact: gives it the velocity that touch() has settled.
template <int D, class T>
__global__ void settle(const __grid_constant__ ContactNodes nodes, T* p) {
  const std::int64_t n = element();
  if (n >= nodes.nodes) return;
  for (int a = 0; a < D; ++a) p[nodes.record[n] * node_values + a] = T(nodes.settled[3 * n + a]);
}

template <int D, class T>
__global__ void subtract(const __grid_constant__ NodePass<T> pass) {
  const std::int64_t i = element();
  if (i >= std::int64_t(pass.blocks) * pass.block_nodes) return;
  for (int a = 0; a < D; ++a) {
    T& q = pass.q[i * node_values + a];
    q = pass.p[i * node_values + a] - q;
  }
}

/// Contact k of a node: its velocity after it, and the impulse on the collider. True if the
/// collider holds something of the velocity.
template <int D, class T>
SCREE_FN bool touch_once(const ContactNodes& nodes, const ContactSurface& surface, int k,
                         double mass, T* node) {
  Vec3<double> old{};
  Vec3<double> velocity{};
  Vec3<double> normal{};
  for (int a = 0; a < D; ++a) {
    old[a] = double(node[a]);
    velocity[a] = surface.velocity[a];
    normal[a] = nodes.normal[3 * k + a];
  }
  const Vec3<double> now =
      contact_velocity<double, D>(surface.type, surface.coefficient, old, velocity, normal);
  bool holds = false;
  for (int a = 0; a < D; ++a) {
    nodes.impulse[3 * k + a] = mass * (old[a] - now[a]);
    holds = holds || old[a] != now[a];
    node[a] = T(now[a]);
  }
  return holds;
}

/// A thread a node: its contacts one after the other, then local damping of what they do not hold.
template <int D, class T>
__global__ void touch(const __grid_constant__ ContactNodes nodes, const ContactSurface* surfaces,
                      const __grid_constant__ NodePass<T> pass) {
  const std::int64_t n = element();
  if (n >= nodes.nodes) return;
  T* node = pass.p + nodes.record[n] * node_values;
  // A reaction stops what mass damping has left of the momentum, and 1/keep of it.
  const double mass = double(node[mass_slot]) / double(pass.keep);
  for (int k = nodes.begin[n]; k < nodes.begin[n + 1]; ++k) {
    for (int a = 0; a < 3; ++a) nodes.impulse[3 * k + a] = 0;
  }
  for (int a = 0; a < D; ++a) nodes.settled[3 * n + a] = double(node[a]);
  if (!(mass > 0)) return;
  bool held[max_contacts] = {};
  for (int k = nodes.begin[n]; k < nodes.begin[n + 1]; ++k) {
    const bool holds = touch_once<D>(nodes, surfaces[nodes.collider[k]], k, mass, node);
    if (k - nodes.begin[n] < max_contacts) held[k - nodes.begin[n]] = holds;
  }
  double change[3] = {0, 0, 0};
  if (pass.local > T(0)) {
    const T* before = pass.q + nodes.record[n] * node_values;
    for (int a = 0; a < D; ++a) change[a] = damping_change(node[a], before[a], pass.local);
  }
  for (int k = nodes.begin[n]; k < nodes.begin[n + 1]; ++k) {
    if (k - nodes.begin[n] >= max_contacts || !held[k - nodes.begin[n]]) continue;
    const bool all = surfaces[nodes.collider[k]].type == ContactType::sticky;
    double along = 0;
    for (int a = 0; a < D; ++a) along += change[a] * nodes.normal[3 * k + a];
    for (int a = 0; a < D; ++a) change[a] = all ? 0 : change[a] - along * nodes.normal[3 * k + a];
  }
  for (int a = 0; a < D; ++a) nodes.settled[3 * n + a] = double(node[a] + T(change[a]));
}

/// A thread block a collider.
template <class Real>
__global__ void __launch_bounds__(block_threads)
    react(const __grid_constant__ ContactSums sums, const ContactSurface* surfaces,
          const Real* impulse, Real* reactions) {
  SCREE_SHARED(SumRoom, room);
  const int c = int(blockIdx.x);
  double part[6] = {0, 0, 0, 0, 0, 0};
  for (int i = sums.begin[c] + device::thread(); i < sums.begin[c + 1]; i += device::threads()) {
    const int k = sums.list[i];
    Vec3<double> arm{};
    Vec3<double> push{};
    for (int a = 0; a < 3; ++a) {
      arm[a] = sums.position[3 * k + a] - surfaces[c].centre[a];
      push[a] = impulse[3 * k + a];
    }
    const Vec3<double> torque = cross(arm, push);
    for (int a = 0; a < 3; ++a) {
      part[a] += push[a];
      part[3 + a] += torque[a];
    }
  }
  for (int i = 0; i < 6; ++i) {
    const double sum = device::block_sum(part[i], room.value);
    if (device::thread() == 0) reactions[6 * c + i] = sum;
  }
}

/// A thread block a block of nodes.
template <class T>
__global__ void __launch_bounds__(block_threads)
    carry_over(const std::int32_t* from_block, int block_values, const T* from, T* to) {
  const std::int32_t source = from_block[blockIdx.x];
  T* target = to + std::int64_t(blockIdx.x) * block_values;
  for (int i = device::thread(); i < block_values; i += device::threads()) {
    target[i] = source < 0 ? T(0) : from[std::int64_t(source) * block_values + i];
  }
}

}  // namespace kernels
}  // namespace SCREE_SIDE
}  // namespace scree
