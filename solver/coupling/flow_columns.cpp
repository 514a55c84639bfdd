// SPDX-License-Identifier: Apache-2.0
#include "solver/coupling/flow_columns.hpp"

#include <algorithm>

namespace scree {

template <int D>
FlowColumns<D>::FlowColumns(const std::vector<FlowChunk<D>>& chunks, std::int32_t body,
                            const std::array<std::int32_t, D>& cells,
                            const std::array<bool, D>& periodic, bool all_alone) {
  std::vector<std::int32_t> order;
  for (std::size_t c = 0; c < chunks.size(); ++c) {
    if (chunks[c].body == body) order.push_back(std::int32_t(c));
  }
  const auto block = [&](std::int32_t c) -> const BlockCoord<D>& {
    return chunks[std::size_t(c)].block;
  };
  std::sort(order.begin(), order.end(),
            [&](std::int32_t a, std::int32_t b) { return block(a) < block(b); });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const BlockCoord<D>& at = block(order[i]);
    std::size_t colour = 0;
    bool apart = all_alone;
    for (std::size_t a = 0; a + 1 < D; ++a) {
      colour = 2 * colour + std::size_t(at[a] & 1);
      apart = apart || (periodic[a] && (at[a] <= 0 || block_cells * (at[a] + 1) >= cells[a]));
    }
    auto& list = apart ? alone : colours[colour];
    const bool same = i > 0 && std::equal(at.begin(), at.end() - 1, block(order[i - 1]).begin());
    if (!same) list.emplace_back();
    list.back().push_back(order[i]);
  }
}

template struct FlowColumns<2>;
template struct FlowColumns<3>;

}  // namespace scree
