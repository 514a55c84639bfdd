// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "solver/transfer/stencil.hpp"

namespace scree {

/// Affine transfers as one pass over each lattice: what a group does that has no faster way to
/// treat all lattices together.
struct LatticeSums {
  /// velocity = sum over all lattices of w v; affine = sum of w v (x_i - x_p)^T.
  template <class G, class V, int D, int L, int S>
  SCREE_FN static void gather_affine(const G& g, int channel, const Stencil<V, D, L, S>& p,
                                     V (&velocity)[D], V (&affine)[D][D]) {
    SCREE_UNROLL_ON_DEVICE for (int k = 0; k < L; ++k) {
      V value[D];
      V moment[D][D];
      g.gather_moments(channel, p.base[k], p.weight[k], value, moment);
      for (int c = 0; c < D; ++c) {
        velocity[c] = k == 0 ? value[c] : velocity[c] + value[c];
        for (int a = 0; a < D; ++a) {
          const V part = moment[c][a] + p.offset[k][a] * value[c];
          affine[c][a] = k == 0 ? part : affine[c][a] + part;
        }
      }
    }
  }

  /// Adds w (q + A (x_i - x_p)) and mass w m to the nodes of all lattices.
  template <class G, class V, int D, int L, int S>
  SCREE_FN static void scatter_affine(G& g, int channel, const Stencil<V, D, L, S>& p,
                                      const V (&q)[D], const V& mass, const V (&affine)[D][D],
                                      const V& mask) {
    SCREE_UNROLL_ON_DEVICE for (int k = 0; k < L; ++k) {
      V lowest[D];
      for (int c = 0; c < D; ++c) {
        lowest[c] = q[c];
        for (int a = 0; a < D; ++a) lowest[c] = lowest[c] + affine[c][a] * p.offset[k][a];
      }
      g.scatter_moments(channel, p.base[k], p.weight[k], lowest, mass, affine, mask);
    }
  }
};

}  // namespace scree
