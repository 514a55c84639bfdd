// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "solver/base/pack.hpp"
#include "solver/exec/node_row.hpp"
#include "solver/exec/transpose.hpp"
#include "solver/transfer/stencil.hpp"

namespace scree {

/// Affine transfers between a batch of particles and the rows (RowArena) of a dual grid: two
/// lattices, two nodes an axis, the second lattice half a cell to either side of the first.
///
/// Weights and particle quantities are worked out with lanes = particles and turned by register
/// transposes into one record a particle; each particle then multiplies whole rows, so there is
/// neither a gather nor an overlapping store.
template <int D, class T>
class RowTransfer {
 public:
  using V = Lanes<T>;
  using Points = Stencil<V, D, 2, 2>;
  static constexpr int width = lanes_of<V>;

  /// velocity = sum over both lattices of w v; affine = sum of w v (x_i - x_p)^T.
  /// plane: values from a row to the next on the first axis (3D).
  static inline void gather(const T* rows, int plane, const Points& p, V (&velocity)[D],
                            V (&affine)[D][D]) {
    alignas(64) T weights[16 * width];
    alignas(64) T records[16 * width];
    alignas(64) T lanes[16 * width];
    alignas(64) Index base[2][width];
    alignas(64) Index side[width];
    row_weights(p, weights);
    SCREE_UNROLL for (int k = 0; k < 2; ++k) scree::store(base[k], p.base[k] << 4);
    scree::store(side, side_code(p));
    for (int l = 0; l < width; ++l) {
      const Row w = Row::load(weights + 16 * l);
      const T* minus = rows + base[0][l];
      const T* plus = rows + base[1][l];
      Row moments;
      Row all_plus;
      if constexpr (D == 2) {
        const Row second = spread<1>(w) * Row::load(plus);
        moments = row_moments(multiply_add(spread<0>(w), Row::load(minus), second));
        all_plus = total(second);
      } else {
        const Row far_minus = spread<1>(w) * Row::load(minus + plane);
        const Row far_plus = spread<3>(w) * Row::load(plus + plane);
        const Row first = multiply_add(spread<0>(w), Row::load(minus), far_minus);
        const Row second = multiply_add(spread<2>(w), Row::load(plus), far_plus);
        moments = plane_moments(first + second, far_minus + far_plus);
        all_plus = total(second);
      }
      const Row shift = Row::load(half_cells.value[side[l]]);
      multiply_add(shift, all_plus, moments).store(records + 16 * l);
    }
    LaneTranspose<T>::to_lanes(records, lanes);
    for (int c = 0; c < D; ++c) velocity[c] = scree::load<V>(lanes + c * width);
    for (int a = 0; a < D; ++a) {
      for (int c = 0; c < D; ++c) {
        affine[c][a] =
            fma(p.offset[0][a], velocity[c], scree::load<V>(lanes + (4 * (a + 1) + c) * width));
      }
    }
  }

  /// Adds w (q + A (x_i - x_p)) and mass w m for the lanes of `mask` (1 or 0) to the nodes of both
  /// lattices.
  static inline void scatter(T* rows, int plane, const Points& p, const V (&q)[D], const V& mass,
                             const V (&affine)[D][D], const V& mask) {
    alignas(64) T weights[16 * width];
    alignas(64) T records[16 * width];
    alignas(64) T second[4 * width];
    alignas(64) Index base[2][width];
    row_weights(p, weights);
    SCREE_UNROLL for (int k = 0; k < 2; ++k) scree::store(base[k], p.base[k] << 4);
    particle_records(p, q, mass, affine, mask > T(0), records, second);
    const Row high = Row::load(upper_nodes.value);
    const Row odd = Row::load(odd_nodes.value);
    for (int l = 0; l < width; ++l) {
      const Row w = Row::load(weights + 16 * l);
      const T* record = records + 16 * l;
      // Slopes along the two axes of a row, the same for both lattices.
      const Row slope = multiply_add(Row::repeat(record + (D == 2 ? 4 : 8)), high,
                                     Row::repeat(record + (D == 2 ? 8 : 12)) * odd);
      const Row minus = Row::repeat(record) + slope;
      const Row plus = Row::repeat(second + 4 * l) + slope;
      add(rows + base[0][l], spread<0>(w), minus);
      if constexpr (D == 2) {
        add(rows + base[1][l], spread<1>(w), plus);
      } else {
        const Row step = Row::repeat(record + 4);
        add(rows + base[0][l] + plane, spread<1>(w), minus + step);
        add(rows + base[1][l], spread<2>(w), plus);
        add(rows + base[1][l] + plane, spread<3>(w), plus + step);
      }
    }
  }

 private:
  using Row = NodeRow<T>;
  using Index = Scalar<IntOf<V>>;

  /// For each pattern of sides: the offset of lattice 1 from lattice 0, axis a in quad a + 1.
  struct HalfCells {
    alignas(64) T value[1 << D][16];
    constexpr HalfCells() : value{} {
      for (int s = 0; s < 1 << D; ++s) {
        for (int a = 0; a < D; ++a) {
          for (int c = 0; c < 4; ++c) {
            value[s][4 * (a + 1) + c] = (s >> a & 1) != 0 ? T(0.5) : T(-0.5);
          }
        }
      }
    }
  };
  static constexpr HalfCells half_cells{};
  static constexpr QuadPattern<T> upper_nodes{T(0), T(0), T(1), T(1)};
  static constexpr QuadPattern<T> odd_nodes{T(0), T(1), T(0), T(1)};
  static constexpr QuadPattern<T> first_quad{T(1), T(0), T(0), T(0)};
  static constexpr QuadPattern<T> first_two_quads{T(1), T(1), T(0), T(0)};

  static SCREE_FN void add(T* row, const Row& weight, const Row& value) {
    multiply_add(weight, value, Row::load(row)).store(row);
  }

  /// Bit a: lattice 1 lies above lattice 0 on axis a.
  static SCREE_FN IntOf<V> side_code(const Points& p) {
    V code = broadcast<V>(T(0));
    for (int a = 0; a < D; ++a) {
      code = code +
             select(p.offset[1][a] > p.offset[0][a], broadcast<V>(T(1 << a)), broadcast<V>(T(0)));
    }
    return to_int(code);
  }

  /// Quads of node weights in the order in which rows are used: lattice, then first axis (3D).
  static inline void row_weights(const Points& p, T* records) {
    alignas(64) T lanes[16 * width];
    for (int k = 0; k < 2; ++k) {
      const auto& w = p.weight[k];
      for (int j = 0; j < 2; ++j) {
        for (int i = 0; i < 2; ++i) {
          const V cell = w[D - 2][j] * w[D - 1][i];
          const int slot = 2 * j + i;
          if constexpr (D == 2) {
            scree::store(lanes + (4 * k + slot) * width, cell);
          } else {
            scree::store(lanes + (8 * k + slot) * width, w[0][0] * cell);
            scree::store(lanes + (8 * k + 4 + slot) * width, w[0][1] * cell);
          }
        }
      }
    }
    if constexpr (D == 2) {
      for (int i = 8; i < 16; ++i) scree::store(lanes + i * width, broadcast<V>(T(0)));
    }
    LaneTranspose<T>::to_records(lanes, records);
  }

  /// records: {momentum at the lowest node of lattice 0, mass}, then the columns of A;
  /// second: {momentum at the lowest node of lattice 1, mass}. Lanes outside `live` add nothing.
  static inline void particle_records(const Points& p, const V (&q)[D], const V& mass,
                                      const V (&affine)[D][D], const MaskOf<V>& live, T* records,
                                      T* second) {
    alignas(64) T lanes[16 * width];
    alignas(64) T quad[4 * width];
    const V none = broadcast<V>(T(0));
    for (int i = 0; i < 16; ++i) scree::store(lanes + i * width, none);
    scree::store(quad + 2 * width, none);
    for (int c = 0; c < D; ++c) {
      V lowest[2] = {q[c], q[c]};
      for (int a = 0; a < D; ++a) {
        for (int k = 0; k < 2; ++k) lowest[k] = fma(affine[c][a], p.offset[k][a], lowest[k]);
        scree::store(lanes + (4 * (a + 1) + c) * width, select(live, affine[c][a], none));
      }
      scree::store(lanes + c * width, select(live, lowest[0], none));
      scree::store(quad + c * width, select(live, lowest[1], none));
    }
    scree::store(lanes + 3 * width, select(live, mass, none));
    scree::store(quad + 3 * width, select(live, mass, none));
    LaneTranspose<T>::to_records(lanes, records);
    LaneTranspose<T>::to_quads(quad, second);
  }

  /// 2D: {sum, sum over the upper nodes, sum over the odd nodes, unused} of a row.
  static SCREE_FN Row row_moments(const Row& t) {
    const Row pairs = quads<0, 2, 1, 0>(t, t) + quads<1, 3, 3, 0>(t, t);
    const Row upper = quads<2, 2, 2, 2>(t, t) + quads<3, 3, 3, 3>(t, t);
    return multiply_add(upper, Row::load(first_quad.value), pairs);
  }

  /// 3D: {sum, sum of the far row, sum over the upper nodes, sum over the odd nodes}; all: both
  /// rows, far: the row one node up on the first axis.
  static SCREE_FN Row plane_moments(const Row& all, const Row& far) {
    const Row pairs = quads<0, 4, 2, 1>(all, far) + quads<1, 5, 3, 3>(all, far);
    const Row upper = quads<2, 6, 2, 6>(all, far) + quads<3, 7, 3, 7>(all, far);
    if constexpr (Row::parts == 2) {
      return {{pairs.part[0] + upper.part[0], pairs.part[1]}};
    } else {
      return multiply_add(upper, Row::load(first_two_quads.value), pairs);
    }
  }
};

}  // namespace scree
