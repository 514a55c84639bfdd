// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "solver/exec/executor.hpp"
#include "solver/simulation/method.hpp"

namespace scree {

/// Volumes and their changes to nodes over the blocks of one colour. ratio: aux field of the volume
/// ratio.
template <int D, class T>
void run_volume_scatter(KernelType kernel, Executor& executor, const PassData<D, T>& data,
                        int ratio, const std::vector<std::int32_t>& blocks);

/// Mean changes from nodes to the stored dt grad v and the volume ratio, over blocks.
template <int D, class T>
void run_volume_gather(KernelType kernel, Executor& executor, const PassData<D, T>& data, int ratio,
                       const std::vector<std::int32_t>& blocks);

}  // namespace scree
