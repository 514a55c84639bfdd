// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace scree {

/// Does nothing, but brings into the program what tells the address sanitizer which leaks are those
/// of libraries. Called where such a library is started.
void overlook_foreign_leaks();

}  // namespace scree
