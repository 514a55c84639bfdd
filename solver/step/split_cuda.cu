// SPDX-License-Identifier: Apache-2.0
#include "solver/step/cuda_kernels.cuh"
#include "solver/transfer/compact.hpp"

namespace scree {

/// Launches the split pair for one kernel and transfer; arguments as for CudaMaterial.
template <class Kernel, class Transfer, int D, class T>
struct CudaSplit {
  static cudaError_t p2g(const PassData<D, T>& data, const std::int32_t* blocks, int count,
                         cudaStream_t stream) {
    if (count == 0) return cudaSuccess;
    cuda::p2g<Kernel, Transfer><<<count, cuda::block_threads, 0, stream>>>(data, blocks);
    return cudaGetLastError();
  }

  static cudaError_t g2p(const PassData<D, T>& data, const std::int32_t* blocks, int count,
                         cudaStream_t stream) {
    if (count == 0) return cudaSuccess;
    cuda::g2p<Kernel, Transfer><<<count, cuda::block_threads, 0, stream>>>(data, blocks);
    return cudaGetLastError();
  }
};

template struct CudaSplit<Compact, Mls<Compact>, 2, float>;
template struct CudaSplit<Compact, Mls<Compact>, 2, double>;
template struct CudaSplit<Compact, Mls<Compact>, 3, float>;
template struct CudaSplit<Compact, Mls<Compact>, 3, double>;

}  // namespace scree
