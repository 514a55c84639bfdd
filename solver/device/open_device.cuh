// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "solver/device/device.hpp"
#include "solver/exec/cuda_dialect.cuh"

namespace scree {
inline namespace SCREE_SIDE {

/// The device of this side.
std::unique_ptr<Device> open_device();

}  // namespace SCREE_SIDE
}  // namespace scree
