// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "solver/step/cuda_kernels.cuh"
#include "solver/step/with_transfer.hpp"

namespace scree {
inline namespace SCREE_SIDE {

/// Launches the split pair on one kernel; one unit a kernel instantiates it.
template <class Kernel, int D, class T>
struct SplitLaunch {
  static void p2g(TransferType transfer, const PassData<D, T>& data, int blocks);
  static void p2g_fixed(TransferType transfer, const PassData<D, T>& data,
                        const FixedChannels& channels, int blocks);
  static void g2p(TransferType transfer, const PassData<D, T>& data, int blocks);
};

template <class Kernel, int D, class T>
void SplitLaunch<Kernel, D, T>::p2g(TransferType transfer, const PassData<D, T>& data, int blocks) {
  with_transfer<Kernel>(transfer, [&](auto policy) {
    launch("p2g", kernels::p2g<Kernel, decltype(policy), D, T>, blocks, block_threads, data);
  });
}

template <class Kernel, int D, class T>
void SplitLaunch<Kernel, D, T>::p2g_fixed(TransferType transfer, const PassData<D, T>& data,
                                          const FixedChannels& channels, int blocks) {
  with_transfer<Kernel>(transfer, [&](auto policy) {
    launch("p2g_fixed", kernels::p2g_fixed<Kernel, decltype(policy), D, T>, blocks, block_threads,
           data, channels);
  });
}

template <class Kernel, int D, class T>
void SplitLaunch<Kernel, D, T>::g2p(TransferType transfer, const PassData<D, T>& data, int blocks) {
  with_transfer<Kernel>(transfer, [&](auto policy) {
    launch("g2p", kernels::g2p<Kernel, decltype(policy), D, T>, blocks, block_threads, data);
  });
}

}  // namespace SCREE_SIDE
}  // namespace scree

/// Instances for all dimensions and precisions.
#define SCREE_SPLIT_LAUNCH(prefix, Kernel)               \
  prefix template struct SplitLaunch<Kernel, 2, float>;  \
  prefix template struct SplitLaunch<Kernel, 2, double>; \
  prefix template struct SplitLaunch<Kernel, 3, float>;  \
  prefix template struct SplitLaunch<Kernel, 3, double>;
