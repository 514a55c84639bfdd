// SPDX-License-Identifier: Apache-2.0
#include "verification/suite/run.hpp"

#include <algorithm>
#include <ctime>
#include <stdexcept>

#include "app/build_simulation.hpp"
#include "solver/base/error.hpp"
#include "solver/simulation/simulation_on_device.hpp"

namespace scree::verify {
namespace {

/// Time that this thread has computed: a run has one thread, whatever else the machine does.
double core_seconds() {
  std::timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

Vec3<double> place(const ParticleSnapshot& snapshot, std::size_t row) {
  const double* const p = &snapshot.position[3 * row];
  return {{p[0], p[1], p[2]}};
}

/// Takes rows and frames when they are due, each event once.
class Collector {
 public:
  Collector(Run& run, Schedule schedule) : run_(run), schedule_(std::move(schedule)) {}

  void take(const Simulation& simulation) {
    const double t = simulation.time();
    if (fresh(row_, schedule_.history_due(t), schedule_.history_event(t)))
      run_.history.push_back(simulation.history());
    if (fresh(frame_, schedule_.frame_due(t), schedule_.frame_event(t)))
      run_.frames.push_back(simulation.particles(run_.deck.output.fields));
  }

 private:
  /// Steps much shorter than an interval see the same event more than once.
  static bool fresh(std::optional<double>& last, bool due, double event) {
    if (!due || last == event) return false;
    last = event;
    return true;
  }

  Run& run_;
  Schedule schedule_;
  std::optional<double> row_, frame_;
};

void execute_particles(Run& run, const std::shared_ptr<const DeviceToolkit>& device,
                       const std::function<bool()>& stop) {
  SimulationSetup setup = build_setup(run.deck);
  const Schedule schedule = setup.schedule;
  const auto simulation = create_on_device(std::move(setup), device);
  run.particles = simulation->particle_count();
  Collector collector(run, schedule);
  collector.take(*simulation);
  while (!schedule.finished(simulation->time())) {
    if (stop()) throw RunFault("stopped by a signal");
    simulation->step();
    run.steps = simulation->step_count();
    collector.take(*simulation);
  }
}

}  // namespace

ParticleFrame::ParticleFrame(const ParticleSnapshot& now, const ParticleSnapshot& first)
    : now_(&now) {
  for (std::size_t p = 0; p < now.id.size(); ++p) {
    const auto found = std::lower_bound(first.id.begin(), first.id.end(), now.id[p]);
    x_.push_back(place(now, p));
    X_.push_back(place(first, static_cast<std::size_t>(found - first.id.begin())));
  }
}

Column ParticleFrame::field(const std::string& name) const {
  for (const SnapshotField& field : now_->fields) {
    if (field.name == name) return Column(field);
  }
  throw std::logic_error("the case's deck does not list \"" + name + "\" in output.fields");
}

ParticleFrame Run::frame(int index) const {
  const int count = static_cast<int>(frames.size());
  const int row = index < 0 ? count + index : index;
  if (row < 0 || row >= count) throw std::logic_error("the run has no frame of that number");
  return {frames[static_cast<std::size_t>(row)], frames.front()};
}

void execute(Run& run, const Value& document, const std::string& source,
             const std::shared_ptr<const DeviceToolkit>& device, Problems& problems,
             const std::function<bool()>& stop) {
  const double start = core_seconds();
  const bool element = document.find("path") != nullptr;
  if (element) {
    run.element_deck = read_element_document(document, source, problems);
  } else {
    run.deck = read_deck_document(document, source, problems);
  }
  if (!problems.empty()) return;
  try {
    if (element) {
      run.element = drive_element(*run.element_deck);
    } else {
      execute_particles(run, device, stop);
    }
  } catch (const RunFault& fault) {
    run.fault = fault.what();
  }
  run.seconds = core_seconds() - start;
}

}  // namespace scree::verify
