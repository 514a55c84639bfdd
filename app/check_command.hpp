// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace scree {

/// The command line of `scree check`.
struct CheckOptions {
  std::string deck;
  std::vector<std::string> overrides;  ///< KEY=VALUE of --set
  int threads = 0;                     ///< 0: all cores
};

/// `scree check`: reads a deck, prints all its problems or what the run will need; writes nothing.
/// Returns 0 or 2.
int check_command(const CheckOptions& options);

}  // namespace scree
