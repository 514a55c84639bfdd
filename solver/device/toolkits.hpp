// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "solver/device/toolkit.hpp"

namespace scree {

// Inline, as in the units that define them; a program names the side it means.
inline namespace cuda {
/// GPUs by CUDA; defined in builds with SCREE_CUDA.
std::shared_ptr<const DeviceToolkit> make_toolkit(MemoryNeedReport on_need = {});
}  // namespace cuda
inline namespace emulated {
/// CUDA kernels on this processor; defined in the tests' library scree_emulation.
std::shared_ptr<const DeviceToolkit> make_toolkit(MemoryNeedReport on_need = {});
}  // namespace emulated

}  // namespace scree
