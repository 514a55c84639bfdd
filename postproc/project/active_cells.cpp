// SPDX-License-Identifier: Apache-2.0
#include "postproc/project/active_cells.hpp"

#include <array>

namespace scree {

ActiveCells active_cells(const Projection& projection) {
  const Lattice& lattice = projection.lattice;
  ActiveCells active;
  active.corners = std::size_t(1) << lattice.dimension;
  std::vector<std::int64_t> number(static_cast<std::size_t>(lattice.node_count()), -1);
  for (std::size_t cell = 0; cell < projection.active_cell.size(); ++cell) {
    if (projection.active_cell[cell] == 0) continue;
    const auto place = lattice.cell_place(static_cast<std::int64_t>(cell));
    for (std::size_t c = 0; c < active.corners; ++c) {
      const std::array<std::int64_t, 3> at = {
          place[0] + std::int64_t(c & 1), place[1] + std::int64_t(c >> 1 & 1),
          lattice.dimension == 3 ? place[2] + std::int64_t(c >> 2 & 1) : 0};
      const std::int64_t node = lattice.node(at);
      std::int64_t& known = number[static_cast<std::size_t>(node)];
      if (known < 0) {
        known = static_cast<std::int64_t>(active.nodes.size());
        active.nodes.push_back(node);
        for (std::size_t a = 0; a < 3; ++a) {
          active.points.push_back(lattice.origin[a] + lattice.spacing * static_cast<double>(at[a]));
        }
      }
      active.corner.push_back(known);
    }
  }
  return active;
}

}  // namespace scree
