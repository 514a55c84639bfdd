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
/// Returns 0; 1 when the first steps fail; 2 when the deck is wrong.
int check_command(const CheckOptions& options);

}  // namespace scree
