// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "solver/deck/deck.hpp"
#include "solver/simulation/simulation.hpp"

namespace scree {

/// Turns a checked deck into what the solver runs: the only place that does. `threads` stays 1. In
/// the setup gravity and body force throw RunFault where their expressions have no finite value.
SimulationSetup build_setup(const Deck& deck);

/// History, frame and checkpoint times of a deck; then, as further streams, those of frames.NAME,
/// of probes, profiles and sections, each in the deck's order.
Schedule build_schedule(const Deck& deck);

}  // namespace scree
