// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "verification/suite/report_json.hpp"

namespace scree::verify {

/// report.html: one file that needs no other, with all checks, their reasons and all figures.
std::string report_html(const ReportHead& head, const std::vector<CaseResult>& results);

}  // namespace scree::verify
