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

HistoryParts parts_of(const Simulation& simulation, const std::vector<std::string>& colliders,
                      const std::vector<std::string>& drains) {
  return {colliders, simulation.coupled() ? DrainNames(drains) : std::nullopt, simulation.loaded()};
}

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

/// Under which names a checkpoint keeps a series.
std::string series_key(const std::string& series) { return "run/" + series + "_frame_"; }

}  // namespace

Recorder::Recorder(const RunFolder& folder, OutputSpec output, bool checkpoints, Schedule schedule,
                   RunIdentity identity, ParticleFilter filter)
    : folder_(folder.path()),
      history_path_(folder.history()),
      checkpoint_path_(folder.checkpoint()),
      checkpoints_(checkpoints),
      schedule_(std::move(schedule)),
      identity_(std::move(identity)) {
  if (output.format == FrameFormat::none) return;
  add_frames(std::move(output), Schedule::frame_stream, std::move(filter));
}

void Recorder::add_frames(OutputSpec spec, int stream, ParticleFilter filter) {
  auto frames =
      std::make_unique<Frames>(Frames{std::move(spec), stream, std::move(filter), {}, {}});
  const OutputSpec& output = frames->spec;
  const std::size_t count = schedule_.count(stream);
  frames->particles = make_frame_series(folder_, output.name, output, count);
  if (output.grid) frames->grid = make_frame_series(folder_, output.grid_name(), output, count);
  frames_.push_back(std::move(frames));
}

void Recorder::add_samples(std::unique_ptr<Sampler> sampler, int stream) {
  samples_.push_back(std::make_unique<Samples>(Samples{std::move(sampler), stream, {}}));
}

void Recorder::start(const Simulation& simulation, const std::vector<std::string>& collider_names,
                     const std::vector<std::string>& drain_names) {
  history_ =
      HistoryWriter::create(history_path_, parts_of(simulation, collider_names, drain_names));
  for (const auto& samples : samples_) samples->sampler->begin(simulation);
  record(simulation);
}

void Recorder::resume(const Simulation& simulation, const StateReader& checkpoint,
                      const std::vector<std::string>& collider_names,
                      const std::vector<std::string>& drain_names) {
  const double time = simulation.time();
  taken_step_ = simulation.step_count();
  saved_time_ = time;
  // What is due here was taken before the checkpoint.
  take(Schedule::history_stream, time);
  take(Schedule::checkpoint_stream, time);
  for (const auto& frames : frames_) {
    take(frames->stream, time);
    frames->particles->resume(checkpoint, series_key(frames->spec.name));
    if (frames->grid) frames->grid->resume(checkpoint, series_key(frames->spec.grid_name()));
  }
  for (const auto& samples : samples_) {
    take(samples->stream, time);
    samples->sampler->load(checkpoint);
    samples->table =
        CsvWriter::resume(folder_ / samples->sampler->file(), "", simulation.step_count());
  }
  history_ = HistoryWriter::resume(history_path_, parts_of(simulation, collider_names, drain_names),
                                   simulation.step_count());
  history_time_ = time;
}

bool Recorder::take(int stream, double time) {
  if (!schedule_.due(stream, time)) return false;
  const double event = schedule_.event(stream, time);
  const auto [last, first] = events_.try_emplace(stream, event);
  if (!first && last->second == event) return false;
  last->second = event;
  return true;
}

void Recorder::record(const Simulation& simulation) {
  queue_.check();
  const double time = simulation.time();
  const Stopwatch watch(seconds_);
  if (take(Schedule::history_stream, time)) take_row(simulation);
  for (const auto& samples : samples_) {
    if (take(samples->stream, time)) take_samples(simulation, *samples);
  }
  for (const auto& frames : frames_) {
    if (take(frames->stream, time)) take_frames(simulation, *frames);
  }
  if (take(Schedule::checkpoint_stream, time)) take_checkpoint(simulation);
}

void Recorder::take_row(const Simulation& simulation) {
  queue_.add(JobSize::small, [this, row = simulation.history()] {
    history_->add(row);
    history_time_ = row.time;
  });
}

void Recorder::take_frames(const Simulation& simulation, Frames& frames) {
  queue_.wait_for_room(JobSize::large);
  std::vector<GridSnapshot> lattices;
  if (frames.grid) lattices = simulation.grid();
  queue_.add(JobSize::large,
             [&frames, particles = simulation.particles(frames.spec.fields, frames.filter),
              lattices = std::move(lattices)] {
               frames.particles->add(particles);
               if (frames.grid) frames.grid->add(lattices);
             });
}

void Recorder::take_samples(const Simulation& simulation, Samples& samples) {
  constexpr std::size_t few = 10000;  // particles, about a megabyte of numbers
  ParticleSnapshot particles =
      simulation.particles(samples.sampler->fields(), samples.sampler->filter());
  const JobSize size = particles.id.size() > few ? JobSize::large : JobSize::small;
  queue_.add(size, [this, &samples, particles = std::move(particles)] {
    if (!samples.table) {
      const std::filesystem::path path = folder_ / samples.sampler->file();
      std::filesystem::create_directories(path.parent_path());
      samples.table = CsvWriter::create(path, samples.sampler->header(particles));
    }
    samples.table->add(samples.sampler->lines(particles));
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
  for (const auto& samples : samples_) samples->table->sync();
  CheckpointWriter out(checkpoint_path_);
  out.put_text("run/deck", identity_.deck);
  out.put_text("run/backend", identity_.backend);
  out.put_text("run/version", identity_.version);
  for (const auto& frames : frames_) {
    frames->particles->save(out, series_key(frames->spec.name));
    if (frames->grid) frames->grid->save(out, series_key(frames->spec.grid_name()));
  }
  for (const auto& samples : samples_) samples->sampler->save(out);
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
  for (const auto& frames : frames_) {
    const FrameSeries& series = *frames->particles;
    if (series.times().empty()) continue;
    add(fmt::format("{} (t = {:.6g} s)", series.last_file(), series.times().back()));
  }
  if (history_time_) add(fmt::format("history.csv (to t = {:.6g} s)", *history_time_));
  if (saved_time_) add(fmt::format("checkpoint.h5 (t = {:.6g} s)", *saved_time_));
  return text.empty() ? "nothing" : text;
}

void add_records(const Deck& deck, Recorder& recorder) {
  int stream = Schedule::checkpoint_stream;
  for (const OutputSpec& frames : deck.frames) {
    recorder.add_frames(frames, ++stream, frame_filter(frames, deck.domain.dimension));
  }
  const auto add = [&](const auto& specs) {
    for (const auto& spec : specs) recorder.add_samples(make_sampler(spec, deck.domain), ++stream);
  };
  add(deck.probes);
  add(deck.profiles);
  add(deck.sections);
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
