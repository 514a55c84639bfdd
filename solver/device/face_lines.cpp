// SPDX-License-Identifier: Apache-2.0
#include "solver/device/face_lines.hpp"

#include <algorithm>
#include <utility>

namespace scree {

template <int D, class T>
void FaceLines::build(const Grid<D, T>& grid, const std::vector<FacePair>& pairs, int axis) {
  std::vector<std::pair<std::uint64_t, std::size_t>> by_line;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const std::int64_t nodes = block_node_count<D>;
    const std::int64_t lattice_block = pairs[i].image / nodes;
    BlockCoord<D> node =
        grid.node(int(lattice_block / grid.lattices()), int(pairs[i].image % nodes));
    node[std::size_t(axis)] = 0;
    const auto lattice = std::uint64_t(lattice_block % grid.lattices());
    by_line.emplace_back(block_key<D>(node) << 1 | lattice, i);
  }
  std::sort(by_line.begin(), by_line.end());  // pairs of a line stay in order
  std::vector<std::int32_t> begin;
  std::vector<std::int64_t> ghost;
  std::vector<std::int64_t> image;
  std::vector<std::int32_t> side;
  for (std::size_t k = 0; k < by_line.size(); ++k) {
    if (k == 0 || by_line[k].first != by_line[k - 1].first) begin.push_back(std::int32_t(k));
    const FacePair& pair = pairs[by_line[k].second];
    ghost.push_back(pair.ghost);
    image.push_back(pair.image);
    side.push_back(pair.side);
  }
  begin.push_back(std::int32_t(by_line.size()));
  begin_.upload(begin);
  ghost_.upload(ghost);
  image_.upload(image);
  side_.upload(side);
  folded_.resize(ghost.size());
  folded_.zero();
}

#define SCREE_BUILD(D, T) \
  template void FaceLines::build(const Grid<D, T>&, const std::vector<FacePair>&, int);
SCREE_BUILD(2, float)
SCREE_BUILD(2, double)
SCREE_BUILD(3, float)
SCREE_BUILD(3, double)
#undef SCREE_BUILD

}  // namespace scree
