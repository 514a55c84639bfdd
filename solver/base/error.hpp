// SPDX-License-Identifier: Apache-2.0
/// \file
/// The two kinds of failure that reach the user as a sentence. (Bugs are assertions, not
/// exceptions.)
#pragma once

#include <stdexcept>

namespace scree {

/// The user's input is wrong: deck, command line, files. The program ends with status 2.
struct UserError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A correct input led to a run that cannot go on (inverted particle, step too large, disk full).
/// One sentence that names step, particle, value and repair. The program ends with status 1.
struct RunFault : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace scree
