// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "solver/step/block_bodies.hpp"
#include "solver/step/split_passes.hpp"
#include "solver/step/with_transfer.hpp"
#include "solver/transfer/compact.hpp"
#include "solver/transfer/linear.hpp"
#include "solver/transfer/quadratic.hpp"

namespace scree {

/// The split pair on one kernel; one translation unit a kernel instantiates it.
template <class Kernel, int D, class T>
struct SplitKernel {
  using Blocks = std::vector<std::int32_t>;

  static void p2g(TransferType transfer, Executor& executor, const PassData<D, T>& data,
                  const Blocks& blocks) {
    with_transfer<Kernel>(transfer, [&](auto policy) {
      for_each_block<Kernel>(executor, data, blocks, [&](auto& group) {
        p2g_block<Kernel, decltype(policy)>(group, data);
      });
    });
  }

  static void g2p(TransferType transfer, Executor& executor, const PassData<D, T>& data,
                  const Blocks& blocks) {
    with_transfer<Kernel>(transfer, [&](auto policy) {
      for_each_block<Kernel>(executor, data, blocks, [&](auto& group) {
        g2p_block<Kernel, decltype(policy)>(group, data);
      });
    });
  }
};

}  // namespace scree
