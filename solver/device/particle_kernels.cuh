// SPDX-License-Identifier: Apache-2.0
/// \file
/// Kernels on particles that hold no method: binning, moving, what blocks report together.
#pragma once

#include "solver/device/kernels.hpp"
#include "solver/device/launch.cuh"
#include "solver/device/pool_entry.hpp"
#include "solver/grid/block.hpp"

namespace scree {
inline namespace SCREE_SIDE {
namespace kernels {

struct Wrap {
  std::int32_t cells[3];
};

/// A thread block a block of the body.
template <int D, class T>
__global__ void __launch_bounds__(block_threads)
    find_homes(const __grid_constant__ PassData<D, T> data, const __grid_constant__ Wrap wrap,
               std::uint64_t* keys, std::int32_t* values) {
  const int block = int(blockIdx.x);
  const int first = data.batch_begin[block] * device_width;
  const int lanes = data.batch_begin[block + 1] * device_width - first;
  for (int i = device::thread(); i < lanes; i += device::threads()) {
    const std::int64_t lane = first + i;
    values[lane] = std::int32_t(lane);
    keys[lane] = ~std::uint64_t(0);
    if (i >= data.counts[block] || data.ids[lane] < 0) continue;
    T* position = data.particles + pool_entry(lane, data.fields);
    BlockCoord<D> target{};
    for (int a = 0; a < D; ++a) {
      T& u = position[a * device_width];
      const std::int32_t home = data.coords[block * D + a];
      if (wrap.cells[a] > 0) {
        const T absolute = T(block_cells) * T(home) + u;
        if (absolute < T(0)) u += T(wrap.cells[a]);
        if (absolute >= T(wrap.cells[a])) u -= T(wrap.cells[a]);
      }
      const int shift = int(floor((u - T(home_begin)) / T(block_cells)));
      target[std::size_t(a)] = home + shift;
      u -= T(block_cells * shift);
    }
    keys[lane] = block_key<D>(target);
  }
}

/// A thread block a new block of the body.
template <class T>
__global__ void __launch_bounds__(block_threads)
    move(const __grid_constant__ ParticlePools<T> from, const __grid_constant__ ParticlePools<T> to,
         const std::int32_t* order, const std::int32_t* first, const std::int32_t* counts,
         const std::int32_t* batch_begin) {
  const int block = int(blockIdx.x);
  const std::int64_t begin = std::int64_t(batch_begin[block]) * device_width;
  for (int i = device::thread(); i < counts[block]; i += device::threads()) {
    const std::int64_t source = order[first[block] + i];
    const std::int64_t target = begin + i;
    to.ids[target] = from.ids[source];
    for (int f = 0; f < from.fields; ++f) {
      to.particles[pool_entry(target, from.fields) + f * device_width] =
          from.particles[pool_entry(source, from.fields) + f * device_width];
    }
    for (int f = 0; f < from.aux_fields; ++f) {
      to.aux[pool_entry(target, from.aux_fields) + f * device_width] =
          from.aux[pool_entry(source, from.aux_fields) + f * device_width];
    }
  }
}

/// What a thread has seen of the blocks' results.
template <class T>
struct PartSummary {  // no initial values: a piece of shared memory must not have any
  T speed;
  T signal;
  T excursion;
  std::int32_t fastest;
  std::int32_t stiffest;
  std::int32_t dead;
  std::int32_t fault_block;
};

/// The larger value and its block; of equal ones the first block.
template <class T>
SCREE_FN void take_larger(T& most, std::int32_t& where, T value, std::int32_t block) {
  if (block < 0) return;
  if (value > most || (value == most && where >= 0 && block < where)) {
    most = value;
    where = block;
  }
}

template <class T>
SCREE_FN void combine(PartSummary<T>& sum, const PartSummary<T>& other) {
  take_larger(sum.speed, sum.fastest, other.speed, other.fastest);
  take_larger(sum.signal, sum.stiffest, other.signal, other.stiffest);
  sum.excursion = other.excursion > sum.excursion ? other.excursion : sum.excursion;
  sum.dead += other.dead;
  const bool earlier = sum.fault_block < 0 || other.fault_block < sum.fault_block;
  if (other.fault_block >= 0 && earlier) sum.fault_block = other.fault_block;
}

template <class T>
struct SummaryRoom {
  PartSummary<T> part[block_threads];
};

/// One thread block.
template <class T>
__global__ void __launch_bounds__(block_threads)
    summarise(const BlockResult<T>* results, int blocks, BodySummary<T>* out) {
  SCREE_SHARED(SummaryRoom<T>, room);
  PartSummary<T> mine{T(0), T(0), T(0), -1, -1, 0, -1};
  for (int b = device::thread(); b < blocks; b += device::threads()) {
    const BlockResult<T>& result = results[b];
    const std::int32_t fault_block = result.fault == FaultCode::none ? -1 : b;
    combine(mine, PartSummary<T>{result.max_speed, result.max_signal, result.max_excursion, b, b,
                                 result.dead, fault_block});
  }
  room.part[device::thread()] = mine;
  device::barrier();
  for (int half = device::threads() / 2; half > 0; half /= 2) {
    if (device::thread() < half) {
      combine(room.part[device::thread()], room.part[device::thread() + half]);
    }
    device::barrier();
  }
  if (device::thread() != 0) return;
  const PartSummary<T>& all = room.part[0];
  out->max_speed = all.speed;
  out->max_signal = all.signal;
  out->max_excursion = all.excursion;
  out->fastest = all.fastest;
  out->stiffest = all.stiffest;
  out->dead = all.dead;
  out->fault_block = all.fault_block;
  out->fault = all.fault_block < 0 ? BlockResult<T>{} : results[all.fault_block];
}

}  // namespace kernels
}  // namespace SCREE_SIDE
}  // namespace scree
