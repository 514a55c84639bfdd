// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "verification/suite/judge.hpp"

namespace scree::verify {

/// What a report says about where its numbers come from.
struct ReportHead {
  std::string version, commit, compiler, instruction_set, cpu;
  std::string variant;  ///< ci or full
  std::string date;     ///< of the end, ISO 8601, UTC
  int threads = 1;
  double seconds = 0;           ///< wall time of everything
  std::string backend = "cpu";  ///< as backend_text() says it
};

/// results.json: all runs, quantities, checks and verdicts.
std::string report_json(const ReportHead& head, const std::vector<CaseResult>& results);

}  // namespace scree::verify
