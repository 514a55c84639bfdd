// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace scree {

/// The whole program: reads the command line, runs the command, returns the exit status: 0 done, 1
/// failed, 2 the input is wrong, 130 and 143 ended by a signal. Mistakes go to stderr.
int scree_main(int argc, const char* const* argv);

}  // namespace scree
