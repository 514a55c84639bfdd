// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "verification/suite/case_code.hpp"
#include "verification/suite/judge.hpp"

namespace scree::verify {

/// A case that was read and planned for one variant.
struct PlannedCase {
  const CaseCode* code = nullptr;
  Value document;  ///< case.toml
  CaseText text;
  Sweep sweep;
};

/// Reads a case's files and plans its runs. Throws std::logic_error with all mistakes: cases are
/// part of the program.
PlannedCase plan_case(const CaseCode& code, bool full);

/// The name of a material law that the case needs and this build lacks (SCREE_MATERIALS), or "".
std::string missing_law(const PlannedCase& planned);

/// What in a run of the case only the processor computes, or "".
std::string processor_only(const PlannedCase& planned);

/// Called when a case is finished, from one thread at a time; `done` and `all` count runs.
using CaseDone = std::function<void(const CaseResult& result, int done, int all)>;

/// Runs the cases, `threads` runs at a time, each in one thread; long ones first. The results do
/// not depend on the number of threads. device: where they run, null: on the processor. Throws
/// RunFault when a signal stops it.
std::vector<CaseResult> run_cases(const std::vector<PlannedCase>& cases, int threads,
                                  const std::shared_ptr<const DeviceToolkit>& device,
                                  const std::function<bool()>& stop, const CaseDone& done);

/// A document as TOML, one line a key.
std::string document_toml(const Value& document);

}  // namespace scree::verify
