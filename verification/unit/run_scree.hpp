// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <vector>

#include "app/cli.hpp"

namespace scree {

/// Runs a command line of scree in this process; `out` takes its standard output. Returns its exit
/// status.
inline int run_scree(std::vector<const char*> words, std::string& out) {
  words.insert(words.begin(), "scree");
  testing::internal::CaptureStdout();
  const int status = scree_main(static_cast<int>(words.size()), words.data());
  std::fflush(stdout);
  out = testing::internal::GetCapturedStdout();
  return status;
}

}  // namespace scree
