// SPDX-License-Identifier: Apache-2.0
#include "app/run_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <regex>
#include <vector>

#include "solver/base/error.hpp"

namespace scree {

namespace fs = std::filesystem;

namespace {

/// The files that every run leaves in its folder; ".tmp" where it was killed.
const std::regex own_file(R"((resolved\.toml|run\.json|history\.csv|checkpoint\.h5)(\.tmp)?)");

bool holds_run(const fs::path& path) {
  return fs::exists(path / "run.json") || fs::exists(path / "checkpoint.h5");
}

/// True if there is nothing, or only what a run killed in its first moment leaves.
bool holds_nothing(const fs::path& path) {
  for (const auto& entry : fs::directory_iterator(path)) {
    const std::string name = entry.path().filename().string();
    const bool first = name == "run.json.tmp" || (name == "frames" && fs::is_empty(entry.path()));
    if (!first) return false;
  }
  return true;
}

[[noreturn]] void refuse_existing(const fs::path& path) {
  throw UserError(
      fmt::format("{} holds a run already; continue it with --resume, replace it with --overwrite, "
                  "or choose another folder with -o",
                  path.string()));
}

[[noreturn]] void refuse_foreign(const fs::path& path) {
  throw UserError(
      fmt::format("{} holds other files and no run (no run.json); choose another folder with -o",
                  path.string()));
}

[[noreturn]] void refuse_unusable(const fs::path& path, const std::error_code& error) {
  throw UserError(fmt::format("cannot make the run folder {}: {}; choose another folder with -o",
                              path.string(), error.message()));
}

void remove_matching(const fs::path& folder, const std::regex& names) {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (std::regex_match(entry.path().filename().string(), names)) found.push_back(entry.path());
  }
  for (const fs::path& file : found) fs::remove(file);
}

/// The names of the tables [`kind`.NAME] of the former run's deck.
std::vector<std::string> former_names(const fs::path& path, const std::string& kind) {
  std::vector<std::string> names;
  std::ifstream deck(path / "resolved.toml");
  for (std::string line; std::getline(deck, line);) {
    const std::string begin = "[" + kind + ".";
    if (!line.starts_with(begin) || !line.ends_with("]")) continue;
    names.push_back(line.substr(begin.size(), line.size() - begin.size() - 1));
  }
  return names;
}

/// The tables of samples of the former run, and their folder if nothing else is in it.
void remove_tables(const fs::path& path, const std::string& kind, const std::string& folder) {
  for (const std::string& name : former_names(path, kind)) {
    fs::remove(path / folder / (name + ".csv"));
  }
  if (fs::is_directory(path / folder) && fs::is_empty(path / folder)) fs::remove(path / folder);
}

void remove_run(const fs::path& path) {
  const fs::path frames = path / "frames";
  std::vector<std::string> series{"particles", "grid"};
  for (const std::string& name : former_names(path, "frames")) {
    series.insert(series.end(), {name, name + "_grid"});
  }
  for (const std::string& name : series) {
    if (fs::is_directory(frames)) {
      remove_matching(frames, std::regex(name + R"((_minus|_plus)?_[0-9]{6,}\.vt[ui](\.tmp)?)"));
    }
    remove_matching(path, std::regex(name + R"(\.(pvd|xdmf|h5)(\.tmp)?)"));
  }
  remove_tables(path, "probe", "probes");
  remove_tables(path, "profile", "profiles");
  remove_tables(path, "section", "sections");
  remove_matching(path, own_file);
}

/// Holds off a second run in the same folder; file systems without locks do without.
FileDescriptor lock(const fs::path& path) {
  FileDescriptor folder(::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (folder.is_open() && ::flock(folder.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    throw UserError(fmt::format("{} is in use by another scree run", path.string()));
  }
  return folder;
}

void check_writable(const fs::path& path) {
  if (::access(path.c_str(), W_OK | X_OK) != 0) {
    throw UserError(fmt::format("cannot write into {}: {}; choose another folder with -o",
                                path.string(),
                                std::error_code(errno, std::generic_category()).message()));
  }
}

}  // namespace

RunFolder::RunFolder(fs::path path, FileDescriptor lock)
    : path_(std::move(path)), lock_(std::move(lock)) {}

void RunFolder::check(const fs::path& path, FolderMode mode) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  const bool exists = fs::exists(status);
  if (!exists && error && error != std::errc::no_such_file_or_directory) {
    refuse_unusable(path, error);
  }
  if (exists && !fs::is_directory(status)) {
    throw UserError(fmt::format("{} is not a folder; choose another with -o", path.string()));
  }
  if (mode == FolderMode::resume && !(exists && fs::exists(path / "checkpoint.h5"))) {
    throw UserError(fmt::format(
        "{} holds no checkpoint.h5 to resume from; start {} (a deck asks for checkpoints with "
        "[checkpoint] every = ...)",
        path.string(), holds_run(path) ? "anew with --overwrite" : "without --resume"));
  }
  if (!exists) return;
  check_writable(path);
  if (mode == FolderMode::fresh && holds_run(path)) refuse_existing(path);
  if (!holds_run(path) && !holds_nothing(path)) refuse_foreign(path);
}

RunFolder RunFolder::open(const fs::path& path, FolderMode mode) {
  check(path, mode);
  std::error_code error;
  fs::create_directories(path, error);
  if (error == std::errc::no_space_on_device) {
    throw RunFault(fmt::format("cannot make {}: {}", path.string(), error.message()));
  }
  if (error) refuse_unusable(path, error);
  RunFolder folder(path, lock(path));
  if (mode == FolderMode::overwrite) remove_run(path);
  fs::create_directory(path / "frames", error);
  if (error)
    throw RunFault(fmt::format("cannot make {}/frames: {}", path.string(), error.message()));
  return folder;
}

fs::path default_run_folder(const fs::path& deck) { return fs::path("runs") / deck.stem(); }

}  // namespace scree
