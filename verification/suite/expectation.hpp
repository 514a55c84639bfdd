// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "solver/base/problems.hpp"
#include "solver/base/value.hpp"

namespace scree::verify {

/// How a quantity is judged.
enum class CheckKind {
  at_most,          ///< each run, against `limits`
  at_least,         ///< each run
  between,          ///< each run, between limits[0] and limits[1]
  within,           ///< each run, |measured/exact - 1| <= limit
  within_absolute,  ///< each run, |measured - exact| <= limit
  order,            ///< of the series: log(e1/e2)/log(h1/h2) of its two finest runs in a band
  at_most_times,    ///< each run, against the run of the series `than` of the same swept value
  at_least_times
};

/// One `[[expect]]` of expect.toml.
struct Expectation {
  std::string quantity;
  std::string norm;                 ///< in words
  std::vector<std::string> series;  ///< names; empty: all
  std::vector<double> at;           ///< swept values; empty: all runs
  CheckKind kind = CheckKind::at_most;
  std::vector<double> limits;  ///< one for all runs, or one for each of `at`; for bands two
  std::string than;            ///< the other series of at_most_times, at_least_times
  bool compared = false;       ///< of the runs together, by `compare`
  std::string why;
};

/// One `[[peer]]` of expect.toml: what another code has for the same problem.
struct PeerResult {
  std::string code;                ///< its name
  std::string quantity, series;    ///< of this case
  std::vector<double> at, values;  ///< swept values, and the other code's quantity at each
  std::string source;              ///< where it is published, and with which method
};

/// expect.toml of a case.
struct CaseText {
  std::string title, physics, reference;
  std::vector<Expectation> expectations;
  std::vector<PeerResult> peers;
};

/// Reads expect.toml; mistakes go to `problems`.
CaseText read_case_text(const Value& document, Problems& problems);

/// "at most 0.005", "order 1.8 to 2.2"
std::string expected_text(const Expectation& expectation);

}  // namespace scree::verify
