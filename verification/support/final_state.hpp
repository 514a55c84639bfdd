// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include "solver/io/memory_archive.hpp"
#include "verification/support/scene.hpp"

namespace scree::testing {

/// What a checkpoint holds after all steps of a setup on so many threads.
inline MemoryArchive final_state(SimulationSetup setup, int threads) {
  setup.threads = threads;
  const Schedule schedule = setup.schedule;
  const auto simulation = Simulation::create(std::move(setup));
  run(*simulation, schedule);
  MemoryArchive archive;
  simulation->save(archive);
  return archive;
}

/// The same of a run that goes on from a checkpoint.
inline MemoryArchive continued_state(const SimulationSetup& setup, const MemoryArchive& from) {
  const auto simulation = Simulation::create(setup);
  simulation->load(from);
  run(*simulation, setup.schedule);
  MemoryArchive archive;
  simulation->save(archive);
  return archive;
}

}  // namespace scree::testing
