// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/bench_suite.hpp"

namespace scree {

/// The suite's result as one JSON object; times in ns or s, memory in bytes, rates per second.
std::string suite_json(const SuitePlan& plan, const SuiteResult& result);

}  // namespace scree
