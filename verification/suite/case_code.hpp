// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "verification/suite/measured.hpp"
#include "verification/suite/run.hpp"

namespace scree::verify {

/// A case as it is compiled into the program, from its folder verification/cases/<name>/.
struct CaseCode {
  std::string name;
  std::string deck;    ///< case.toml
  std::string expect;  ///< expect.toml
  /// What the case measures in one run that came to its end.
  void (*measure)(const Run& run, Measured& out);
  /// What it measures in all runs of a variant together, in the order of the sweep; none failed.
  /// nullptr: nothing.
  void (*compare)(const std::vector<const Run*>& runs, Measured& out);
};

/// The code of a case whose exact.hpp has the struct C.
template <class C>
CaseCode code_of(const char* name, const char* deck, const char* expect) {
  CaseCode code{name, deck, expect, &C::measure, nullptr};
  if constexpr (requires { &C::compare; }) code.compare = &C::compare;
  return code;
}

/// All cases in the order of verification/cases/list.def.
const std::vector<CaseCode>& all_cases();

}  // namespace scree::verify
