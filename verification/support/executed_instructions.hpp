// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>

namespace scree::testing {

/// What the calling thread executes while it runs f: instructions in the program and its libraries,
/// and those of them that fetch memory ahead.
struct Executed {
  std::int64_t instructions = 0;
  std::int64_t prefetches = 0;
};

/// Whether this machine and system let a program step through itself (x86-64 with Linux).
bool can_count_instructions();

/// Counts by the processor's trap flag, one signal an instruction (some microseconds each): exact,
/// and the same on a busy machine. A constant few are those of this function.
Executed executed_instructions(const std::function<void()>& f);

}  // namespace scree::testing
