// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "solver/base/problems.hpp"
#include "verification/suite/expectation.hpp"
#include "verification/suite/measured.hpp"
#include "verification/suite/sweep.hpp"

namespace scree::verify {

/// What is kept of a run.
struct RunResult {
  RunPlan plan;
  Measured measured;  ///< empty if it failed
  std::string fault;  ///< empty: it reached its end
  std::string deck;   ///< as TOML, to run it again
  std::int64_t particles = 0, steps = 0;
  double seconds = 0;  ///< on one core
};

/// One measured number beside its limits.
struct Judged {
  std::string run;      ///< its label; empty for an order
  double swept = 0;     ///< value of the swept parameter
  double measured = 0;  ///< infinite for a baseline that blew up
  std::optional<double> exact;
  double limit = 0;  ///< that was applied; for bands the nearer one
  bool passed = false;
};

/// An expectation for one series.
struct CheckResult {
  Expectation expectation;
  std::string series;
  std::vector<Judged> runs;
  std::optional<double> order;  ///< observed between the two finest runs, if asserted
  bool passed = false;
  std::string remark;  ///< what kept it from being judged
};

struct CaseResult {
  std::string name;
  CaseText text;
  Sweep sweep;
  std::vector<RunResult> runs;
  Measured compared;  ///< of all runs together
  std::vector<CheckResult> checks;
  bool passed = false;
  double seconds = 0;  ///< sum over its runs
};

/// Reports series, swept values and names in expectations that the sweep does not have.
void check_names(const CaseText& text, const Sweep& sweep, const Value& document,
                 Problems& problems);

/// Whether two values of the swept parameter are one.
bool same_swept(double a, double b);

/// Fills `checks` and `passed` from the runs.
void judge(CaseResult& result);

/// Order of convergence between two errors at two sizes.
double observed_order(double coarse, double coarse_size, double fine, double fine_size);

}  // namespace scree::verify
