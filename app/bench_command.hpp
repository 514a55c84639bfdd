// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/bench_options.hpp"

namespace scree {

/// `scree bench`: builds a case in memory, steps it without output and prints what a step costs.
/// Returns 0, or 2 for options that make no case.
int bench_command(const BenchOptions& options);

}  // namespace scree
