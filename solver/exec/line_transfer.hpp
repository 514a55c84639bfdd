// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "solver/base/pack.hpp"
#include "solver/exec/row_arena.hpp"
#include "solver/exec/transpose.hpp"
#include "solver/transfer/stencil.hpp"

namespace scree {

/// Affine transfers between a batch of particles and the rows (RowArena) of one lattice with three
/// nodes an axis.
///
/// As in RowTransfer, each particle multiplies whole rows, and everything else is done with lanes =
/// particles. plane, line: numbers from a node's row to the next one's on the first axis (3D) and
/// on the last axis but one.
template <int D, class T, int stride, int plane, int line>
class LineTransfer {
 public:
  using V = RegisterLanes<T>;
  using Points = Stencil<V, D, 1, 3>;
  static constexpr int width = lanes_of<V>;

  /// velocity = sum of w v; affine = sum of w v (x_i - x_p)^T.
  static inline void gather(const T* rows, const Points& p, V (&velocity)[D], V (&affine)[D][D]) {
    alignas(64) T records[16 * width];
    alignas(64) T lanes[16 * width];
    const Weights weights(p);
    for (int l = 0; l < width; ++l) {
      const T* row = rows + weights.base[l];
      const Row z = Row::spread(weights.last + Transpose::quad_place(l));
      Row sums[D];  // sum of w v, then its moments about the lowest node on all axes but the last
      if constexpr (D == 2) {
        line_sums<line>(row, weights.other[0], l, sums);
      } else {
        gather_plane(row, weights, l, sums);
      }
      for (Row& s : sums) s = s * z;
      moments(sums).store(records + 16 * l);
    }
    Transpose::to_lanes(records, lanes);
    for (int c = 0; c < D; ++c) velocity[c] = scree::load<V>(lanes + c * width);
    for (int a = 0; a < D; ++a) {
      for (int c = 0; c < D; ++c) {
        affine[c][a] =
            mul_add(p.offset[0][a], velocity[c], scree::load<V>(lanes + (4 * (a + 1) + c) * width));
      }
    }
  }

  /// Adds w (q + A (x_i - x_p)) and mass w m for the lanes of `mask` (1 or 0) to the nodes.
  static inline void scatter(T* rows, const Points& p, const V (&q)[D], const V& mass,
                             const V (&affine)[D][D], const V& mask) {
    alignas(64) T records[(D + 1) * 4 * width];
    const Weights weights(p);
    particle_quads(p, q, mass, affine, mask > T(0), records);
    const Row numbers = Row::load(node_numbers.value);
    for (int l = 0; l < width; ++l) {
      T* row = rows + weights.base[l];
      const T* record = records + Transpose::quad_place(l);
      const auto quad = [&](int i) { return Row::repeat(record + i * 4 * width); };
      const Row z = Row::spread(weights.last + Transpose::quad_place(l));
      const Row lowest = multiply_add(quad(D), numbers, quad(0)) * z;
      const Row first_slope = quad(1) * z;
      if constexpr (D == 2) {
        add_line<line>(row, weights.other[0], l, lowest, first_slope);
      } else {
        const Row second_slope = quad(2) * z;
        Row value = lowest;
        for (int i = 0; i < 3; ++i) {
          const Row w = Row::all_of(weights.other[0][i][l]);
          add_line<line>(row + i * plane, weights.other[D - 2], l, w * value, w * second_slope);
          value = value + first_slope;
        }
      }
    }
  }

 private:
  using Row = LineRow<T>;
  using Transpose = LaneTranspose<T>;
  using Index = Scalar<IntOf<V>>;
  static constexpr int shift = stride == 4 ? 2 : stride == 8 ? 3 : 4;
  static_assert(stride == 1 << shift);
  static constexpr QuadPattern<T> node_numbers{T(0), T(1), T(2), T(0)};

  /// Weights and places where single lanes can be read.
  struct Weights {
    alignas(64) T other[D - 1][3][width];  ///< axes but the last
    alignas(64) T last[4 * width];         ///< quads {w_0, w_1, w_2, 0} of the last axis
    alignas(64) Index base[width];

    explicit Weights(const Points& p) {
      scree::store(base, p.base[0] << shift);
      for (int i = 0; i < 3; ++i) {
        for (int a = 0; a < D - 1; ++a) scree::store(&other[a][i][0], p.weight[0][a][i]);
      }
      const auto& w = p.weight[0][D - 1];
      Transpose::to_quads(w[0], w[1], w[2], broadcast<V>(T(0)), last);
    }
  };

  /// Over three rows one node apart on an axis: sums[0] = sum of w row, sums[1] = sum of n w row.
  template <int step>
  static SCREE_FN void line_sums(const T* row, const T (&w)[3][width], int l, Row* sums) {
    const Row second = Row::all_of(w[1][l]) * Row::load_line(row + step);
    const Row third = Row::all_of(w[2][l]) * Row::load_line(row + 2 * step);
    const Row both = second + third;
    sums[0] = multiply_add(Row::all_of(w[0][l]), Row::load_line(row), both);
    sums[1] = both + third;
  }

  /// 3D: sums over the nine rows, and their moments on the first and the second axis.
  static SCREE_FN void gather_plane(const T* row, const Weights& weights, int l, Row (&sums)[D]) {
    Row lines[3][2];
    SCREE_UNROLL for (int i = 0; i < 3; ++i) {
      line_sums<line>(row + i * plane, weights.other[D - 2], l, lines[i]);
    }
    const auto& w = weights.other[0];
    const Row first = Row::all_of(w[0][l]);
    const Row second = Row::all_of(w[1][l]);
    const Row third = Row::all_of(w[2][l]);
    const Row far = third * lines[2][0];
    const Row both = multiply_add(second, lines[1][0], far);
    sums[0] = multiply_add(first, lines[0][0], both);
    sums[1] = both + far;
    sums[D - 1] =
        multiply_add(first, lines[0][1], multiply_add(second, lines[1][1], third * lines[2][1]));
  }

  /// Adds value, value + slope, value + 2 slope, times their weights, to three rows one node apart.
  template <int step>
  static SCREE_FN void add_line(T* row, const T (&w)[3][width], int l, Row value,
                                const Row& slope) {
    SCREE_UNROLL for (int j = 0; j < 3; ++j) {
      multiply_add(Row::all_of(w[j][l]), value, Row::load_line(row + j * step))
          .store_line(row + j * step);
      if (j < 2) value = value + slope;
    }
  }

  /// Quads of all particles: {momentum at the lowest node, mass}, then the columns of A. Lanes
  /// outside `live` add nothing.
  static inline void particle_quads(const Points& p, const V (&q)[D], const V& mass,
                                    const V (&affine)[D][D], const MaskOf<V>& live, T* quads) {
    const V none = broadcast<V>(T(0));
    V slope[D][3];
    V lowest[3];
    for (int c = 0; c < 3; ++c) {
      lowest[c] = c < D ? select(live, q[c % D], none) : none;
      for (int a = 0; a < D; ++a) {
        slope[a][c] = c < D ? select(live, affine[c % D][a], none) : none;
        if (c < D) lowest[c] = mul_add(slope[a][c], p.offset[0][a], lowest[c]);
      }
    }
    Transpose::to_quads(lowest[0], lowest[1], lowest[2], select(live, mass, none), quads);
    for (int a = 0; a < D; ++a) {
      Transpose::to_quads(slope[a][0], slope[a][1], slope[a][2], none, quads + (a + 1) * 4 * width);
    }
  }

  /// {total, totals of the moments on all axes but the last, moment on the last axis} of rows that
  /// carry the weights of the last axis; the fourth quad of the rows is zero.
  static SCREE_FN NodeRow<T> moments(const Row (&sums)[D]) {
    if constexpr (Row::part_quads == 1) {
      NodeRow<T> out;
      for (int i = 0; i < D; ++i) {
        out.part[i] = (sums[i].part[0] + sums[i].part[2]) + sums[i].part[1];
      }
      out.part[D] = (sums[0].part[2] + sums[0].part[2]) + sums[0].part[1];
      if constexpr (D == 2) out.part[3] = out.part[D];
      return out;
    } else {
      const Row last = sums[0] * Row::load(node_numbers.value);
      const Row& third = D == 2 ? last : sums[D - 1];
      if constexpr (Row::part_quads == 2) {
        const auto fold = [](const Row& r) { return r.part[0] + r.part[1]; };
        return {{pairs_added(fold(sums[0]), fold(sums[1])), pairs_added(fold(third), fold(last))}};
      } else {
        const NodeRow<T> low = halves_added({sums[0].part[0]}, {sums[1].part[0]});
        const NodeRow<T> high = halves_added({third.part[0]}, {last.part[0]});
        return quads<0, 2, 4, 6>(low, high) + quads<1, 3, 5, 7>(low, high);
      }
    }
  }

  /// {a_0 + a_2, a_1 + a_3, b_0 + b_2, b_1 + b_3}, quads of rows of one register.
  static SCREE_FN NodeRow<T> halves_added(const NodeRow<T>& a, const NodeRow<T>& b) {
    return quads<0, 1, 4, 5>(a, b) + quads<2, 3, 6, 7>(a, b);
  }

  /// {a_0 + a_1, b_0 + b_1}, quads of registers of two.
  template <class Native>
  static SCREE_FN Native pairs_added(Native a, Native b) {
    return __builtin_shufflevector(a, b, 0, 1, 2, 3, 8, 9, 10, 11) +
           __builtin_shufflevector(a, b, 4, 5, 6, 7, 12, 13, 14, 15);
  }
};

}  // namespace scree
