// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "app/run_record.hpp"

namespace scree {

/// The lines at a run's end: what was done, how fast, where the files are, and which papers to
/// cite.
std::string run_summary(const RunRecord& record, const std::filesystem::path& folder,
                        const std::string& files);

}  // namespace scree
