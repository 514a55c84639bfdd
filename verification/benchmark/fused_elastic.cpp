// SPDX-License-Identifier: Apache-2.0
#include "materials/fixed_corotated.hpp"
#include "verification/benchmark/fused_block.hpp"

namespace scree::benchmarks {

void add_elastic_blocks() {
  add_fused_blocks<FixedCorotated, 2>();
  add_fused_blocks<FixedCorotated, 3>();
}

}  // namespace scree::benchmarks
