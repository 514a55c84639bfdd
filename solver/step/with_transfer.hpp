// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "solver/step/transfer.hpp"

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

}  // namespace scree
