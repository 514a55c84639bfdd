// SPDX-License-Identifier: Apache-2.0
// What a build without CUDA answers; that with CUDA is in cuda_device.cu.
#include "solver/device/gpus.hpp"

#include "solver/base/error.hpp"
#include "solver/device/toolkit.hpp"

#ifndef SCREE_CUDA
namespace scree {
namespace {

constexpr const char* reason = "this build has no CUDA; configure with -DSCREE_CUDA=ON";

}  // namespace

GpuList find_gpus() { return {{}, reason, false, {}}; }

// NOLINTNEXTLINE(performance-unnecessary-value-param): the build with CUDA keeps it
std::shared_ptr<const DeviceToolkit> gpu_toolkit(MemoryNeedReport) {
  throw UserError(std::string("no GPU: ") + reason);
}

}  // namespace scree
#endif
