// SPDX-License-Identifier: Apache-2.0
/// \file
/// How the CUDA threads of a pass add up what particles give to nodes.
#pragma once

#include <cmath>

#include "solver/exec/cuda_leaves.cuh"
#include "solver/exec/fixed_channels.hpp"
#include "solver/step/pass_data.hpp"

namespace scree {
inline namespace SCREE_SIDE {

/// In floating point: what a sum is rounded to hangs on the order, which is left to chance.
template <int D, class T>
class PlainSums {
 public:
  using Value = T;

  SCREE_FN Value* channel(const PassData<D, T>& data, int channel) const {
    return data.write[channel];
  }
  SCREE_FN void add_momentum(Value* sum, T x) const { device::add(sum, x); }
  SCREE_FN void add_mass(Value* sum, T x) const { device::add(sum, x); }
};

/// In fixed point: integers, whose sums are the same in any order. A contribution that has none is
/// left out and noted.
template <int D, class T>
class FixedSums {
 public:
  using Value = FixedChannels::Value;

  explicit SCREE_FN FixedSums(const FixedChannels& channels) : channels_(channels) {}

  SCREE_FN Value* channel(const PassData<D, T>&, int channel) const {
    return channels_.sum[channel];
  }
  SCREE_FN void add_momentum(Value* sum, T x) const {
    add(sum, double(x) * channels_.per_momentum);
  }
  SCREE_FN void add_mass(Value* sum, T x) const { add(sum, double(x) * channels_.per_mass); }

 private:
  SCREE_FN void add(Value* sum, double units) const {
    if (!(std::abs(units) < FixedChannels::limit)) {
      device::raise_flag(channels_.overflow);
      return;
    }
    device::add(sum, Value(std::llrint(units)));
  }

  const FixedChannels& channels_;
};

}  // namespace SCREE_SIDE
}  // namespace scree
