// SPDX-License-Identifier: Apache-2.0
#include "verification/suite/report_folder.hpp"

#include <unistd.h>

#include <cerrno>
#include <fstream>

#include "solver/base/error.hpp"
#include "solver/io/durable_file.hpp"

namespace scree::verify {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void refuse(const fs::path& path, const std::string& why) {
  throw UserError(path.string() + " " + why + "; choose another folder with -o");
}

bool holds_report(const fs::path& path) {
  std::ifstream file(path / "results.json");
  std::string beginning(256, '\0');
  file.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
  return beginning.find("scree verify") != std::string::npos;
}

void make(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw RunFault("cannot make " + path.string() + ": " + error.message());
}

}  // namespace

ReportFolder::ReportFolder(fs::path path) : path_(std::move(path)) {
  std::error_code error;
  const bool exists = fs::exists(path_, error);
  if (exists && !fs::is_directory(path_, error)) refuse(path_, "is not a folder");
  if (exists && !fs::is_empty(path_, error) && !holds_report(path_))
    refuse(path_, "holds other files and no report of scree verify");
  fs::create_directories(path_, error);
  if (error) refuse(path_, "cannot be made: " + error.message());
  if (::access(path_.c_str(), W_OK | X_OK) != 0) {
    refuse(path_,
           "cannot be written into: " + std::error_code(errno, std::generic_category()).message());
  }
}

void ReportFolder::write(const std::string& html, const std::string& json,
                         const std::vector<CaseResult>& results) const {
  std::error_code ignored;
  fs::remove_all(path_ / "decks", ignored);
  for (const CaseResult& result : results) {
    const fs::path decks = path_ / "decks" / result.name;
    make(decks);
    for (const RunResult& run : result.runs)
      replace_file(decks / (run.plan.slug + ".toml"), run.deck);
  }
  replace_file(path_ / "results.json", json);
  replace_file(path_ / "report.html", html);
}

}  // namespace scree::verify
