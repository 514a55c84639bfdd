// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "postproc/project/lattice.hpp"

namespace scree {

/// Points that carry a value each, weighted by their volume.
struct WeightedPoints {
  std::vector<double> position;  ///< m, 3 a point
  std::vector<double> weight;    ///< m^3, positive; in 2D per metre
  std::size_t count() const { return weight.size(); }
};

/// What is minimised beside the distance to the points' values.
struct ProjectionTerms {
  double smoothing_length = 0;  ///< m; Helmholtz filter
  /// Weight of the jump of the gradient across the faces of cells at the edge of the body; keeps
  /// nodes that few points support from taking any value. 0: none.
  double stabilization = 0;
};

/// A part of all rows of a sparse matrix, row by row.
struct SparseRows {
  std::int64_t first = 0;              ///< row of the whole matrix that is row 0 here
  std::int64_t size = 0;               ///< rows and columns of the whole matrix
  std::vector<std::int64_t> start{0};  ///< of each row in the two arrays below, and their end
  std::vector<std::int64_t> column;
  std::vector<double> value;
  std::int64_t rows() const { return static_cast<std::int64_t>(start.size()) - 1; }
};

/// The least-squares fit of a continuous, multilinear function u to values at points,
///     sum_p V_p (u(x_p) - u_p)^2  +  l^2 sum_p V_p |grad u(x_p)|^2
///       + g h^d sum_f mean over f of (h [du/dn])^2  ->  min
/// (f: faces between two cells with points, one of which lies at the edge of all cells with points;
/// [.]: jump; Burman, C. R. Math. 348, 1217, 2010). It is solved for the nodes of cells that hold
/// points, the unknowns, numbered in the order of the lattice. Linear functions are reproduced
/// (l = 0). With l and g or without them
///     sum_p V_p u(x_p) = sum_p V_p u_p,
/// because every term but the first vanishes for constant functions.
class ProjectionSystem {
 public:
  /// Builds the rows of part `part` of `parts` equal parts. Points outside the lattice are left
  /// out and counted.
  ProjectionSystem(const Lattice& lattice, const WeightedPoints& points,
                   const ProjectionTerms& terms, int part = 0, int parts = 1);

  const SparseRows& matrix() const { return matrix_; }
  /// The lattice node of every unknown, all parts.
  const std::vector<std::int64_t>& nodes() const { return nodes_; }
  /// Whether each cell of the lattice holds points.
  const std::vector<char>& active_cells() const { return active_; }
  std::size_t outside() const { return outside_; }  ///< points beyond the lattice
  /// Whether point i lies in the lattice.
  bool inside(std::size_t point) const { return cell_of_[point] >= 0; }

  /// sum_p V_p u_p N_i(x_p) for this part's rows.
  std::vector<double> right_hand_side(const std::vector<double>& values) const;
  /// sum_p V_p N_i(x_p) of this part's rows: the volume around each node.
  std::vector<double> node_volumes() const;

 private:
  struct Assembly;
  void sort_points(const Lattice& lattice);
  void number_nodes();
  void add_points(Assembly& assembly, const ProjectionTerms& terms) const;
  void add_jumps(Assembly& assembly, double weight) const;
  void add_jump(Assembly& assembly, const std::array<std::int64_t, 3>& cell, int axis,
                double weight) const;
  bool active(const std::array<std::int64_t, 3>& cell) const;
  bool at_edge(const std::array<std::int64_t, 3>& cell) const;
  void compress(const Assembly& assembly);

  Lattice lattice_;
  const WeightedPoints& points_;
  std::vector<std::int64_t> cell_of_;  ///< of each point; -1: outside
  std::vector<std::size_t> order_;     ///< points by cell
  std::vector<std::int64_t> cells_;    ///< that hold points, ascending
  std::vector<std::size_t> first_;     ///< of each of these, in order_; and the end
  std::vector<std::int64_t> unknown_;  ///< of each lattice node; -1: none
  std::vector<std::int64_t> nodes_;
  std::vector<char> active_;  ///< of each cell
  std::size_t outside_ = 0;
  SparseRows matrix_;
};

/// The values of a function given at the lattice's nodes, at points.
double interpolate(const Lattice& lattice, const std::vector<double>& node_values,
                   const double* point);

}  // namespace scree
