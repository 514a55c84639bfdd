// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "solver/boundary/periods.hpp"
#include "solver/simulation/simulation.hpp"

namespace scree {

/// The axes of a setup's domain that lie between periodic faces.
inline Periods periods_of(const SimulationSetup& setup) {
  Periods periods;
  periods.lower = setup.lower;
  for (std::size_t a = 0; a < static_cast<std::size_t>(setup.dimension); ++a) {
    if (setup.faces[a][0] != FaceType::periodic) continue;
    periods.length[a] = setup.cell_size * setup.cells[a];
  }
  return periods;
}

}  // namespace scree
