// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "app/verify_options.hpp"
#include "verification/suite/case_code.hpp"

namespace scree::verify {

/// `scree verify`: runs cases, prints the table, writes report.html, results.json and the decks of
/// all runs. Returns 0 when all passed, 1 when one failed, 130 or 143 when a signal ended it.
/// Throws UserError for an unknown case or a folder that holds something else.
int verify_command(const VerifyOptions& options);

/// The same with these cases instead of those of the program.
int verify_cases(const VerifyOptions& options, const std::vector<CaseCode>& known);

}  // namespace scree::verify
