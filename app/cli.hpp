// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/verify_options.hpp"

namespace scree {

/// The whole program: reads the command line, runs the command, returns the exit status: 0 done, 1
/// failed, 2 the input is wrong, 130 and 143 ended by a signal. Mistakes go to stderr. Without
/// `verify` there are no verification cases.
int scree_main(int argc, const char* const* argv, const VerifyCommand& verify = {});

}  // namespace scree
