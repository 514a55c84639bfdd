// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "solver/device/toolkit.hpp"

namespace scree {

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
};

/// Never throws: a machine without GPU or driver is an answer.
GpuList find_gpus();

/// The kernels for GPUs. Throws UserError in a build without CUDA.
std::shared_ptr<const DeviceToolkit> gpu_toolkit();

}  // namespace scree
