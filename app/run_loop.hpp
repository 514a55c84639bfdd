// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <limits>

#include "app/recorder.hpp"
#include "solver/simulation/schedule.hpp"
#include "solver/simulation/simulation.hpp"

namespace scree {

/// Why a run stopped.
enum class RunEnd { end_time, until, max_steps, signal };

/// What stops a run before its end. None of it changes the size of a step.
struct RunLimits {
  double until = std::numeric_limits<double>::infinity();             ///< s
  std::int64_t max_steps = std::numeric_limits<std::int64_t>::max();  ///< of this call
  std::function<bool()> stop_asked = [] { return false; };            ///< a signal came
};

/// Steps, recording what is due, to the end or to a limit; at a limit, and at the end of a run
/// that keeps checkpoints, a checkpoint is written. `after_step` is called after every step.
/// All that was recorded is written on return, and before a RunFault is thrown; where a write
/// failed, the fault is that of the write, for it came first.
RunEnd run_loop(Simulation& simulation, const Schedule& schedule, Recorder& recorder,
                const RunLimits& limits, const std::function<void()>& after_step);

}  // namespace scree
