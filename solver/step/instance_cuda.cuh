// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "solver/simulation/method.hpp"
#include "solver/step/cuda_kernels.cuh"
#include "solver/transfer/compact.hpp"
#include "solver/transfer/quadratic.hpp"

namespace scree {

/// Launches the passes that contain code of one law. `data` points to device memory, its store has
/// batches of 32; `blocks` is a device list of `count` body blocks.
template <class Material, int D, class T>
struct CudaMaterial {
  using Params = typename Material::template Params<T>;

  /// Fused pass (mls; compact or quadratic). Returns the launch's error code.
  static cudaError_t g2p2g(const PassData<D, T>& data, const Params& material,
                           const std::int32_t* blocks, int count, KernelType kernel,
                           cudaStream_t stream) {
    if (count == 0) return cudaSuccess;
    if (kernel == KernelType::compact) {
      cuda::g2p2g<Compact, Material>
          <<<count, cuda::block_threads, 0, stream>>>(data, material, blocks);
    } else {
      cuda::g2p2g<Quadratic, Material>
          <<<count, cuda::block_threads, 0, stream>>>(data, material, blocks);
    }
    return cudaGetLastError();
  }

  /// Material update from the stored dt grad v.
  static cudaError_t stress(const PassData<D, T>& data, const Params& material,
                            const std::int32_t* blocks, int count, cudaStream_t stream) {
    if (count == 0) return cudaSuccess;
    cuda::stress<Material, Compact>
        <<<count, cuda::block_threads, 0, stream>>>(data, material, blocks);
    return cudaGetLastError();
  }
};

}  // namespace scree

/// Compiles one law for one dimension and precision; one translation unit each, written by CMake.
#define SCREE_INSTANTIATE_CUDA(Type, D, real)  \
  namespace scree {                            \
  template struct CudaMaterial<Type, D, real>; \
  }
