// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <type_traits>

#include "solver/grid/face_fold.hpp"
#include "solver/grid/face_pairs.hpp"
#include "solver/grid/node_updates.hpp"

namespace scree {

/// Turns the sums {w V q, w V} of a channel into means {q, w V} of quantities q that are the same
/// on both sides of a face (scalars): what lies beyond a mirror or periodic face counts at the
/// image and takes over its mean. Nodes without weight hold zeros.
template <int D, class T>
void form_node_means(const Grid<D, T>& grid, const std::type_identity_t<FacePairs<D>>& pairs,
                     AlignedVector<T>& channel, ThreadPool& pool) {
  T* nodes = channel.data();
  for (int axis = 0; axis < D; ++axis) {
    for (const FacePair& pair : pairs[std::size_t(axis)]) {
      if (pair.ghost == pair.image) continue;
      move_to_image(nodes + pair.image * node_values, nodes + pair.ghost * node_values);
    }
  }
  const std::size_t values = grid.block_values();
  pool.for_each(
      grid.topology().size(),
      [&](std::int64_t b, int) {
        divide_by_mass(nodes + std::size_t(b) * values, values / node_values, T(1));
      },
      8);
  for (int axis = D - 1; axis >= 0; --axis) {
    for (const FacePair& pair : pairs[std::size_t(axis)]) {
      if (pair.ghost == pair.image) continue;
      std::copy_n(nodes + pair.image * node_values, node_values, nodes + pair.ghost * node_values);
    }
  }
}

}  // namespace scree
