// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace scree {

/// The command line of `scree verify`.
struct VerifyOptions {
  std::vector<std::string> cases;  ///< names; empty: all
  bool list = false;
  bool full = false;            ///< the fine variant instead of the one for every day
  std::string output;           ///< folder of the report; empty: runs/verify or runs/verify-full
  int threads = 0;              ///< 0: all cores, on a GPU 1
  std::string backend = "cpu";  ///< auto, cpu, cuda
};

/// What runs `scree verify`. The cases stand above the commands in the order of rooms, so the
/// program hands this to scree_main.
using VerifyCommand = std::function<int(const VerifyOptions& options)>;

}  // namespace scree
