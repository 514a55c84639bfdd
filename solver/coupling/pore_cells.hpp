// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/coupling/flow_points.hpp"
#include "solver/coupling/pressure_matrix.hpp"
#include "solver/exec/thread_pool.hpp"

namespace scree {

/// Storage and flow of the water, cell by cell of the pressure lattice:
///
///     S_jl = sum_p V_p (1/M)_p N_j N_l,      H_jl = sum_p k_p int grad N_j . grad N_l,
///
/// and their right-hand sides. The integral is over the particle's box, cut exactly at the cells'
/// faces: with points alone, a surface that cuts a cell leaves a wrong share of the soil in it, and
/// the flow through the surface is wrong by that share. Where a box reaches into a cell that holds
/// no particle, the hats of the particle's own cell go on, so that no node is used that has none.
/// The storage stays with the points, like the pressure that the particles carry: a box would
/// spread it anew every step. The storage is never lumped: lumped, it is wrong by some percent of
/// the load beside a drain. Products of hats are products of quadratic polynomials an axis, of
/// which there are three; so a particle adds to 3^D moments, not to 4^D products.
template <int D>
class PoreCells {
 public:
  explicit PoreCells(const PressureLattice<D>& lattice);

  /// Marks of the nodes that the points' cells touch, by lattice node.
  const std::vector<char>& find_cells(const FlowPoints<D>& points);

  /// Moments of the points; dt [s], gravity [m/s^2], spacing of the nodes h [m].
  void assemble(const FlowPoints<D>& points, double dt, const std::array<double, 3>& gravity,
                double h);

  /// matrix += S/dt + H; rhs += S p/dt - defect/dt + weight of the water.
  void add(PressureMatrix<D>& matrix) const;

  std::int64_t bytes() const;

 private:
  static constexpr int corners = 1 << D;
  static constexpr int products = D == 2 ? 9 : 27;
  static constexpr int slopes = D == 2 ? 6 : 27;  ///< D axes, 3^(D-1) products of the others

  struct Cell {
    PressureNode<D> lower{};
    double storage[products] = {};
    double flow[slopes] = {};
    double source[corners] = {};
  };

  void add_flow(const FlowPoint<D>& point, const std::array<double, 3>& gravity, double h);

  PressureLattice<D> lattice_;
  std::vector<Cell> cells_;
  std::vector<std::int32_t> number_;  ///< of the cell with this lower node, -1: no particle
  std::vector<char> marks_;
};

extern template class PoreCells<2>;
extern template class PoreCells<3>;

}  // namespace scree
