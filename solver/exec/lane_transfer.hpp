// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "solver/base/pack.hpp"
#include "solver/exec/transpose.hpp"
#include "solver/grid/block.hpp"

namespace scree {

/// Transfers between a batch of particles and one lattice of the arena, for any stencil: one
/// particle at a time, all quantities of a node {vector, mass} in one register.
///
/// stride: numbers of arena for one node; plane_step, line_step, node_step: quads from one node to
/// the next on the first axis (3D), on the last axis but one and on the last axis.
template <int D, class T, int stride, int plane_step, int line_step, int node_step>
class LaneTransfer {
 public:
  using V = RegisterLanes<T>;
  using Int = IntOf<V>;
  static constexpr int width = lanes_of<V>;

  /// value = sum w v, moment[c][a] = sum w v_c n_a with n the node's number; with slopes: the
  /// weight of axis a replaced by alt instead of n w.
  template <int S, bool slopes>
  static void gather(const T* arena, const Int& base, const V (&w)[D][S], const V (&alt)[D][S],
                     V (&value)[D], V (&moment)[D][D]) {
    alignas(64) T weights[D][S][width];
    alignas(64) T alts[D][S][width];
    alignas(64) IndexLane bases[width];
    alignas(64) T records[width * LaneTranspose<T>::record];
    alignas(64) T lanes[LaneTranspose<T>::record * width];
    store_stencil<S, slopes>(base, w, alt, bases, weights, alts);
    for (int l = 0; l < width; ++l) {
      const Quad* nodes = reinterpret_cast<const Quad*>(arena + std::size_t(bases[l]) * stride);
      T wl[D][S];
      T al[D][S];
      lane_weights<S, slopes>(weights, alts, l, wl, al);
      Quad sums[1 + D];
      gather_lane<S>(nodes, wl, al, sums);
      Quad* record = reinterpret_cast<Quad*>(records + l * LaneTranspose<T>::record);
      SCREE_UNROLL for (int q = 0; q <= D; ++q) record[q] = sums[q];
      if constexpr (D == 2) record[3] = Quad{};
    }
    LaneTranspose<T>::to_lanes(records, lanes);
    for (int c = 0; c < D; ++c) {
      value[c] = scree::load<V>(lanes + c * width);
      for (int a = 0; a < D; ++a) moment[c][a] = scree::load<V>(lanes + (4 * (a + 1) + c) * width);
    }
  }

  /// Adds w (q + sum_a n_a m[.][a]) and mass w m to the nodes, for the lanes of `mask`.
  template <int S, bool slopes>
  static void scatter(T* arena, const Int& base, const V (&w)[D][S], const V (&alt)[D][S],
                      const V (&q)[D], const V& mass, const V (&m)[D][D], const V& mask) {
    alignas(64) T weights[D][S][width];
    alignas(64) T alts[D][S][width];
    alignas(64) IndexLane bases[width];
    alignas(64) T live[width];
    alignas(64) T lanes[LaneTranspose<T>::record * width];
    alignas(64) T records[width * LaneTranspose<T>::record];
    store_stencil<S, slopes>(base, w, alt, bases, weights, alts);
    scree::store(live, mask);
    const V none = broadcast<V>(T(0));
    SCREE_UNROLL for (int q_index = 0; q_index < 4; ++q_index) {
      SCREE_UNROLL for (int c = 0; c < 4; ++c) {
        T* out = lanes + (4 * q_index + c) * width;
        const bool used = q_index <= D && c < D;
        if (q_index == 0 && c == mass_slot) {
          scree::store(out, mass);
        } else if (!used) {
          scree::store(out, none);
        } else {
          scree::store(out, q_index == 0 ? q[c < D ? c : 0]
                                         : m[c < D ? c : 0][q_index > 0 ? q_index - 1 : 0]);
        }
      }
    }
    LaneTranspose<T>::to_records(lanes, records);
    for (int l = 0; l < width; ++l) {
      if (live[l] == T(0)) continue;
      Quad* nodes = reinterpret_cast<Quad*>(arena + std::size_t(bases[l]) * stride);
      T wl[D][S];
      T al[D][S];
      lane_weights<S, slopes>(weights, alts, l, wl, al);
      scatter_lane<S>(nodes, wl, al, reinterpret_cast<const Quad*>(records + l * 16));
    }
  }

 private:
  using IndexLane = Scalar<Int>;
  typedef T Quad __attribute__((vector_size(4 * sizeof(T)), may_alias));

  /// Writes a stencil to memory, so that single lanes can be read.
  template <int S, bool slopes>
  static void store_stencil(const Int& base, const V (&w)[D][S], const V (&alt)[D][S],
                            IndexLane (&bases)[width], T (&weights)[D][S][width],
                            T (&alts)[D][S][width]) {
    scree::store(bases, base);
    for (int a = 0; a < D; ++a) {
      for (int s = 0; s < S; ++s) {
        scree::store(&weights[a][s][0], w[a][s]);
        if constexpr (slopes) scree::store(&alts[a][s][0], alt[a][s]);
      }
    }
  }

  /// The weights of one lane; without slopes the second set is n w.
  template <int S, bool slopes>
  static void lane_weights(const T (&weights)[D][S][width], const T (&alts)[D][S][width], int l,
                           T (&w)[D][S], T (&alt)[D][S]) {
    for (int a = 0; a < D; ++a) {
      for (int s = 0; s < S; ++s) {
        w[a][s] = weights[a][s][l];
        alt[a][s] = slopes ? alts[a][s][l] : T(s) * w[a][s];
      }
    }
  }

  /// sums[0] = sum w q, sums[1 + a] = sum q with the weight of axis a replaced by alt.
  template <int S>
  static void gather_lane(const Quad* nodes, const T (&w)[D][S], const T (&alt)[D][S],
                          Quad (&sums)[1 + D]) {
    for (Quad& s : sums) s = Quad{};
    for (int i = 0; i < S; ++i) {
      if constexpr (D == 2) {
        Quad row{};
        Quad row_1{};
        gather_row<S>(nodes + i * line_step, w[1], alt[1], row, row_1);
        sums[0] += w[0][i] * row;
        sums[1] += alt[0][i] * row;
        sums[2] += w[0][i] * row_1;
      } else {
        Quad plane{};
        Quad plane_1{};
        Quad plane_2{};
        for (int j = 0; j < S; ++j) {
          Quad row{};
          Quad row_2{};
          gather_row<S>(nodes + i * plane_step + j * line_step, w[2], alt[2], row, row_2);
          plane += w[1][j] * row;
          plane_1 += alt[1][j] * row;
          plane_2 += w[1][j] * row_2;
        }
        sums[0] += w[0][i] * plane;
        sums[1] += alt[0][i] * plane;
        sums[2] += w[0][i] * plane_1;
        sums[3] += w[0][i] * plane_2;
      }
    }
  }

  template <int S>
  static void gather_row(const Quad* nodes, const T (&w)[S], const T (&alt)[S], Quad& sum,
                         Quad& other) {
    for (int k = 0; k < S; ++k) {
      sum += w[k] * nodes[k * node_step];
      other += alt[k] * nodes[k * node_step];
    }
  }

  /// Node (i, j, k) += w_i w_j w_k q0 + alt_i w_j w_k q1 + w_i alt_j w_k q2 + w_i w_j alt_k q3.
  template <int S>
  static void scatter_lane(Quad* nodes, const T (&w)[D][S], const T (&alt)[D][S], const Quad* q) {
    for (int i = 0; i < S; ++i) {
      const Quad a = w[0][i] * q[0] + alt[0][i] * q[1];
      const Quad b = w[0][i] * q[2];
      if constexpr (D == 2) {
        Quad* row = nodes + i * line_step;
        for (int j = 0; j < S; ++j) row[j * node_step] += w[1][j] * a + alt[1][j] * b;
      } else {
        const Quad c = w[0][i] * q[3];
        for (int j = 0; j < S; ++j) {
          Quad* row = nodes + i * plane_step + j * line_step;
          const Quad ab = w[1][j] * a + alt[1][j] * b;
          const Quad cj = w[1][j] * c;
          for (int k = 0; k < S; ++k) row[k * node_step] += w[2][k] * ab + alt[2][k] * cj;
        }
      }
    }
  }
};

}  // namespace scree
