// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "solver/boundary/face_type.hpp"
#include "solver/grid/grid.hpp"

namespace scree {

/// The faces of the domain with their friction coefficients, [axis][0 = lower, 1 = upper].
template <int D>
struct Faces {
  std::array<std::array<FaceType, 2>, D> type{};
  std::array<std::array<double, 2>, D> friction{};
  NoSlip no_slip = NoSlip::node;
};

/// A node beyond a face and its image within; both are record indices. A node on a wall is its own
/// image.
struct FacePair {
  std::int64_t ghost;
  std::int64_t image;
  std::int32_t side;
};

/// For each axis the nodes that its two faces act on; made anew when the block set changes.
template <int D>
using FacePairs = std::array<std::vector<FacePair>, D>;

template <int D, class T>
FacePairs<D> find_face_pairs(const Grid<D, T>& grid, const GridDomain<D>& domain) {
  FacePairs<D> pairs;
  for (int b = 0; b < grid.topology().size(); ++b) {
    const BlockCoord<D> c = grid.topology().coord(b);
    for (int axis = 0; axis < D; ++axis) {
      const std::int32_t n = domain.cells[axis];
      const bool near = block_cells * c[axis] <= 0 || block_cells * (c[axis] + 1) > n;
      if (!near) continue;
      for (int i = 0; i < grid.lattices() * block_node_count<D>; ++i) {
        const int lattice = i / block_node_count<D>;
        BlockCoord<D> node = grid.node(b, i % block_node_count<D>);
        for (int side = 0; side < 2; ++side) {
          const FaceKind kind = domain.faces[axis][side];
          if (kind == FaceKind::none) continue;
          const std::int32_t at = node[axis];
          const std::int32_t image = kind == FaceKind::periodic
                                         ? periodic_node(at, n)
                                         : mirrored_node(at, n, side, lattice);
          const bool wall = kind == FaceKind::mirror && image == at;
          const bool outside =
              side == 0 ? at < 0 : at >= n && (kind == FaceKind::periodic || image < at);
          if (!wall && !outside) continue;
          BlockCoord<D> other = node;
          other[axis] = image;
          const std::int64_t ghost = grid.record(node, lattice);
          const std::int64_t real = grid.record(other, lattice);
          if (real >= 0) pairs[std::size_t(axis)].push_back({ghost, real, side});
        }
      }
    }
  }
  // Walls last: in a domain one cell thick a ghost's image may lie on the opposite wall.
  for (auto& axis : pairs) {
    std::stable_partition(axis.begin(), axis.end(),
                          [](const FacePair& pair) { return pair.ghost != pair.image; });
  }
  return pairs;
}

/// Pairs that follow each other in the list of an axis: their ghosts lie in one block, beyond one
/// face.
struct FaceRun {
  std::size_t begin, end;
  std::int32_t block;
  std::int32_t side;
};

/// records: of a block.
inline std::vector<FaceRun> find_face_runs(const std::vector<FacePair>& pairs,
                                           std::int64_t records) {
  std::vector<FaceRun> runs;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const std::int32_t block = std::int32_t(pairs[i].ghost / records);
    if (runs.empty() || runs.back().block != block || runs.back().side != pairs[i].side) {
      runs.push_back({i, i, block, pairs[i].side});
    }
    runs.back().end = i + 1;
  }
  return runs;
}

}  // namespace scree
