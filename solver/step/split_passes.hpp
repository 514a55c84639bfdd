// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "solver/exec/executor.hpp"
#include "solver/simulation/method.hpp"

namespace scree {

/// Particles to grid over the blocks of one colour.
template <int D, class T>
void run_p2g(KernelType kernel, TransferType transfer, Executor& executor,
             const PassData<D, T>& data, const std::vector<std::int32_t>& blocks);

/// Grid to particles over blocks.
template <int D, class T>
void run_g2p(KernelType kernel, TransferType transfer, Executor& executor,
             const PassData<D, T>& data, const std::vector<std::int32_t>& blocks);

}  // namespace scree
