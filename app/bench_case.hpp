// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/bench_options.hpp"
#include "solver/simulation/simulation.hpp"

namespace scree {

/// The scene of a benchmark, with 2 particles an axis and cell but for the last one's 3, which is
/// what a deck gives the compact kernel:
/// elastic: a free cube (fixed_corotated) with a smooth velocity field;
/// sand: a column (drucker_prager) that collapses on a sticky floor;
/// fluid: a block (j_fluid) that spreads between slip walls;
/// coupled: a block of soil full of water between slip walls, which settles under its weight and
/// drains at its top.
/// Throws UserError for an unknown case, kernel, precision or path.
SimulationSetup build_bench_case(const BenchOptions& options);

}  // namespace scree
