// SPDX-License-Identifier: Apache-2.0
/// \file
/// Kernels that read and write a few particles among many.
#pragma once

#include "solver/device/kernels.hpp"
#include "solver/device/launch.cuh"
#include "solver/device/pool_entry.hpp"

namespace scree {
inline namespace SCREE_SIDE {
namespace kernels {

/// Place of an id in a list in ascending order, -1 where it is not there.
SCREE_FN std::int32_t place_of(const std::int64_t* ids, std::int32_t count, std::int64_t id) {
  std::int32_t first = 0;
  std::int32_t end = count;
  while (first < end) {
    const std::int32_t middle = first + (end - first) / 2;
    if (ids[middle] < id) {
      first = middle + 1;
    } else {
      end = middle;
    }
  }
  return first < count && ids[first] == id ? first : -1;
}

/// A thread block a block of the body.
template <int D, class T>
__global__ void __launch_bounds__(block_threads)
    find_chosen(const __grid_constant__ PassData<D, T> data,
                const __grid_constant__ ChosenRows<T> chosen) {
  const int block = int(blockIdx.x);
  const int first = data.batch_begin[block] * device_width;
  for (int i = device::thread(); i < data.counts[block]; i += device::threads()) {
    const std::int32_t place = place_of(chosen.ids, chosen.count, data.ids[first + i]);
    if (place >= 0) chosen.lane[place] = first + i;
  }
}

/// A thread a particle.
template <int D, class T>
__global__ void __launch_bounds__(block_threads)
    read_chosen(const __grid_constant__ PassData<D, T> data,
                const __grid_constant__ ChosenRows<T> chosen) {
  const std::int64_t k = element();
  if (k >= chosen.count || chosen.lane[k] < 0) return;
  const std::int64_t lane = chosen.lane[k];
  const T* fields = data.particles + pool_entry(lane, data.fields);
  const T* aux = data.aux + pool_entry(lane, data.layout.total);
  T* row = chosen.rows + k * (3 * D + D * D);
  for (int a = 0; a < D; ++a) row[a] = fields[a * device_width];
  for (int a = 0; a < D; ++a) row[D + a] = aux[(data.layout.velocity + a) * device_width];
  for (int i = 0; i < D * D; ++i) {
    row[2 * D + i] = aux[(data.layout.increment + i) * device_width];
  }
  for (int a = 0; a < D; ++a) {
    row[2 * D + D * D + a] = aux[(data.layout.external + a) * device_width];
  }
}

/// A thread a particle.
template <int D, class T>
__global__ void __launch_bounds__(block_threads)
    write_chosen(const __grid_constant__ PassData<D, T> data,
                 const __grid_constant__ ChosenRows<T> chosen) {
  const std::int64_t k = element();
  if (k >= chosen.count || chosen.lane[k] < 0) return;
  T* aux = data.aux + pool_entry(chosen.lane[k], data.layout.total);
  for (int a = 0; a < D; ++a) {
    aux[(data.layout.external + a) * device_width] = chosen.rows[k * D + a];
  }
}

}  // namespace kernels
}  // namespace SCREE_SIDE
}  // namespace scree
