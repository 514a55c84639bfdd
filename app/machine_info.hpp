// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace scree {

/// What figures of speed depend on besides the program.
struct MachineInfo {
  std::string cpu;              ///< the processor's name as the system tells it, or "unknown"
  int threads = 1;              ///< that the machine can run at a time
  std::string instruction_set;  ///< the widest vector instructions of this build
  std::string compiler;
  std::int64_t cache_bytes = 0;  ///< of the last level; 0 where the system does not tell
};

MachineInfo machine_info();

/// Threads for an option --threads: `asked`, or for 0 as many as the machine can run at a time.
int thread_count(int asked);

/// The widest vector instructions that this build may use.
const char* instruction_set();

}  // namespace scree
