// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "solver/io/file_descriptor.hpp"

namespace scree {

/// A table over time in a file: a header line, then rows that begin with the number of the step.
/// Rows are handed to the system in one piece as soon as they are added, so a killed program leaves
/// whole ones.
class CsvWriter {
 public:
  /// Starts a new file with the header line (without its end). Throws RunFault.
  static CsvWriter create(const std::filesystem::path& path, const std::string& header);

  /// Goes on with an existing file after cutting off every row with a step beyond `last_step` and
  /// anything after the last complete row. An empty `header` takes that of the file. Throws
  /// RunFault if the file is missing or has another header.
  static CsvWriter resume(const std::filesystem::path& path, const std::string& header,
                          std::int64_t last_step);

  /// Adds lines, each with its end. On failure (disk full) cuts what went in half off again and
  /// throws RunFault.
  void add(const std::string& lines);

  /// Puts the rows on the disk (fsync). Throws RunFault.
  void sync();

 private:
  CsvWriter(std::filesystem::path path, FileDescriptor file);

  std::filesystem::path path_;
  FileDescriptor file_;
};

}  // namespace scree
