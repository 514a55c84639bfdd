// SPDX-License-Identifier: Apache-2.0
#include "app/recorder.hpp"

#include <fmt/format.h>

#include <chrono>
#include <utility>

#include "app/deck_changes.hpp"
#include "solver/base/error.hpp"
#include "solver/io/checkpoint.hpp"

namespace scree {

namespace {

/// Adds the wall time of a scope to a sum.
class Stopwatch {
 public:
  explicit Stopwatch(double& sum) : sum_(sum), start_(std::chrono::steady_clock::now()) {}
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;
  ~Stopwatch() {
    sum_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  double& sum_;
  std::chrono::steady_clock::time_point start_;
};

/// True for the first time at which an event is due.
bool is_new(std::optional<double>& last, bool due, double event) {
  if (!due || last == event) return false;
  last = event;
  return true;
}

}  // namespace

Recorder::Recorder(const RunFolder& folder, OutputSpec output, bool checkpoints, Schedule schedule,
                   RunIdentity identity)
    : folder_(folder.path()),
      history_path_(folder.history()),
      checkpoint_path_(folder.checkpoint()),
      output_(std::move(output)),
      checkpoints_(checkpoints),
      schedule_(schedule),
      identity_(std::move(identity)),
      particles_(folder.path(), "particles", output_.precision),
      grid_(folder.path(), "grid", output_.precision) {}

void Recorder::start(const Simulation& simulation, const std::vector<std::string>& collider_names) {
  history_ = HistoryWriter::create(history_path_, collider_names, simulation.coupled());
  record(simulation);
}

void Recorder::resume(const Simulation& simulation, const StateReader& checkpoint,
                      const std::vector<std::string>& collider_names) {
  const double time = simulation.time();
  taken_step_ = simulation.step_count();
  saved_time_ = time;
  // What is due here was taken before the checkpoint.
  take_events(time);
  particles_.resume(checkpoint.get<double>("run/particle_frame_times"));
  grid_.resume(checkpoint.get<double>("run/grid_frame_times"));
  history_ = HistoryWriter::resume(history_path_, collider_names, simulation.step_count(),
                                   simulation.coupled());
  history_time_ = time;
}

Recorder::Events Recorder::take_events(double time) {
  const bool frames = schedule_.frame_due(time) && output_.format != FrameFormat::none;
  return {
      is_new(row_event_, schedule_.history_due(time), schedule_.history_event(time)),
      is_new(frame_event_, frames, schedule_.frame_event(time)),
      is_new(checkpoint_event_, schedule_.checkpoint_due(time), schedule_.checkpoint_event(time))};
}

void Recorder::record(const Simulation& simulation) {
  queue_.check();
  const Events due = take_events(simulation.time());
  if (!due.row && !due.frame && !due.checkpoint) return;
  const Stopwatch watch(seconds_);
  if (due.row) take_row(simulation);
  if (due.frame) take_frames(simulation);
  if (due.checkpoint) take_checkpoint(simulation);
}

void Recorder::take_row(const Simulation& simulation) {
  queue_.add(JobSize::small, [this, row = simulation.history()] {
    history_->add(row);
    history_time_ = row.time;
  });
}

void Recorder::take_frames(const Simulation& simulation) {
  queue_.wait_for_room(JobSize::large);
  std::vector<GridSnapshot> lattices;
  if (output_.grid) lattices = simulation.grid();
  queue_.add(JobSize::large, [this, particles = simulation.particles(output_.fields),
                              lattices = std::move(lattices)] {
    particles_.add(particles);
    grid_.add(lattices);  // nothing where there is none
  });
}

void Recorder::save(const Simulation& simulation) {
  if (taken_step_ == simulation.step_count()) return;
  const Stopwatch watch(seconds_);
  take_checkpoint(simulation);
}

void Recorder::take_checkpoint(const Simulation& simulation) {
  queue_.wait_for_room(JobSize::large);
  StateBuffer state;
  simulation.save(state);
  queue_.add(JobSize::large, [this, state = std::move(state), time = simulation.time()] {
    write_checkpoint(state, time);
  });
  taken_step_ = simulation.step_count();
}

void Recorder::write_checkpoint(const StateBuffer& state, double time) {
  // Rows before the checkpoint are on the disk before it is: a continued run needs them.
  history_->sync();
  CheckpointWriter out(checkpoint_path_);
  out.put_text("run/deck", identity_.deck);
  out.put_text("run/backend", identity_.backend);
  out.put_text("run/version", identity_.version);
  out.put("run/particle_frame_times", particles_.times());
  out.put("run/grid_frame_times", grid_.times());
  state.replay(out);
  out.commit();
  saved_time_ = time;
}

void Recorder::flush() {
  const Stopwatch watch(seconds_);
  queue_.drain();
  queue_.check();
}

std::string Recorder::kept() {
  queue_.drain();
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (!particles_.times().empty()) {
    add(fmt::format("{} (t = {:.6g} s)", particles_.last_file(), particles_.times().back()));
  }
  if (history_time_) add(fmt::format("history.csv (to t = {:.6g} s)", *history_time_));
  if (saved_time_) add(fmt::format("checkpoint.h5 (t = {:.6g} s)", *saved_time_));
  return text.empty() ? "nothing" : text;
}

void check_identity(const StateReader& checkpoint, const RunIdentity& identity) {
  const std::string backend = checkpoint.text("run/backend");
  if (backend != identity.backend) {
    throw UserError(fmt::format("the run was made with --backend {} and cannot continue with {}",
                                backend, identity.backend));
  }
  const std::string version = checkpoint.text("run/version");
  if (version != identity.version) {
    throw UserError(
        fmt::format("the checkpoint is from scree {} and this is scree {}; only the same "
                    "version continues a run bit for bit",
                    version, identity.version));
  }
  const std::vector<std::string> changes =
      forbidden_changes(checkpoint.text("run/deck"), identity.deck);
  if (changes.empty()) return;
  throw UserError(
      fmt::format("the deck is not the one the checkpoint was made with: {}; restore it, or start "
                  "anew with --overwrite",
                  fmt::join(changes, ", ")));
}

}  // namespace scree
