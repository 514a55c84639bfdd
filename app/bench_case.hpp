// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/bench_options.hpp"
#include "solver/simulation/simulation.hpp"

namespace scree {

/// The scene of a benchmark with 8 particles a cell in 3D and 4 in 2D:
/// elastic: a free cube (fixed_corotated) with a smooth velocity field;
/// sand: a column (drucker_prager) that collapses on a sticky floor;
/// fluid: a block (j_fluid) that spreads between slip walls;
/// coupled: a block of elastic soil full of water between slip walls, which settles under its
/// weight and drains at its top.
/// Throws UserError for an unknown case, kernel, precision or path.
SimulationSetup build_bench_case(const BenchOptions& options);

}  // namespace scree
