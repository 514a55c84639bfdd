// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "solver/io/file_descriptor.hpp"

namespace scree {

/// What to do where a run folder is there already.
enum class FolderMode { fresh, overwrite, resume };

/// The folder of one run and the names of its files. While it is open, no second run can open it.
class RunFolder {
 public:
  /// Checks, without writing, that open() can be expected to work. Throws UserError: the folder
  /// holds a run (fresh), holds other things, is no folder, or holds no checkpoint (resume).
  static void check(const std::filesystem::path& path, FolderMode mode);

  /// Makes the folder. `overwrite` removes the files of the former run, and nothing else. Throws
  /// UserError where the path cannot be used, RunFault where the disk fails.
  static RunFolder open(const std::filesystem::path& path, FolderMode mode);

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path resolved_deck() const { return path_ / "resolved.toml"; }
  std::filesystem::path record() const { return path_ / "run.json"; }
  std::filesystem::path history() const { return path_ / "history.csv"; }
  std::filesystem::path checkpoint() const { return path_ / "checkpoint.h5"; }

 private:
  RunFolder(std::filesystem::path path, FileDescriptor lock);

  std::filesystem::path path_;
  FileDescriptor lock_;
};

/// runs/<name of the deck file without its extension>
std::filesystem::path default_run_folder(const std::filesystem::path& deck);

}  // namespace scree
