// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "solver/device/memory_need.hpp"

namespace scree {

class DeviceToolkit;

/// Where a command computes.
struct BackendChoice {
  std::string name = "cpu";  ///< cpu, cuda
  /// The GPU's name; with cpu, why it is not a GPU where `auto` looked for one in vain, else empty.
  std::string note;
  std::shared_ptr<const DeviceToolkit> device;  ///< null: the processor
};

/// asked: auto, cpu, cuda. auto is the GPU of a build with CUDA on a machine where one works, else
/// the processor. Throws UserError where cuda is asked for and there is none.
/// processor_only: what only the processor computes in the run, "[coupling]"; empty: nothing. Then
/// auto is the processor, and cuda an error.
/// on_need: told what a run on the GPU will need, before that is allocated; may be empty.
BackendChoice choose_backend(const std::string& asked, const MemoryNeedReport& on_need = {},
                             const std::string& processor_only = {});

/// "cpu", "cuda (NVIDIA H100)", "cpu (no GPU: the driver sees none)".
std::string backend_text(const BackendChoice& choice);

/// "GPU memory: 312 bytes a particle, at least 0.31 of 84.9 GB free".
std::string memory_need_text(const MemoryNeed& need);

}  // namespace scree
