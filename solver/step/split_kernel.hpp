// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "solver/step/block_bodies.hpp"
#include "solver/step/split_passes.hpp"
#include "solver/transfer/compact.hpp"
#include "solver/transfer/linear.hpp"
#include "solver/transfer/quadratic.hpp"

namespace scree {

/// Calls f(Transfer) with the policy of `transfer` on Kernel; linear has neither mls nor apic, its
/// moment matrix is singular at nodes (rejected when the deck is read).
template <class Kernel, class F>
void with_transfer(TransferType transfer, F&& f) {
  if constexpr (Kernel::has_inverse_moment) {
    if (transfer == TransferType::mls) return f(Mls<Kernel>{});
    if (transfer == TransferType::apic) return f(Apic<Kernel>{});
  }
  if (transfer == TransferType::flip) return f(Pic<Kernel, true>{});
  f(Pic<Kernel, false>{});
}

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
