// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/output_queue.hpp"
#include "app/run_folder.hpp"
#include "app/sampler.hpp"
#include "solver/io/csv_writer.hpp"
#include "solver/io/frame_series.hpp"
#include "solver/io/history_writer.hpp"
#include "solver/io/output_spec.hpp"
#include "solver/io/state_buffer.hpp"
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
///
/// The caller only copies the state; a thread of the recorder writes the copies, in order. A write
/// that fails is thrown by the next call, and nothing is written after it.
class Recorder {
 public:
  Recorder(const RunFolder& folder, OutputSpec output, bool checkpoints, Schedule schedule,
           RunIdentity identity, ParticleFilter filter = {});

  /// Before start() or resume(): a further series of frames, or a table of samples, at the times of
  /// a stream of the schedule.
  void add_frames(OutputSpec spec, int stream, ParticleFilter filter);
  void add_samples(std::unique_ptr<Sampler> sampler, int stream);

  /// A new run: the header of the history, and what is due at the simulation's time. drain_names:
  /// of the drained surfaces. Throws RunFault.
  void start(const Simulation& simulation, const std::vector<std::string>& collider_names,
             const std::vector<std::string>& drain_names = {});

  /// A continued run: cuts history and frames back to the checkpoint from which `simulation` was
  /// loaded. Throws RunFault.
  void resume(const Simulation& simulation, const StateReader& checkpoint,
              const std::vector<std::string>& collider_names,
              const std::vector<std::string>& drain_names = {});

  /// Takes whatever is due at the simulation's time and was not taken for the same event. Throws
  /// RunFault, also for an earlier write.
  void record(const Simulation& simulation);

  /// Takes a checkpoint, unless the last one is of this very step. Throws as record().
  void save(const Simulation& simulation);

  /// Returns when all that was taken is written. Throws RunFault if a write failed.
  void flush();

  bool keeps_checkpoints() const { return checkpoints_; }
  /// Wall time that the caller spent here: on copies, and waiting for files.
  double seconds() const { return seconds_; }

  /// What can be read in the folder after all that was taken is written, as the end of a sentence:
  /// "frame ... (t = 0.1 s), ...". Throws nothing where a write failed.
  std::string kept();

 private:
  /// A series of frames of particles, and of the grid where `grid` is there.
  struct Frames {
    OutputSpec spec;
    int stream;
    ParticleFilter filter;
    std::unique_ptr<FrameSeries> particles, grid;
  };
  struct Samples {
    std::unique_ptr<Sampler> sampler;
    int stream;
    std::optional<CsvWriter> table;
  };

  /// True if an event of the stream is due at this time and was not taken before; it counts as
  /// taken from now on.
  bool take(int stream, double time);
  void take_row(const Simulation& simulation);
  void take_frames(const Simulation& simulation, Frames& frames);
  void take_samples(const Simulation& simulation, Samples& samples);
  void take_checkpoint(const Simulation& simulation);
  void write_checkpoint(const StateBuffer& state, double time);

  std::filesystem::path folder_, history_path_, checkpoint_path_;
  bool checkpoints_;
  Schedule schedule_;
  RunIdentity identity_;
  std::int64_t taken_step_ = -1;  ///< of the last checkpoint taken
  std::map<int, double> events_;  ///< s, the last one taken of each stream
  double seconds_ = 0;

  // From start() or resume() on only jobs use these; others may after the queue was drained.
  std::vector<std::unique_ptr<Frames>> frames_;
  std::vector<std::unique_ptr<Samples>> samples_;
  std::optional<HistoryWriter> history_;
  std::optional<double> history_time_, saved_time_;  ///< s, of the last row and checkpoint

  OutputQueue queue_;  ///< last: its jobs use what is above
};

/// Adds what a deck records besides its history and [output]; the streams are those that
/// build_schedule() gave the schedule.
void add_records(const Deck& deck, Recorder& recorder);

/// Checks that a checkpoint belongs to this deck, backend and version. Throws UserError naming
/// every key that changed.
void check_identity(const StateReader& checkpoint, const RunIdentity& identity);

}  // namespace scree
