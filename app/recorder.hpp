// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/run_folder.hpp"
#include "solver/io/frame_series.hpp"
#include "solver/io/history_writer.hpp"
#include "solver/io/output_spec.hpp"
#include "solver/simulation/schedule.hpp"
#include "solver/simulation/simulation.hpp"

namespace scree {

/// What a checkpoint says about the run besides the simulation's state.
struct RunIdentity {
  std::string deck;     ///< the resolved deck
  std::string backend;  ///< cpu, cuda
  std::string version;  ///< of scree
};

/// Writes the files of a run while it goes: rows, frames and checkpoints when they are due.
class Recorder {
 public:
  Recorder(const RunFolder& folder, OutputSpec output, bool checkpoints, Schedule schedule,
           RunIdentity identity);

  /// A new run: the header of the history, and what is due at the simulation's time. Throws
  /// RunFault.
  void start(const Simulation& simulation, const std::vector<std::string>& collider_names);

  /// A continued run: cuts history and frames back to the checkpoint from which `simulation` was
  /// loaded. Throws RunFault.
  void resume(const Simulation& simulation, const StateReader& checkpoint,
              const std::vector<std::string>& collider_names);

  /// Writes whatever is due at the simulation's time. Throws RunFault.
  void record(const Simulation& simulation);

  /// Writes a checkpoint, unless the last one is of this very step. Throws RunFault.
  void save(const Simulation& simulation);

  bool keeps_checkpoints() const { return checkpoints_; }
  double seconds() const { return seconds_; }  ///< wall time spent here

  /// What can be read in the folder now, as the end of a sentence: "frame ... (t = 0.1 s), ...".
  std::string kept() const;

 private:
  void write_due(const Simulation& simulation);
  void write_frames(const Simulation& simulation);
  void write_checkpoint(const Simulation& simulation);

  std::filesystem::path folder_, history_path_, checkpoint_path_;
  OutputSpec output_;
  bool checkpoints_;
  Schedule schedule_;
  RunIdentity identity_;
  FrameSeries particles_, grid_;
  std::optional<HistoryWriter> history_;
  std::optional<double> history_time_, saved_time_;  ///< s, of the last row and checkpoint
  std::int64_t saved_step_ = -1;
  double seconds_ = 0;
};

/// Checks that a checkpoint belongs to this deck, backend and version. Throws UserError naming
/// every key that changed.
void check_identity(const StateReader& checkpoint, const RunIdentity& identity);

}  // namespace scree
