// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>

#include "solver/base/pack.hpp"
#include "solver/exec/node_row.hpp"
#include "solver/exec/transpose.hpp"
#include "solver/transfer/stencil.hpp"

namespace scree {

/// Affine transfers between a batch of particles and the rows (RowArena) of a dual grid: two
/// lattices, two nodes an axis, the second lattice half a cell to either side of the first.
///
/// Weights and particle quantities are worked out with lanes = particles and turned by register
/// transposes into quads of one particle each; each particle then multiplies whole rows, so there
/// is neither a gather nor an overlapping store. Particles whose quads share a register are treated
/// together, which saves shuffles.
///
/// stride, plane: numbers from a row to the next and from a node's row to the next one's on the
/// first axis (3D); line_step as in the arena.
template <int D, class T, int stride, int plane, int line_step>
class RowTransfer {
 public:
  using V = RegisterLanes<T>;
  using Points = Stencil<V, D, 2, 2>;
  static constexpr int width = lanes_of<V>;

  /// velocity = sum over both lattices of w v; affine = sum of w v (x_i - x_p)^T.
  static SCREE_FN void gather(const T* rows, const Points& p, V (&velocity)[D], V (&affine)[D][D]) {
    alignas(64) T weights[weight_rows * quads];
    alignas(64) T sums[(D + 2) * quads];
    alignas(64) Index base[2][width];
    row_weights(p, weights);
    store_places(p, base);
    for (int r = 0; r < width / together; ++r) {
      Row all[together];   // both lattices
      Row far[together];   // of these, one node up on the first axis (3D)
      Row plus[together];  // of these, lattice 1
      each_index<together>([&](auto j) __attribute__((always_inline)) {
        const int l = Transpose::quad_lane(r, j);
        const Weights<j> w{weights + r * Row::lanes};
        const T* minus_row = row_at(rows, base[0][l]);
        const T* plus_row = row_at(rows, base[1][l]);
        if constexpr (D == 2) {
          plus[j] = w.of(1) * cell(plus_row);
          all[j] = multiply_add(w.of(0), cell(minus_row), plus[j]);
        } else {
          const Row far_minus = w.of(1) * cell(minus_row + plane);
          const Row far_plus = w.of(3) * cell(plus_row + plane);
          far[j] = far_minus + far_plus;
          plus[j] = multiply_add(w.of(2), cell(plus_row), far_plus);
          all[j] = multiply_add(w.of(0), cell(minus_row), far_minus) + plus[j];
        }
      });
      store_sums(all, far, plus, sums + r * Row::lanes);
    }
    turn_moments(p, sums, velocity, affine);
  }

  /// Adds w (q + A (x_i - x_p)) and mass w m for the lanes of `mask` (1 or 0) to the nodes of both
  /// lattices.
  static SCREE_FN void scatter(T* rows, const Points& p, const V (&q)[D], const V& mass,
                               const V (&affine)[D][D], const V& mask) {
    alignas(64) T weights[weight_rows * quads];
    alignas(64) T records[(D + 2) * quads];
    alignas(64) Index base[2][width];
    row_weights(p, weights);
    store_places(p, base);
    particle_records(p, q, mass, affine, mask > T(0), records);
    const Row high = Row::load(upper_nodes.value);
    const Row odd = Row::load(odd_nodes.value);
    for (int r = 0; r < width / together; ++r) {
      each_index<together>([&](auto j) __attribute__((always_inline)) {
        const int l = Transpose::quad_lane(r, j);
        const Weights<j> w{weights + r * Row::lanes};
        const auto quad = [&](int i) __attribute__((always_inline)) {
          return Row::repeat(records + i * quads + r * Row::lanes + 4 * j);
        };
        // Slopes along the two axes of a row, the same for both lattices.
        const Row slope = multiply_add(quad(D), high, quad(D + 1) * odd);
        const Row minus = quad(0) + slope;
        const Row plus = quad(1) + slope;
        add(row_at(rows, base[0][l]), w.of(0), minus);
        if constexpr (D == 2) {
          add(row_at(rows, base[1][l]), w.of(1), plus);
        } else {
          const Row step = quad(2);
          add(row_at(rows, base[0][l]) + plane, w.of(1), minus + step);
          add(row_at(rows, base[1][l]), w.of(2), plus);
          add(row_at(rows, base[1][l]) + plane, w.of(3), plus + step);
        }
      });
    }
  }

 private:
  using Row = NodeRow<T>;
  using Index = Scalar<IntOf<V>>;
  using Transpose = LaneTranspose<T>;
  /// Places of rows in bytes: as they are used in addresses, without a shift for each.
  static constexpr int shift = std::countr_zero(unsigned(stride * sizeof(T)));
  static_assert(stride * sizeof(T) == 1u << shift);
  static SCREE_FN void store_places(const Points& p, Index (&base)[2][width]) {
    SCREE_UNROLL for (int k = 0; k < 2; ++k) scree::store(base[k], p.base[k] << shift);
  }
  static SCREE_FN const T* row_at(const T* rows, Index place) {
    return reinterpret_cast<const T*>(reinterpret_cast<const char*>(rows) + place);
  }
  static SCREE_FN T* row_at(T* rows, Index place) {
    return reinterpret_cast<T*>(reinterpret_cast<char*>(rows) + place);
  }

  static constexpr int together = Row::part_quads;  ///< particles whose quads share a register
  static constexpr int quads = 4 * width;           ///< numbers of one quad of all particles
  static constexpr int weight_rows = D == 2 ? 2 : 4;

  /// The node weights of the particle with the j-th quads of a register: one quad a row.
  template <int j>
  struct Weights {
    const T* first;
    /// The weights of the row used at place `row`, for whole quads.
    SCREE_FN Row of(int row) const { return Row::template spread<j>(first + row * quads); }
  };

  static constexpr QuadPattern<T> upper_nodes{T(0), T(0), T(1), T(1)};
  static constexpr QuadPattern<T> odd_nodes{T(0), T(1), T(0), T(1)};

  static SCREE_FN Row cell(const T* row) { return Row::load_cell(row, line_step); }
  static SCREE_FN void add(T* row, const Row& weight, const Row& value) {
    multiply_add(weight, value, cell(row)).store_cell(row, line_step);
  }

  /// Quads of node weights in the order in which rows are used: lattice, then first axis (3D).
  static SCREE_FN void row_weights(const Points& p, T* weights) {
    for (int k = 0; k < 2; ++k) {
      const auto& w = p.weight[k];
      V cell[4];
      for (int i = 0; i < 4; ++i) cell[i] = w[D - 2][i / 2] * w[D - 1][i % 2];
      if constexpr (D == 2) {
        Transpose::to_quads(cell[0], cell[1], cell[2], cell[3], weights + k * quads);
      } else {
        for (int i = 0; i < 2; ++i) {
          const V& first = w[0][i];
          Transpose::to_quads(first * cell[0], first * cell[1], first * cell[2], first * cell[3],
                              weights + (2 * k + i) * quads);
        }
      }
    }
  }

  /// Sums over the nodes of the rows: {all, plus, moments on each axis}, quads of `together`
  /// particles side by side.
  static SCREE_FN void store_sums(const Row (&all)[together], const Row (&far)[together],
                                  const Row (&plus)[together], T* sums) {
    typename Row::Native node[4];
    node_quads(all, node);
    const auto upper = node[2] + node[3];
    Row::store_part(sums, upper + (node[0] + node[1]));
    Row::store_part(sums + quads, totals(plus));
    if constexpr (D == 3) Row::store_part(sums + 2 * quads, totals(far));
    Row::store_part(sums + D * quads, upper);
    Row::store_part(sums + (D + 1) * quads, node[1] + node[3]);
  }

  /// Velocity and affine matrix from the sums.
  static SCREE_FN void turn_moments(const Points& p, const T* sums, V (&velocity)[D],
                                    V (&affine)[D][D]) {
    V value[3];
    V plus[3];
    Transpose::from_quads(sums, value[0], value[1], value[2]);
    Transpose::from_quads(sums + quads, plus[0], plus[1], plus[2]);
    for (int c = 0; c < D; ++c) velocity[c] = value[c];
    for (int a = 0; a < D; ++a) {
      const V apart = p.offset[1][a] - p.offset[0][a];
      V moment[3];
      Transpose::from_quads(sums + (2 + a) * quads, moment[0], moment[1], moment[2]);
      for (int c = 0; c < D; ++c) {
        affine[c][a] = mul_add(apart, plus[c], mul_add(p.offset[0][a], value[c], moment[c]));
      }
    }
  }

  /// Quads of all particles: {momentum at the lowest node of lattice 0, mass}, the same for
  /// lattice 1, then the columns of A. Lanes outside `live` add nothing.
  static SCREE_FN void particle_records(const Points& p, const V (&q)[D], const V& mass,
                                        const V (&affine)[D][D], const MaskOf<V>& live,
                                        T* records) {
    const V none = broadcast<V>(T(0));
    V slope[D][3];
    V lowest[2][3];
    for (int c = 0; c < 3; ++c) {
      for (int a = 0; a < D; ++a) slope[a][c] = c < D ? select(live, affine[c % D][a], none) : none;
      for (int k = 0; k < 2; ++k) {
        lowest[k][c] = c < D ? select(live, q[c % D], none) : none;
        for (int a = 0; a < D && c < D; ++a) {
          lowest[k][c] = mul_add(slope[a][c], p.offset[k][a], lowest[k][c]);
        }
      }
    }
    const V some = select(live, mass, none);
    for (int k = 0; k < 2; ++k) {
      Transpose::to_quads(lowest[k][0], lowest[k][1], lowest[k][2], some, records + k * quads);
    }
    for (int a = 0; a < D; ++a) {
      Transpose::to_quads(slope[a][0], slope[a][1], slope[a][2], none, records + (2 + a) * quads);
    }
  }
};

}  // namespace scree
