// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace scree {

/// The command line of `scree element`.
struct ElementOptions {
  std::string deck;                    ///< path
  std::string output;                  ///< table; empty: <deck name>.csv in the current folder
  std::string plot;                    ///< PNG; empty: none
  std::vector<std::string> overrides;  ///< KEY=VALUE of --set
  bool overwrite = false;              ///< also replace files that are not the driver's
  bool quiet = false;
};

/// `scree element`: drives a material point and writes its table; returns the exit status.
int element_command(const ElementOptions& options);

}  // namespace scree
