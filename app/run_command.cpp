// SPDX-License-Identifier: Apache-2.0
#include "app/run_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <memory>
#include <new>
#include <utility>

#include "app/backend_choice.hpp"
#include "app/build_simulation.hpp"
#include "app/deck_warnings.hpp"
#include "app/machine_info.hpp"
#include "app/progress.hpp"
#include "app/recorder.hpp"
#include "app/run_folder.hpp"
#include "app/run_loop.hpp"
#include "app/run_record.hpp"
#include "app/run_summary.hpp"
#include "app/sampler.hpp"
#include "app/signals.hpp"
#include "generated/build_info.hpp"
#include "solver/base/error.hpp"
#include "solver/deck/deck.hpp"
#include "solver/io/checkpoint.hpp"
#include "solver/io/durable_file.hpp"
#include "solver/simulation/simulation_on_device.hpp"

namespace scree {

namespace fs = std::filesystem;

namespace {

constexpr double record_interval = 5;  // s of wall time between two updates of run.json

double wall_clock() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

constexpr const char* no_memory =
    "there is not enough memory; scree check says how much a deck needs";

std::string sentence(const fs::filesystem_error& error) {
  return fmt::format("cannot use {}: {}", error.path1().string(), error.code().message());
}

FolderMode folder_mode(const RunOptions& options) {
  if (options.resume && options.overwrite) {
    throw UserError("--resume and --overwrite exclude each other");
  }
  if (options.resume) return FolderMode::resume;
  return options.overwrite ? FolderMode::overwrite : FolderMode::fresh;
}

std::vector<std::string> collider_names(const Deck& deck) {
  std::vector<std::string> names;
  for (const ColliderSpec& collider : deck.colliders) names.push_back(collider.name);
  return names;
}

std::vector<std::string> drain_names(const Deck& deck) {
  std::vector<std::string> names;
  for (const DrainageSpec& drainage : deck.drainage) names.push_back(drainage.name);
  return names;
}

void warn(const std::vector<std::string>& warnings) {
  for (const std::string& text : warnings) fmt::print(stderr, "scree: warning: {}\n", text);
}

/// What keeps a deck off a GPU; empty: nothing.
std::string processor_only(const Deck& deck) {
  if (deck.coupling) return "[coupling]";
  const bool fbar = deck.method.volumetric_locking == VolumetricLocking::fbar;
  return fbar ? "method.volumetric_locking = \"fbar\"" : "";
}

/// A run from its deck to its summary.
class Run {
 public:
  Run(const RunOptions& options, Deck deck);

  int execute();

 private:
  RunIdentity identity() const;
  void build();
  void choose_backend();
  void open_files();
  RunEnd advance();
  void after_step();
  void update_record();
  int finish(RunEnd end);
  int fail(const std::string& fault, int status = 1);
  void warn_of_short_steps();
  ProgressState progress_state() const;
  std::string files() const;

  const RunOptions& options_;
  Deck deck_;
  FolderMode mode_;
  fs::path path_;
  BackendChoice backend_;
  StopSignals signals_;
  std::unique_ptr<CheckpointReader> checkpoint_;
  Schedule schedule_;
  std::unique_ptr<Simulation> simulation_;
  std::unique_ptr<RunFolder> folder_;
  std::unique_ptr<Recorder> recorder_;
  std::unique_ptr<Progress> progress_;
  RunRecord former_;  ///< sums of the run before this call
  RunRecord record_;
  double started_ = 0, recorded_ = 0;  ///< s, wall clock
  double updates_ = 0;                 ///< particle updates of this call
  bool warned_ = false;                ///< of short steps
};

Run::Run(const RunOptions& options, Deck deck)
    : options_(options), deck_(std::move(deck)), mode_(folder_mode(options)) {
  path_ = options.output.empty() ? default_run_folder(deck_.path) : fs::path(options.output);
  record_.version = build_info::version;
  record_.title = deck_.title;
  record_.deck = deck_.path;
  record_.threads = thread_count(options.threads);
  record_.end_time = deck_.time.end;
  record_.cite = citations(deck_);
}

RunIdentity Run::identity() const {
  return {resolved_toml(deck_), record_.backend, record_.version};
}

/// `auto` goes on where the run has begun.
void Run::choose_backend() {
  std::string asked = options_.backend;
  if (asked == "auto" && checkpoint_) asked = checkpoint_->text("run/backend");
  const auto on_need = [this](const MemoryNeed& need) {
    if (!options_.quiet) fmt::print("{}\n", memory_need_text(need));
  };
  backend_ = scree::choose_backend(asked, on_need, processor_only(deck_));
  record_.backend = backend_.name;
  if (backend_.device && !options_.quiet) {
    warn({"the GPU backend has been tested in emulation only, not on a GPU"});
  }
}

/// All that can fail because of the input, before anything is written.
void Run::build() {
  RunFolder::check(path_, mode_);
  if (mode_ == FolderMode::resume) {
    checkpoint_ = std::make_unique<CheckpointReader>(path_ / "checkpoint.h5");
  }
  choose_backend();
  if (checkpoint_) check_identity(*checkpoint_, identity());
  SimulationSetup setup = build_setup(deck_);
  setup.threads = record_.threads;
  schedule_ = setup.schedule;
  if (!options_.quiet && !checkpoint_) warn(deck_warnings(deck_, setup));
  simulation_ = create_on_device(std::move(setup), backend_.device);
  if (checkpoint_) {
    simulation_->load(*checkpoint_);
  } else {
    check_probes(deck_, simulation_->particle_count());
  }
}

void Run::open_files() {
  folder_ = std::make_unique<RunFolder>(RunFolder::open(path_, mode_));
  if (checkpoint_) add_former_times(former_, folder_->record());
  update_record();
  write_record(folder_->record(), record_);
  replace_file(folder_->resolved_deck(), resolved_toml(deck_));
  const bool checkpoints = deck_.checkpoint.every.has_value();
  recorder_ = std::make_unique<Recorder>(*folder_, deck_.output, checkpoints, schedule_, identity(),
                                         frame_filter(deck_.output, deck_.domain.dimension));
  add_records(deck_, *recorder_);
  if (checkpoint_) {
    recorder_->resume(*simulation_, *checkpoint_, collider_names(deck_), drain_names(deck_));
    checkpoint_.reset();
  } else {
    recorder_->start(*simulation_, collider_names(deck_), drain_names(deck_));
  }
}

RunEnd Run::advance() {
  RunLimits limits;
  if (options_.until) limits.until = *options_.until;
  progress_ = std::make_unique<Progress>(stdout, progress_style(stdout, options_.quiet),
                                         simulation_->time(),
                                         std::min(deck_.time.end, limits.until), wall_clock);
  if (options_.max_steps) limits.max_steps = *options_.max_steps;
  limits.stop_asked = [] { return StopSignals::received() != 0; };
  return run_loop(*simulation_, schedule_, *recorder_, limits, [this] { after_step(); });
}

void Run::after_step() {
  updates_ += static_cast<double>(simulation_->particle_count());
  progress_->update(progress_state());
  warn_of_short_steps();
  const double now = wall_clock();
  if (now - recorded_ < record_interval) return;
  recorded_ = now;
  update_record();
  write_record(folder_->record(), record_);
}

/// Once, when the run has become a thousand times longer than it looked at the start.
void Run::warn_of_short_steps() {
  constexpr double share = 1e-3;
  if (warned_ || options_.quiet) return;
  const StepLimit limit = simulation_->step_limit();
  if (!(limit.shrinkage() < share)) return;
  warned_ = true;
  progress_->finish(progress_state());
  fmt::print(stderr, "scree: warning: {}\n", short_step_text(simulation_->time(), limit));
}

ProgressState Run::progress_state() const {
  return {simulation_->time(), simulation_->step_count(), simulation_->dt(), updates_};
}

void Run::update_record() {
  record_.particles = simulation_->particle_count();
  record_.removed_particles = simulation_->removed_count();
  record_.steps = simulation_->step_count();
  record_.simulated_time = simulation_->time();
  record_.wall_seconds = former_.wall_seconds + (wall_clock() - started_);
  record_.particle_updates = former_.particle_updates + updates_;
  record_.bytes_per_particle = static_cast<double>(simulation_->memory().total()) /
                               std::max(1.0, static_cast<double>(record_.particles));
  record_.phases = former_.phases;
  for (const auto& [name, seconds] : simulation_->phases()) record_.phases[name] += seconds;
  if (recorder_) record_.phases["output"] += recorder_->seconds();
}

std::string Run::files() const {
  std::string text = "resolved.toml, run.json";
  std::vector<std::string> names{"history.csv"};
  const auto add_series = [&](const std::string& name) {
    names.insert(names.end(), {name + ".pvd", name + ".xdmf"});
  };
  add_series("particles");
  add_series("grid");
  for (const OutputSpec& frames : deck_.frames) {
    add_series(frames.name);
    add_series(frames.grid_name());
  }
  for (const ProbeSpec& probe : deck_.probes) names.push_back("probes/" + probe.name + ".csv");
  for (const ProfileSpec& p : deck_.profiles) names.push_back("profiles/" + p.name + ".csv");
  for (const SectionSpec& s : deck_.sections) names.push_back("sections/" + s.name + ".csv");
  names.emplace_back("checkpoint.h5");
  for (const std::string& name : names) {
    if (fs::exists(path_ / name)) text += ", " + name;
  }
  return text;
}

int Run::finish(RunEnd end) {
  progress_->finish(progress_state());
  update_record();
  record_.status = end == RunEnd::end_time ? "done" : "interrupted";
  write_record(folder_->record(), record_);
  if (!options_.quiet) {
    fmt::print("{}", run_summary(record_, path_, files()));
    if (end != RunEnd::end_time) fmt::print("continue with --resume\n");
  }
  return end == RunEnd::signal ? 128 + StopSignals::received() : 0;
}

int Run::fail(const std::string& fault, int status) {
  if (progress_) progress_->finish(progress_state());
  const std::string kept = recorder_ ? recorder_->kept() : "nothing";
  fmt::print(stderr, "scree: {}; kept in {}: {}\n", fault, path_.string(), kept);
  update_record();
  record_.status = "failed";
  record_.faults.push_back(fault);
  if (!write_last_record(folder_->record(), record_)) {
    fmt::print(stderr, "scree: {} could not be brought up to date\n", folder_->record().string());
  }
  return status;
}

int Run::execute() {
  started_ = recorded_ = wall_clock();
  build();
  if (!options_.quiet) {
    const bool fbar = deck_.method.volumetric_locking == VolumetricLocking::fbar;
    fmt::print("{}\n{} particles, {}, {} thread{}{} -> {}\n",
               deck_.title.empty() ? deck_.name : deck_.title, simulation_->particle_count(),
               backend_text(backend_), record_.threads, record_.threads == 1 ? "" : "s",
               fbar ? ", volumetric_locking fbar (separate passes)" : "", path_.string());
    std::fflush(stdout);
  }
  try {
    open_files();
    return finish(advance());
  } catch (const RunFault& fault) {
    if (!folder_) throw;  // nothing was written: the caller prints the sentence
    return fail(fault.what());
  } catch (const UserError& error) {
    if (!folder_) throw;
    return fail(error.what(), 2);
  } catch (const fs::filesystem_error& error) {
    if (!folder_) throw;
    return fail(sentence(error));
  } catch (const std::bad_alloc&) {
    if (!folder_) throw;
    return fail(no_memory);
  } catch (const std::exception& error) {
    if (!folder_) throw;
    return fail(std::string("internal error: ") + error.what());
  }
}

}  // namespace

int run_command(const RunOptions& options) {
  try {
    Problems problems;
    Deck deck = read_deck(options.deck, options.overrides, problems);
    if (!problems.empty()) {
      fmt::print(stderr, "{}", problems.text());
      return 2;
    }
    return Run(options, std::move(deck)).execute();
  } catch (const UserError& error) {
    fmt::print(stderr, "scree: {}\n", error.what());
    return 2;
  } catch (const RunFault& fault) {
    fmt::print(stderr, "scree: {}\n", fault.what());
    return 1;
  } catch (const fs::filesystem_error& error) {
    fmt::print(stderr, "scree: {}\n", sentence(error));
    return 1;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "scree: {}\n", no_memory);
    return 1;
  }
}

}  // namespace scree
