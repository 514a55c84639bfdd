// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/coupling/flow_points.hpp"

namespace scree {

/// The chunks of a body by columns of blocks that differ in the last axis only, in its order: what
/// one block leaves in the cache the next one finds there.
template <int D>
struct FlowColumns {
  using Column = std::vector<std::int32_t>;  ///< numbers of chunks
  /// Columns of one colour, the parity of the other axes, share neither nodes of the velocity nor
  /// pressure cells.
  std::array<std::vector<Column>, std::size_t(1) << (D - 1)> colours;
  std::vector<Column> alone;  ///< beside periodic faces: they may share cells with any other

  /// cells: of the domain; all_alone: boxes of particles are so long that any columns may share
  /// cells.
  FlowColumns(const std::vector<FlowChunk<D>>& chunks, std::int32_t body,
              const std::array<std::int32_t, D>& cells, const std::array<bool, D>& periodic,
              bool all_alone);
};

extern template struct FlowColumns<2>;
extern template struct FlowColumns<3>;

}  // namespace scree
