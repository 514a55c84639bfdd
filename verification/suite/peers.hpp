// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "verification/suite/judge.hpp"

namespace scree::verify {

/// One number of another code beside that of a run.
struct PeerRow {
  std::string case_name;
  const PeerResult* peer = nullptr;  ///< of the case's expect.toml
  std::string run;                   ///< label of the run
  double theirs = 0, measured = 0;
};

/// All numbers of other codes for which a run came to its end, in the order of cases and tables.
/// The rows point into `results`.
std::vector<PeerRow> peer_rows(const std::vector<CaseResult>& results);

/// "10.8 times smaller", "3.1 times larger", "equal": the measured size beside the other code's.
std::string peer_ratio(const PeerRow& row);

/// The rows as a table for the terminal, headed by a line; empty without rows.
std::string peers_text(const std::vector<CaseResult>& results);

/// The same as a part of report.html; empty without rows.
std::string peers_html(const std::vector<CaseResult>& results);

}  // namespace scree::verify
