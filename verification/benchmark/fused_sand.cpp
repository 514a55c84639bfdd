// SPDX-License-Identifier: Apache-2.0
#include "materials/drucker_prager.hpp"
#include "verification/benchmark/fused_block.hpp"

namespace scree::benchmarks {

void add_sand_blocks() {
  add_fused_blocks<DruckerPrager, 2>();
  add_fused_blocks<DruckerPrager, 3>();
}

}  // namespace scree::benchmarks
