// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "solver/io/csv_writer.hpp"
#include "solver/io/snapshot.hpp"

namespace scree {

/// Names of the drained surfaces of pore water that flows, in the deck's order; nothing: no such
/// water.
using DrainNames = std::optional<std::vector<std::string>>;

/// What a run has beside its particles.
struct HistoryParts {
  std::vector<std::string> colliders;  ///< names: columns of force, torque and work each
  DrainNames drains = std::nullopt;    ///< balance of the water, outflow of each surface
  bool loads = false;                  ///< tractions or body forces: their work
};

/// The column names of history.csv, in order.
std::vector<std::string> history_columns(const HistoryParts& parts);

/// Writes history.csv. A row is handed to the system in one piece as soon as it is added, so a
/// killed program leaves whole rows. Numbers have the digits that give the same double back.
class HistoryWriter {
 public:
  /// Starts a new file with the header line. Throws RunFault.
  static HistoryWriter create(const std::filesystem::path& path, const HistoryParts& parts);

  /// Goes on with an existing file after cutting off every row with a step beyond `last_step` and
  /// anything after the last complete row. Throws RunFault if the file is missing or has other
  /// columns.
  static HistoryWriter resume(const std::filesystem::path& path, const HistoryParts& parts,
                              std::int64_t last_step);

  /// Adds a row. On failure (disk full) cuts a half-written row off again and throws RunFault.
  void add(const HistoryRow& row);

  /// Puts the rows on the disk (fsync). Throws RunFault.
  void sync();

 private:
  HistoryWriter(CsvWriter file, const HistoryParts& parts);

  CsvWriter file_;
  std::size_t collider_count_ = 0;
  std::optional<std::size_t> drain_count_;  ///< nothing: no pore water that flows
  bool loads_ = false;
};

}  // namespace scree
