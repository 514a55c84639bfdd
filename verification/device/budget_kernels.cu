// SPDX-License-Identifier: Apache-2.0
//
// The kernels that kernel_budgets holds to a budget: float, three dimensions, fused, compact.
#include "materials/drucker_prager.hpp"
#include "materials/fixed_corotated.hpp"
#include "solver/step/cuda_kernels.cuh"
#include "solver/transfer/compact.hpp"

#define SCREE_FUSED(Material)                                  \
  template __global__ void g2p2g<Compact, Material, 3, float>( \
      const __grid_constant__ PassData<3, float>,              \
      const __grid_constant__ Material::Params<float>);

namespace scree {
inline namespace cuda {
namespace kernels {

SCREE_FUSED(FixedCorotated)
SCREE_FUSED(DruckerPrager)

}  // namespace kernels
}  // namespace cuda
}  // namespace scree
