// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "solver/exec/executor.hpp"
#include "solver/simulation/method.hpp"
#include "solver/step/volume_fields.hpp"

namespace scree {

/// Channels of sums that the passes use. A record holds three numerators and their weight in 3D,
/// two of them in 2D, where the third goes to channel 1.
template <int D>
inline constexpr int volume_channels = D == 2 ? 2 : 1;

/// Volumes and their changes to nodes over the blocks of one colour.
template <int D, class T>
void run_volume_scatter(KernelType kernel, Executor& executor, const PassData<D, T>& data,
                        const VolumeFields& fields, const std::vector<std::int32_t>& blocks);

/// Mean changes from nodes to the stored dt grad v and the volume ratio, over blocks.
template <int D, class T>
void run_volume_gather(KernelType kernel, Executor& executor, const PassData<D, T>& data,
                       const VolumeFields& fields, const std::vector<std::int32_t>& blocks);

}  // namespace scree
