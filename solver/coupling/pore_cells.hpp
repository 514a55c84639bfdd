// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/coupling/flow_points.hpp"
#include "solver/coupling/pressure_matrix.hpp"

namespace scree {

template <int D>
struct PoreSums;

/// An axis as the points of a pressure cell see it, in coordinates of the cell.
struct PoreAxis {
  double wall[2];      ///< infinite where there is none
  std::int32_t first;  ///< lowest cell that holds soil
  double whole[2];     ///< a box between these lies in the cell
};

/// Storage and flow of the water, cell by cell of the pressure lattice:
///
///     S_jl = sum_p V_p (1/M)_p N_j N_l,      H_jl = sum_p k_p int grad N_j . grad N_l,
///
/// and their right-hand sides. The integral is over the particle's box, cut exactly at the cells'
/// faces: with points alone, a surface that cuts a cell leaves a wrong share of the soil in it, and
/// the flow through the surface is wrong by that share. Where a box reaches into a cell that holds
/// no particle, the hats of the particle's own cell go on, so that no node is used that has none.
/// What of a box lies beyond a wall is folded back.
/// The storage stays with the points, like the pressure that the particles carry: a box would
/// spread it anew every step. The storage is never lumped: lumped, it is wrong by some percent of
/// the load beside a drain. Products of hats are products of quadratic polynomials an axis, of
/// which there are three; so a particle adds to 3^D moments, not to 4^D products.
template <int D>
class PoreCells {
 public:
  explicit PoreCells(const PressureLattice<D>& lattice);

  /// Finds the cells that hold points, which have nothing yet.
  void begin(const std::vector<FlowChunk<D>>& chunks);
  /// Marks of the nodes that these cells touch, by lattice node.
  const std::vector<char>& marks() const { return marks_; }

  /// Spacing of the nodes [m], largest half side of a box [cells].
  struct Measures {
    double h, largest_half;
  };
  /// Longest half side with which columns of one colour (FlowColumns) share no cell.
  static constexpr double longest_half = 0.75;

  /// Adds the moments of the points of a chunk, whose water has this density [kg/m^3]. Chunks of
  /// different columns of one colour may be added at the same time.
  void add(const FlowPoints<D>& points, const FlowChunk<D>& chunk, const Measures& m,
           double density);

  /// matrix += factor S.
  void add_storage(double factor, PressureMatrix<D>& matrix) const {
    add_products(factor, &storage, matrix);
  }
  /// matrix += H.
  void add_flow(PressureMatrix<D>& matrix) const { add_products(1, &conductance, matrix); }
  /// Right-hand side += S p/dt + weight of the water. p: of the points; where `nodal` is not null,
  /// by lattice node instead.
  void add_sources(double dt, const std::array<double, 3>& gravity, const double* nodal,
                   PressureMatrix<D>& matrix) const;
  /// Missed volume of the points in the hats of the nodes, by lattice node [m^3].
  std::vector<double> missed() const;

  std::int64_t bytes() const;

 private:
  static constexpr int corners = 1 << D;
  static constexpr int lines = D == 2 ? 1 : 3;  ///< of three products of the last axis, and a zero

  struct alignas(32) Cell {
    double storage[3 * lines][4] = {};
    double flow[D][lines][4] = {};  ///< by the axis of the slopes: products of the others
    double content[corners] = {}, missed[corners] = {};
    double weight[D][corners] = {};  ///< by the axis of gravity
    PressureNode<D> lower{};
  };

  /// A pressure cell and those around it, last axis fastest; -1: no particle.
  struct Surroundings {
    PressureNode<D> home;
    std::int32_t number[power(3, D)];
    PoreAxis axis[D];
  };

  static double storage(const Cell& cell, int j, int l);
  static double conductance(const Cell& cell, int j, int l);
  void add_products(double factor, double (*product)(const Cell&, int, int),
                    PressureMatrix<D>& matrix) const;
  double content(const Cell& cell, int j, const double* nodal) const;
  Surroundings surroundings(const PressureNode<D>& home) const;
  static bool near_wall(const Surroundings& around, double largest_half);
  void add_run(const FlowPoints<D>& points, const FlowRun<D>& run, const Measures& m,
               double density);
  static void take(const PoreSums<D>& sums, const Measures& m, double density, Cell& cell);
  void add_flow(const FlowPoints<D>& points, std::size_t point, const Surroundings& around,
                bool rest, double h, double density);

  PressureLattice<D> lattice_;
  AlignedVector<Cell> cells_;
  std::vector<std::int32_t> number_;  ///< of the cell with this lower node, -1: no particle
  std::vector<char> marks_;
};

extern template class PoreCells<2>;
extern template class PoreCells<3>;

}  // namespace scree
