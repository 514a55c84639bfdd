// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "verification/suite/judge.hpp"

namespace scree::verify {

/// The folder of a report. A former report in it is replaced, for it can be made again; a folder
/// that holds anything else and no report is refused.
class ReportFolder {
 public:
  /// Makes the folder. Throws UserError where it cannot be used.
  explicit ReportFolder(std::filesystem::path path);

  const std::filesystem::path& path() const { return path_; }
  /// Writes report.html, results.json and decks/<case>/<run>.toml. Throws RunFault.
  void write(const std::string& html, const std::string& json,
             const std::vector<CaseResult>& results) const;

 private:
  std::filesystem::path path_;
};

}  // namespace scree::verify
