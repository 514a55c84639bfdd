// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "solver/device/memory_need.hpp"

namespace scree {

class DeviceToolkit;

/// A GPU of this machine.
struct Gpu {
  std::string name;
  int major = 0;  ///< compute capability
  int minor = 0;
  std::int64_t memory = 0;  ///< [bytes]
  int processors = 0;       ///< multiprocessors
};

/// The GPUs that this build can use, or why there is none, as the end of a sentence "no GPU: ...".
struct GpuList {
  std::vector<Gpu> gpus;
  std::string problem;
  bool compiled = false;  ///< this build has CUDA
  std::string build;      ///< with what, "CUDA 13.0 for 8.0, 9.0"; empty without
};

/// Never throws: a machine without GPU or driver is an answer.
GpuList find_gpus();

/// The kernels for GPUs. Throws UserError in a build without CUDA. on_need: as for DeviceToolkit.
std::shared_ptr<const DeviceToolkit> gpu_toolkit(MemoryNeedReport on_need);

}  // namespace scree
