// SPDX-License-Identifier: Apache-2.0
/// \file
/// The block bodies as CUDA kernels: one thread block a block of the body.
#pragma once

#include "solver/device/launch.cuh"
#include "solver/exec/cuda_group.cuh"
#include "solver/step/block_bodies.hpp"

namespace scree {
inline namespace SCREE_SIDE {
namespace kernels {

static_assert(block_threads % 32 == 0, "warps reduce with all their threads");

/// Blocks that must fit on a multiprocessor, which bounds the registers of a thread: 65536 / (256 x
/// 4) = 64 in single precision, 128 in double.
template <class T>
inline constexpr int blocks_per_processor = sizeof(T) == 4 ? 4 : 2;

template <class Kernel, class Transfer, int D, class T>
__global__ void __launch_bounds__(block_threads, blocks_per_processor<T>)
    p2g(const __grid_constant__ PassData<D, T> data) {
  using Group = CudaGroup<D, T, Kernel, 0, 2>;
  SCREE_SHARED(typename Group::Arena, arena);
  Group group(data, arena.value, int(blockIdx.x));
  p2g_block<Kernel, Transfer>(group, data);
  group.finish();
}

/// The same with sums in fixed point.
template <class Kernel, class Transfer, int D, class T>
__global__ void __launch_bounds__(block_threads, blocks_per_processor<double>)
    p2g_fixed(const __grid_constant__ PassData<D, T> data,
              const __grid_constant__ FixedChannels channels) {
  using Group = CudaGroup<D, T, Kernel, 0, 2, FixedSums>;
  SCREE_SHARED(typename Group::Arena, arena);
  Group group(data, arena.value, int(blockIdx.x), FixedSums<D, T>(channels));
  p2g_block<Kernel, Transfer>(group, data);
  group.finish();
}

template <class Kernel, class Transfer, int D, class T>
__global__ void __launch_bounds__(block_threads, blocks_per_processor<T>)
    g2p(const __grid_constant__ PassData<D, T> data) {
  using Group = CudaGroup<D, T, Kernel, Transfer::reads_increment ? 2 : 1, 0>;
  SCREE_SHARED(typename Group::Arena, arena);
  Group group(data, arena.value, int(blockIdx.x));
  g2p_block<Kernel, Transfer>(group, data);
  group.finish();
}

template <class Material, class Kernel, int D, class T>
__global__ void __launch_bounds__(block_threads, blocks_per_processor<T>)
    stress(const __grid_constant__ PassData<D, T> data,
           const __grid_constant__ typename Material::template Params<T> material) {
  CudaGroup<D, T, Kernel, 0, 0> group(data, nullptr, int(blockIdx.x));
  stress_block<Material>(group, data, material);
  group.finish();
}

template <class Kernel, class Material, int D, class T>
__global__ void __launch_bounds__(block_threads, blocks_per_processor<T>)
    g2p2g(const __grid_constant__ PassData<D, T> data,
          const __grid_constant__ typename Material::template Params<T> material) {
  using Group = CudaGroup<D, T, Kernel, 1, 1>;
  SCREE_SHARED(typename Group::Arena, arena);
  Group group(data, arena.value, int(blockIdx.x));
  g2p2g_block<Kernel, Material>(group, data, material);
  group.finish();
}

}  // namespace kernels
}  // namespace SCREE_SIDE
}  // namespace scree
