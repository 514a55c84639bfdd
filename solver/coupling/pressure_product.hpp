// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "solver/base/pack.hpp"
#include "solver/coupling/pressure_action.hpp"
#include "solver/coupling/pressure_matrix.hpp"
#include "solver/exec/thread_pool.hpp"

namespace scree {

/// The matrix of the pressure system times a vector, without compressed rows.
///
/// Nodes that differ in the last axis only are a pencil. Its entries lie together, place by place
/// of the stencil and, of one place, in the order of the nodes, with zeros where the set has gaps.
/// So a product runs along the last axis in lanes, needs no column numbers, and reads of each
/// symmetric pair the one entry that there is. Each row is summed in one order, whatever the number
/// of threads.
template <int D>
class PressureProduct final : public PressureAction {
 public:
  PressureProduct(const PressureLattice<D>& lattice, int reach);

  /// Whether it serves a lattice: no axis may be periodic, where a node has several images.
  static bool serves(const PressureLattice<D>& lattice) { return !lattice.periodic(); }

  /// Must be called when the matrix's nodes have changed.
  void set_nodes(const PressureMatrix<D>& matrix);
  /// Takes the entries of the matrix.
  void set_values(PressureMatrix<D>& matrix, ThreadPool& pool);

  int rows() const override { return int(local_.size()); }
  void multiply(const double* x, double* y) const override;
  void diagonal(double* d) const override;

  std::int64_t bytes() const;

 private:
  static constexpr int width = lanes_of<Lanes<double>>;

  /// Numbers of the first node of a pencil, gaps included, seen from another one or itself.
  struct Line {
    std::int32_t number;   ///< among those in reach
    std::int32_t length;   ///< from one place of the stencil to the next
    std::int64_t node;     ///< in x_
    std::int64_t entries;  ///< in entries_, of the first place
  };
  struct Pencil {
    Line own;
    std::int32_t count;                   ///< nodes, gaps included
    std::int32_t first_row, rows;         ///< nodes of the set; rows follow each other
    std::int32_t begin_lines, end_lines;  ///< pencils in reach that have nodes
  };

  void add_pencils(const std::vector<PressureNode<D>>& nodes, int places);
  template <int reach>
  void multiply_pencil(const Pencil& pencil, double* y) const;

  PressureLattice<D> lattice_;
  int reach_;
  std::vector<Pencil> pencils_;  ///< with nodes
  std::vector<Line> lines_;
  std::vector<std::int32_t> local_;  ///< by row: its place behind the first node of its pencil
  AlignedVector<double> entries_;
  mutable AlignedVector<double> x_;  ///< pencil by pencil, zero between nodes
  ThreadPool* pool_ = nullptr;
};

extern template class PressureProduct<2>;
extern template class PressureProduct<3>;

}  // namespace scree
