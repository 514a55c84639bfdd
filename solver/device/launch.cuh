// SPDX-License-Identifier: Apache-2.0
/// \file
/// Launches of kernels, by either compiler.
#pragma once

#include <string>

#include "solver/base/error.hpp"
#include "solver/exec/cuda_leaves.cuh"

namespace scree {
inline namespace SCREE_SIDE {

#ifdef __CUDACC__
/// Threads of a block: 8 warps; 4^3 cells of 8 particles are two rounds.
inline constexpr int block_threads = 256;

/// Throws RunFault where a call of the CUDA run-time library failed.
inline void check(cudaError_t error, const char* what) {
  if (error == cudaSuccess) return;
  (void)cudaGetLastError();
  throw RunFault(std::string("the GPU failed at ") + what + ": " + cudaGetErrorString(error));
}

/// kernel(arguments...) by `blocks` thread blocks; nothing where there is none.
template <class... P, class... A>
void launch(const char* what, void (*kernel)(P...), int blocks, int threads,
            const A&... arguments) {
  if (blocks == 0) return;
  kernel<<<blocks, threads>>>(arguments...);
  check(cudaGetLastError(), what);
}
#else
inline constexpr int block_threads = 64;  // fewer turns of fibers than on a GPU

template <class... P, class... A>
void launch(const char*, void (*kernel)(P...), int blocks, int threads, const A&... arguments) {
  if (blocks == 0) return;
  emulation::launch(blocks, threads, [&] { kernel(arguments...); });
}
#endif

/// Blocks for a kernel with one thread an element.
inline int blocks_for(std::int64_t elements) {
  return int((elements + block_threads - 1) / block_threads);
}

/// Number of this thread in a launch with one thread an element.
SCREE_FN std::int64_t element() {
  return std::int64_t(device::block()) * device::threads() + device::thread();
}

}  // namespace SCREE_SIDE
}  // namespace scree
