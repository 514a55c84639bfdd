// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "solver/coupling/pressure_lattice.hpp"
#include "solver/exec/aligned.hpp"

namespace scree {

/// The symmetric matrix of the pressure system and its right-hand side, on the nodes of a lattice
/// that touch water. Rows are the nodes in the lattice's order; each holds all nodes of the set at
/// most `reach` away in every axis.
///
/// It is summed up in a stencil of fixed shape: each row has a place for itself and every node
/// that comes after it in its neighbourhood, whether of the set or not. finish() makes compressed
/// rows of it.
template <int D>
class PressureMatrix {
 public:
  PressureMatrix(const PressureLattice<D>& lattice, int reach);

  /// Takes the nodes whose mark is set; true if the set has changed. The right-hand side is zeroed,
  /// and the stencils' values are of no use. compress: compressed rows and finish() will be asked
  /// for.
  bool set_nodes(const std::vector<char>& marks, bool compress);

  int rows() const { return int(nodes_.size()); }
  const std::vector<std::int64_t>& nodes() const { return nodes_; }
  /// Row of a node, -1 if it is not of the set.
  std::int32_t row(const PressureNode<D>& node) const { return row_at(lattice_.index(node)); }
  /// Row of a lattice node by its number.
  std::int32_t row_at(std::int64_t index) const { return row_of_[std::size_t(index)]; }

  // Compressed rows: columns of a row ascend.
  const std::vector<std::int32_t>& row_begin() const { return row_begin_; }
  const std::vector<std::int32_t>& columns() const { return columns_; }
  /// Valid after finish().
  const std::vector<double>& values() const { return values_; }
  std::vector<double>& rhs() { return rhs_; }
  const std::vector<double>& rhs() const { return rhs_; }

  /// Number of the offset between two nodes, in the order of the lattice.
  int offset_index(const PressureNode<D>& from, const PressureNode<D>& to) const {
    int at = 0;
    for (int a = 0; a < D; ++a) at = at * (2 * reach_ + 1) + (to[a] - from[a] + reach_);
    return at;
  }
  /// Adds to the entry of row r and the node `offset` away, and to the entry that mirrors it.
  /// Offsets that lead back in the order of the lattice are left out: the same pair comes from the
  /// other side.
  void add(std::int32_t r, int offset, double value) {
    if (offset >= centre_) stencil(r)[offset - centre_] += value;
  }
  /// The places of row r from the offset to itself on, which has the number centre().
  double* stencil(std::int32_t r) {
    return half_.data() + std::size_t(r) * std::size_t(centre_ + 1);
  }
  int centre() const { return centre_; }
  /// The stencils of all rows.
  AlignedVector<double>& stencils() { return half_; }
  /// Zeroes them.
  void clear() { half_.assign(half_.size(), 0.0); }

  /// Fills values().
  void finish();

  int reach() const { return reach_; }
  std::int64_t bytes() const;

 private:
  void build_pattern();

  PressureLattice<D> lattice_;
  int reach_;
  int width_;   ///< offsets of a row
  int centre_;  ///< number of the offset zero
  std::vector<std::int64_t> nodes_;
  std::vector<std::int32_t> row_of_;  ///< by lattice node
  std::vector<std::int32_t> row_begin_, columns_;
  std::vector<std::int32_t> source_;  ///< of each entry, in half_
  /// Further sources of entries: in a short periodic axis several offsets lead to one node.
  std::vector<std::pair<std::int32_t, std::int32_t>> further_;
  AlignedVector<double> half_;
  std::vector<double> values_, rhs_;
};

extern template class PressureMatrix<2>;
extern template class PressureMatrix<3>;

}  // namespace scree
