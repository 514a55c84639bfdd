// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "postproc/project/projection.hpp"

namespace scree {

/// The cells of a projection's lattice that hold particles, with numbers of their own for the nodes
/// around them.
struct ActiveCells {
  std::vector<std::int64_t> nodes;   ///< of the lattice, by own number
  std::vector<double> points;        ///< their places, 3 each [m]
  std::size_t corners = 0;           ///< of a cell: 4 or 8
  std::vector<std::int64_t> corner;  ///< own numbers, `corners` a cell, x running fastest
};

ActiveCells active_cells(const Projection& projection);

}  // namespace scree
