// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <any>
#include <memory>

#include "solver/device/kernels.hpp"
#include "solver/exec/cuda_dialect.cuh"

namespace scree {
inline namespace SCREE_SIDE {

/// Makes the passes of the law Material; defined in the law's generated units.
template <class Material, int D, class T>
std::unique_ptr<DeviceLaw<D, T>> make_law(const std::any& input, double density);

}  // namespace SCREE_SIDE
}  // namespace scree
