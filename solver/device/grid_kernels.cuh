// SPDX-License-Identifier: Apache-2.0
/// \file
/// The grid update as kernels: what GridUpdate does on the processor, line by line.
#pragma once

#include <cmath>

#include "solver/device/kernels.hpp"
#include "solver/device/launch.cuh"
#include "solver/grid/face_fold.hpp"
#include "solver/grid/node_contact.hpp"

namespace scree {
inline namespace SCREE_SIDE {
namespace kernels {

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

/// A thread a value of a channel.
template <class T>
__global__ void from_fixed(const __grid_constant__ FixedChannels sums, int channel,
                           std::int64_t values, T* out) {
  const std::int64_t i = element();
  if (i >= values) return;
  const double units = double((long long)(sums.sum[channel][i]));
  if (i % node_values == mass_slot) {
    out[i] = T(units * sums.mass);
  } else {
    out[i] = *sums.overflow != 0 ? T(NAN) : T(units * sums.momentum);
  }
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
__global__ void fold(const __grid_constant__ FoldLines lines, int stage, T* p, T* before) {
  const std::int64_t line = element();
  if (line >= lines.lines) return;
  for (int i = lines.line_begin[line]; i < lines.line_begin[line + 1]; ++i) {
    const int side = lines.side[i];
    const FaceType type = lines.type[side];
    if (fold_stage(type, lines.no_slip) != stage) continue;
    const T friction = T(lines.friction[side]);
    const std::int64_t image = lines.image[i] * node_values;
    const std::int64_t ghost = lines.ghost[i] * node_values;
    T* image_before = before == nullptr ? nullptr : before + image;
    if (ghost == image) {
      hold_wall_node<D>(type, friction, lines.axis, side, p + image, image_before);
    } else {
      T* ghost_before = before == nullptr ? nullptr : before + ghost;
      lines.folded[i] = fold_ghost<D>(type, lines.no_slip, friction, lines.axis, side, p + image,
                                      p + ghost, image_before, ghost_before);
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
__global__ void unfold(const __grid_constant__ FoldLines lines, int stage, T* p, T* q) {
  const std::int64_t line = element();
  if (line >= lines.lines) return;
  for (int i = lines.line_begin[line]; i < lines.line_begin[line + 1]; ++i) {
    const FaceType type = lines.type[lines.side[i]];
    if (fold_stage(type, lines.no_slip) != stage) continue;
    const std::int64_t image = lines.image[i] * node_values;
    const std::int64_t ghost = lines.ghost[i] * node_values;
    if (lines.folded[i] != pair_follows || ghost == image) continue;
    unfold_ghost<D>(type, lines.no_slip, lines.axis, p + image, p + ghost);
    if (q != nullptr) unfold_ghost<D>(type, lines.no_slip, lines.axis, q + image, q + ghost);
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

/// A thread a node.
template <int D, class T>
__global__ void damp(const __grid_constant__ NodePass<T> pass) {
  const std::int64_t i = element();
  if (i >= std::int64_t(pass.blocks) * pass.block_nodes) return;
  T* node = pass.p + i * node_values;
  if (!(node[mass_slot] > T(0))) return;
  double change[3] = {0, 0, 0};
  local_damping<D>(node, pass.q + i * node_values, pass.local, change);
  for (int a = 0; a < D; ++a) node[a] += T(change[a]);
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

SCREE_FN Vec3<double> vector_of(const double* x) { return {x[0], x[1], x[2]}; }

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
    Vec3<double> impulse{};
    nodes.holds[k] = 0;
    if (mass > 0) {
      const ContactSurface& surface = surfaces[nodes.collider[k]];
      nodes.holds[k] =
          touch_surface<D>(surface.type, surface.coefficient, vector_of(surface.velocity),
                           vector_of(nodes.normal + 3 * k), mass, node, impulse);
    }
    for (int a = 0; a < 3; ++a) nodes.impulse[3 * k + a] = impulse[a];
  }
  double change[3] = {0, 0, 0};
  if (mass > 0 && pass.local > T(0)) {
    local_damping<D>(node, pass.q + nodes.record[n] * node_values, pass.local, change);
  }
  for (int k = nodes.begin[n]; k < nodes.begin[n + 1]; ++k) {
    if (nodes.holds[k] == 0) continue;
    if (surfaces[nodes.collider[k]].type == ContactType::sticky) {
      for (double& component : change) component = 0;
    }
    remove_along<D>(vector_of(nodes.normal + 3 * k), change);
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
