// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/bench_options.hpp"
#include "solver/simulation/simulation.hpp"

namespace scree {

/// The scene of the deck options.deck with options.overrides, without output: steps are the deck's
/// own, and go on past its end. Sets in the options what the deck says: name of the case,
/// dimension, kernel and precision. Throws UserError with all problems of the deck.
SimulationSetup build_bench_deck(BenchOptions& options);

}  // namespace scree
