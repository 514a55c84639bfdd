// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>

namespace scree {

/// Memory that a run will take of a device, at least: what its start needs.
struct MemoryNeed {
  std::int64_t particles = 0;
  std::int64_t bytes = 0;
  std::int64_t free = 0;  ///< [bytes]
};
using MemoryNeedReport = std::function<void(const MemoryNeed&)>;

}  // namespace scree
