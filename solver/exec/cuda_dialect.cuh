// SPDX-License-Identifier: Apache-2.0
/// \file
/// CUDA C++ for both compilers: nvcc compiles kernels for a GPU, a C++ compiler the same text for
/// the emulation (solver/emulation), whose threads are fibers. Each side has its own inline
/// namespace, so that both may be linked into one program; a unit sees one of them.
#pragma once

#include "solver/base/config.hpp"

#ifdef __CUDACC__
#include <cuda_runtime.h>

#define SCREE_SIDE cuda
/// A variable in the shared memory of a thread block, not initialised.
#define SCREE_SHARED(Type, name) __shared__ Type name
namespace scree {
inline namespace cuda {
/// Where a barrier stands in the source; the emulation compares it.
struct CallPlace {};
}  // namespace cuda
}  // namespace scree
#define SCREE_CALL_PLACE \
  ::scree::cuda::CallPlace {}
#else
#include "solver/emulation/cuda_words.hpp"

#define SCREE_SIDE emulated
#define SCREE_SHARED(Type, name) Type& name = ::scree::emulation::shared<Type>([] {})
namespace scree {
inline namespace emulated {
using CallPlace = std::source_location;
}  // namespace emulated
}  // namespace scree
#define SCREE_CALL_PLACE std::source_location::current()
#endif

// nvcc reads host-device functions twice; only for the device do the words of a kernel mean
// something.
#if defined(__CUDACC__) && !defined(__CUDA_ARCH__)
#define SCREE_IN_KERNEL 0
#else
#define SCREE_IN_KERNEL 1
#endif
