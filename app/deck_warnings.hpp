// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "solver/deck/deck.hpp"
#include "solver/simulation/simulation.hpp"

namespace scree {

/// "column 32 kg/m (shape 32)": what the particles of each body weigh (in 2D per metre of
/// thickness), and the exact mass of the shape where a formula gives it.
std::string masses_text(const Deck& deck, const SimulationSetup& setup);

/// What a deck may say but hardly means, one sentence each: bodies that overlap, colliders that
/// hold particles at t = 0, bodies whose particles miss their shape's mass by more than 5 %, a cfl
/// above the default that fluids do not take.
/// Takes one signed distance a particle for each other body or collider whose bounds it lies in.
std::vector<std::string> deck_warnings(const Deck& deck, const SimulationSetup& setup);

}  // namespace scree
