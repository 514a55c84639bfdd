// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace scree {

/// The command line of `scree run`.
struct RunOptions {
  std::string deck;                    ///< path
  std::string output;                  ///< run folder; empty: runs/<deck name>
  std::vector<std::string> overrides;  ///< KEY=VALUE of --set
  std::string backend = "auto";        ///< auto, cpu, cuda
  int threads = 0;                     ///< 0: all cores
  std::optional<double> until;         ///< s
  std::optional<std::int64_t> max_steps;
  bool resume = false;
  bool overwrite = false;
  bool quiet = false;
};

}  // namespace scree
