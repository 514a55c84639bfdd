// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/run_options.hpp"

namespace scree {

/// `scree run`: reads the deck, runs it, writes the run folder. Prints what the user needs to know;
/// returns the exit status: 0 done (or stopped at --until or --max-steps), 1 the run failed, 2 the
/// input is wrong, 130 or 143 stopped by a signal.
int run_command(const RunOptions& options);

}  // namespace scree
