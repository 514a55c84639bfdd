// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace scree {

/// How a program ended and what it said.
struct ProcessResult {
  int status = -1;  ///< exit status; 128 + signal if a signal ended it
  std::string out, err;
};

/// Runs a program to its end. `in_child` is called before the program starts (limits),
/// `while_running` in the parent with the process id (signals).
ProcessResult run_process(
    const std::vector<std::string>& command, const std::function<void()>& in_child = [] {},
    const std::function<void(pid_t)>& while_running = [](pid_t) {});

/// Waits, at most a minute, until the condition holds; false if it never did.
bool wait_for(const std::function<bool()>& condition);

}  // namespace scree
