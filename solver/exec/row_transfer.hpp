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
///
/// stride, plane: numbers from a row to the next and from a node's row to the next one's on the
/// first axis (3D); line_step as in the arena.
template <int D, class T, int stride, int plane, int line_step>
class RowTransfer {
 public:
  using V = Lanes<T>;
  using Points = Stencil<V, D, 2, 2>;
  static constexpr int width = lanes_of<V>;

  /// velocity = sum over both lattices of w v; affine = sum of w v (x_i - x_p)^T.
  static inline void gather(const T* rows, const Points& p, V (&velocity)[D], V (&affine)[D][D]) {
    alignas(64) T weights[Weights::count * 4 * width];
    alignas(64) T records[16 * width];
    alignas(64) T lanes[16 * width];
    alignas(64) Index base[2][width];
    alignas(64) Index side[width];
    row_weights(p, weights);
    SCREE_UNROLL for (int k = 0; k < 2; ++k) scree::store(base[k], p.base[k] << shift);
    scree::store(side, side_code(p));
    for (int l = 0; l < width; ++l) {
      const Weights w{weights + quad_places.value[l]};
      const T* minus = rows + base[0][l];
      const T* plus = rows + base[1][l];
      Row moments;
      Row all_plus;
      if constexpr (D == 2) {
        const Row second = w.of(1) * cell(plus);
        moments = row_moments(multiply_add(w.of(0), cell(minus), second));
        all_plus = total(second);
      } else {
        const Row far_minus = w.of(1) * cell(minus + plane);
        const Row far_plus = w.of(3) * cell(plus + plane);
        const Row first = multiply_add(w.of(0), cell(minus), far_minus);
        const Row second = multiply_add(w.of(2), cell(plus), far_plus);
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
            mul_add(p.offset[0][a], velocity[c], scree::load<V>(lanes + (4 * (a + 1) + c) * width));
      }
    }
  }

  /// Adds w (q + A (x_i - x_p)) and mass w m for the lanes of `mask` (1 or 0) to the nodes of both
  /// lattices.
  static inline void scatter(T* rows, const Points& p, const V (&q)[D], const V& mass,
                             const V (&affine)[D][D], const V& mask) {
    alignas(64) T weights[Weights::count * 4 * width];
    alignas(64) T records[(D + 2) * 4 * width];
    alignas(64) Index base[2][width];
    row_weights(p, weights);
    SCREE_UNROLL for (int k = 0; k < 2; ++k) scree::store(base[k], p.base[k] << shift);
    particle_records(p, q, mass, affine, mask > T(0), records);
    const Row high = Row::load(upper_nodes.value);
    const Row odd = Row::load(odd_nodes.value);
    for (int l = 0; l < width; ++l) {
      const Weights w{weights + quad_places.value[l]};
      const T* record = records + quad_places.value[l];
      const auto quad = [&](int i) { return Row::repeat(record + i * 4 * width); };
      // Slopes along the two axes of a row, the same for both lattices.
      const Row slope = multiply_add(quad(D), high, quad(D + 1) * odd);
      const Row minus = quad(0) + slope;
      const Row plus = quad(1) + slope;
      add(rows + base[0][l], w.of(0), minus);
      if constexpr (D == 2) {
        add(rows + base[1][l], w.of(1), plus);
      } else {
        const Row step = quad(2);
        add(rows + base[0][l] + plane, w.of(1), minus + step);
        add(rows + base[1][l], w.of(2), plus);
        add(rows + base[1][l] + plane, w.of(3), plus + step);
      }
    }
  }

 private:
  using Row = NodeRow<T>;
  using Index = Scalar<IntOf<V>>;
  using Transpose = LaneTranspose<T>;
  static constexpr int shift = stride == 4 ? 2 : stride == 8 ? 3 : 4;
  static_assert(stride == 1 << shift);

  /// One particle's node weights: one quad a row, the quads of all particles one behind the other.
  struct Weights {
    static constexpr int count = D == 2 ? 2 : 4;
    const T* first;
    /// The weights of the row used at place `row`, for whole quads.
    SCREE_FN Row of(int row) const { return Row::spread(first + row * 4 * width); }
  };

  struct QuadPlaces {
    int value[width];
    constexpr QuadPlaces() : value{} {
      for (int l = 0; l < width; ++l) value[l] = Transpose::quad_place(l);
    }
  };
  static constexpr QuadPlaces quad_places{};

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

  static SCREE_FN Row cell(const T* row) { return Row::load_cell(row, line_step); }
  static SCREE_FN void add(T* row, const Row& weight, const Row& value) {
    multiply_add(weight, value, cell(row)).store_cell(row, line_step);
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
  static inline void row_weights(const Points& p, T* quads) {
    alignas(64) T lanes[Weights::count * 4 * width];
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
    for (int r = 0; r < Weights::count; ++r) {
      Transpose::to_quads(lanes + r * 4 * width, quads + r * 4 * width);
    }
  }

  /// Quads of all particles: {momentum at the lowest node of lattice 0, mass}, the same for
  /// lattice 1, then the columns of A. Lanes outside `live` add nothing.
  static inline void particle_records(const Points& p, const V (&q)[D], const V& mass,
                                      const V (&affine)[D][D], const MaskOf<V>& live, T* records) {
    alignas(64) T lanes[(D + 2) * 4 * width];
    const V none = broadcast<V>(T(0));
    for (int i = 0; i < D + 2; ++i) {
      const V last = i < 2 ? select(live, mass, none) : none;
      scree::store(lanes + (4 * i + 3) * width, last);
      if constexpr (D == 2) scree::store(lanes + (4 * i + 2) * width, none);
    }
    for (int c = 0; c < D; ++c) {
      V lowest[2] = {q[c], q[c]};
      for (int a = 0; a < D; ++a) {
        for (int k = 0; k < 2; ++k) lowest[k] = mul_add(affine[c][a], p.offset[k][a], lowest[k]);
        scree::store(lanes + (4 * (a + 2) + c) * width, select(live, affine[c][a], none));
      }
      for (int k = 0; k < 2; ++k) {
        scree::store(lanes + (4 * k + c) * width, select(live, lowest[k], none));
      }
    }
    for (int i = 0; i < D + 2; ++i) {
      Transpose::to_quads(lanes + i * 4 * width, records + i * 4 * width);
    }
  }

  /// 2D: {sum, sum over the upper nodes, sum over the odd nodes, unused} of a row.
  static SCREE_FN Row row_moments(const Row& t) {
    if constexpr (Row::parts == 4) {
      const auto upper = t.part[2] + t.part[3];
      return {{upper + (t.part[0] + t.part[1]), upper, t.part[1] + t.part[3], upper}};
    } else {
      const Row pairs = quads<0, 2, 1, 0>(t, t) + quads<1, 3, 3, 0>(t, t);
      const Row upper = quads<2, 2, 2, 2>(t, t) + quads<3, 3, 3, 3>(t, t);
      return multiply_add(upper, Row::load(first_quad.value), pairs);
    }
  }

  /// 3D: {sum, sum of the far row, sum over the upper nodes, sum over the odd nodes}; all: both
  /// rows, far: the row one node up on the first axis.
  static SCREE_FN Row plane_moments(const Row& all, const Row& far) {
    if constexpr (Row::parts == 4) {
      const auto& a = all.part;
      const auto& f = far.part;
      const auto upper = a[2] + a[3];
      return {{(a[0] + a[1]) + upper, (f[0] + f[1]) + (f[2] + f[3]), upper, a[1] + a[3]}};
    } else {
      const Row pairs = quads<0, 4, 2, 1>(all, far) + quads<1, 5, 3, 3>(all, far);
      const Row upper = quads<2, 6, 2, 6>(all, far) + quads<3, 7, 3, 7>(all, far);
      if constexpr (Row::parts == 2) {
        return {{pairs.part[0] + upper.part[0], pairs.part[1]}};
      } else {
        return multiply_add(upper, Row::load(first_two_quads.value), pairs);
      }
    }
  }
};

}  // namespace scree
