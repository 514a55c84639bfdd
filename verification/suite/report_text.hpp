// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "verification/suite/case_code.hpp"
#include "verification/suite/judge.hpp"

namespace scree::verify {

/// "0.00123", "1.5e-12", "inf": four significant digits.
std::string number_text(double value);

/// The measured number of a check that decides: the worst of its runs, or the order's finest error.
std::string measured_text(const CheckResult& check);
/// The observed order, or "".
std::string order_text(const CheckResult& check);

/// The table of all checks: case, quantity, norm, expected, measured, order, verdict; a blank line
/// between cases, and what failed in words below it.
std::string table_text(const std::vector<CaseResult>& results);

/// One line a case: name, physics, reference.
std::string list_text(const std::vector<CaseCode>& cases);

}  // namespace scree::verify
