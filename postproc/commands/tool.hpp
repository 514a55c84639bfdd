// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace scree {

/// Runs a Python script of postproc/, found beside the program in its build tree or where it is
/// installed, with the distribution's Python; its messages go to standard error. Returns its exit
/// status. Throws RunFault where script or Python are missing.
int run_tool(const std::string& script, const std::vector<std::string>& words);

}  // namespace scree
