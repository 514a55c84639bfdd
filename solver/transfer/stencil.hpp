// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "solver/base/pack.hpp"

namespace scree {

/// The nodes around one particle (or one particle a lane), in a block's arena.
///
/// V: real or Lanes, D: dimension, L: number of lattices (2 for the compact kernel's dual grid),
/// S: nodes an axis and lattice. Lengths are in cells.
template <class V, int D, int L, int S>
struct Stencil {
  IntOf<V> base[L];   ///< arena index of the lowest node, lattice offset included
  V weight[L][D][S];  ///< 1D weights; a node's weight is their product over the axes
  V offset[L][D];     ///< lowest node minus particle [cells]
};

/// 1D weight derivatives d w / d x_p [1/cell], same shape as Stencil::weight.
template <class V, int D, int L, int S>
struct Slopes {
  V slope[L][D][S];
};

/// Arena index of node (i_0, ..., i_{D-1}) of a lattice with `extent` nodes an axis, last axis
/// fastest; the indices are whole numbers held in V.
template <class V, int D>
SCREE_FN IntOf<V> arena_index(const V (&node)[D], int extent, int lattice) {
  V index = node[0];
  int stride = extent;
  for (int a = 1; a < D; ++a) {
    index = index * Scalar<V>(extent) + node[a];
    stride *= extent;
  }
  return to_int(index + Scalar<V>(lattice * stride));
}

}  // namespace scree
