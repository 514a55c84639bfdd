// SPDX-License-Identifier: Apache-2.0
#include "app/backend_choice.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "solver/base/error.hpp"
#include "solver/device/gpus.hpp"

namespace scree {

BackendChoice choose_backend(const std::string& asked, const MemoryNeedReport& on_need,
                             const std::string& processor_only) {
  BackendChoice choice;
  if (asked == "cpu") return choice;
  if (asked == "cuda" && !processor_only.empty()) {
    throw UserError(fmt::format(
        "--backend cuda: {} is computed by the processor; use --backend cpu", processor_only));
  }
  const GpuList found = find_gpus();
  if (!found.gpus.empty() && !processor_only.empty()) {
    choice.note = processor_only + " is computed by the processor";
    return choice;
  }
  if (!found.gpus.empty()) {
    choice.name = "cuda";
    choice.note = found.gpus[0].name;
    choice.device = gpu_toolkit(on_need);
    return choice;
  }
  if (asked == "cuda") {
    throw UserError(fmt::format("--backend cuda: no GPU: {}; use --backend cpu", found.problem));
  }
  if (found.compiled) choice.note = "no GPU: " + found.problem;
  return choice;
}

std::string backend_text(const BackendChoice& choice) {
  return choice.note.empty() ? choice.name : fmt::format("{} ({})", choice.name, choice.note);
}

std::string memory_need_text(const MemoryNeed& need) {
  return fmt::format("GPU memory: {} bytes a particle, at least {:.2f} of {:.2f} GB free",
                     need.bytes / std::max<std::int64_t>(need.particles, 1),
                     double(need.bytes) * 1e-9, double(need.free) * 1e-9);
}

}  // namespace scree
