// SPDX-License-Identifier: Apache-2.0
#include "solver/grid/topology.hpp"

#include <algorithm>

namespace scree {
namespace {

void sort_unique(std::vector<std::uint64_t>& keys) {
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
}

template <int D>
BlockCoord<D> shifted(const BlockCoord<D>& c, int neighbour) {
  BlockCoord<D> out = c;
  for (int a = D - 1; a >= 0; --a) {
    out[a] += neighbour % 3 - 1;
    neighbour /= 3;
  }
  return out;
}

/// Adds the blocks along one axis that hold images of this block's nodes beyond a face.
template <int D>
void add_images(const BlockCoord<D>& c, int axis, const GridDomain<D>& domain,
                std::vector<std::uint64_t>& out) {
  const std::int32_t n = domain.cells[axis];
  for (int side = 0; side < 2; ++side) {
    const FaceKind kind = domain.faces[axis][side];
    if (kind == FaceKind::none) continue;
    for (int k = 0; k < block_cells; ++k) {
      const std::int32_t node = block_cells * c[axis] + k;
      const bool outside = side == 0 ? node < 0 : node >= n;
      if (!outside) continue;
      for (int lattice = 0; lattice < domain.lattices; ++lattice) {
        const std::int32_t image = kind == FaceKind::periodic
                                       ? periodic_node(node, n)
                                       : mirrored_node(node, n, side, lattice);
        BlockCoord<D> b = c;
        b[axis] = block_of_node(image);
        out.push_back(block_key<D>(b));
      }
    }
  }
}

}  // namespace

template <int D>
void Topology<D>::build(const std::vector<std::uint64_t>& occupied, const GridDomain<D>& domain) {
  keys_.clear();
  keys_.reserve(occupied.size() * 2);
  for (const std::uint64_t key : occupied) {
    const BlockCoord<D> c = block_coord<D>(key);
    for (int n = 0; n < neighbour_count<D>; ++n) keys_.push_back(block_key<D>(shifted<D>(c, n)));
  }
  sort_unique(keys_);
  for (int axis = 0; axis < D; ++axis) {
    std::vector<std::uint64_t> images;
    for (const std::uint64_t key : keys_) add_images<D>(block_coord<D>(key), axis, domain, images);
    keys_.insert(keys_.end(), images.begin(), images.end());
    sort_unique(keys_);
  }
  neighbours_.resize(keys_.size() * neighbour_count<D>);
  for (std::size_t b = 0; b < keys_.size(); ++b) {
    const BlockCoord<D> c = block_coord<D>(keys_[b]);
    for (int n = 0; n < neighbour_count<D>; ++n) {
      neighbours_[b * neighbour_count<D> + n] = find(block_key<D>(shifted<D>(c, n)));
    }
  }
}

template <int D>
int Topology<D>::find(std::uint64_t key) const {
  const auto it = std::lower_bound(keys_.begin(), keys_.end(), key);
  return it != keys_.end() && *it == key ? static_cast<int>(it - keys_.begin()) : -1;
}

template class Topology<2>;
template class Topology<3>;

}  // namespace scree
