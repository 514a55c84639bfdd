// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "solver/deck/deck.hpp"

namespace scree {

/// What a body's water does, one line a body: mobility k, coefficient of consolidation c_v =
/// k/(1/M + alpha^2/E_oed), the time H^2/c_v in which it drains over its height (along gravity, or
/// its longest side without), and the bound of the time step, that of the drained soil. E_oed is
/// that of the law's wave speed at the start. Empty without [coupling].
std::vector<std::string> coupling_report(const Deck& deck);

}  // namespace scree
