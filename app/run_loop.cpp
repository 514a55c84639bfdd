// SPDX-License-Identifier: Apache-2.0
#include "app/run_loop.hpp"

#include <optional>

namespace scree {

namespace {

std::optional<RunEnd> reached(const Simulation& simulation, const Schedule& schedule,
                              const RunLimits& limits, std::int64_t steps) {
  if (schedule.finished(simulation.time())) return RunEnd::end_time;
  if (limits.stop_asked()) return RunEnd::signal;
  if (simulation.time() >= limits.until) return RunEnd::until;
  if (steps >= limits.max_steps) return RunEnd::max_steps;
  return std::nullopt;
}

RunEnd step_and_record(Simulation& simulation, const Schedule& schedule, Recorder& recorder,
                       const RunLimits& limits, const std::function<void()>& after_step) {
  std::int64_t steps = 0;
  std::optional<RunEnd> end;
  while (!(end = reached(simulation, schedule, limits, steps))) {
    simulation.step();
    recorder.record(simulation);
    ++steps;
    after_step();
  }
  if (*end != RunEnd::end_time || recorder.keeps_checkpoints()) recorder.save(simulation);
  return *end;
}

}  // namespace

RunEnd run_loop(Simulation& simulation, const Schedule& schedule, Recorder& recorder,
                const RunLimits& limits, const std::function<void()>& after_step) {
  try {
    const RunEnd end = step_and_record(simulation, schedule, recorder, limits, after_step);
    recorder.flush();
    return end;
  } catch (...) {
    recorder.flush();
    throw;
  }
}

}  // namespace scree
