// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "solver/coupling/pressure_lattice.hpp"

namespace scree {

/// The symmetric matrix of the pressure system and its right-hand side, on the nodes of a lattice
/// that touch water. Rows are the nodes in the lattice's order; each holds all nodes of the set at
/// most `reach` away in every axis.
template <int D>
class PressureMatrix {
 public:
  PressureMatrix(const PressureLattice<D>& lattice, int reach);

  /// Takes the nodes whose mark is set; true if the set has changed. Values are zeroed.
  bool set_nodes(const std::vector<char>& marks);

  int rows() const { return int(nodes_.size()); }
  const std::vector<std::int64_t>& nodes() const { return nodes_; }
  /// Row of a node, -1 if it is not of the set.
  std::int32_t row(const PressureNode<D>& node) const {
    return row_of_[std::size_t(lattice_.index(node))];
  }

  // Compressed rows: columns of a row ascend.
  const std::vector<std::int32_t>& row_begin() const { return row_begin_; }
  const std::vector<std::int32_t>& columns() const { return columns_; }
  const std::vector<double>& values() const { return values_; }
  std::vector<double>& rhs() { return rhs_; }
  const std::vector<double>& rhs() const { return rhs_; }

  /// Adds to the entry of row r and the node `offset` away, offset counted by offset_index().
  void add(std::int32_t r, int offset, double value) {
    const std::int32_t at = place_[std::size_t(r) * std::size_t(width_) + std::size_t(offset)];
    if (at >= 0) values_[std::size_t(at)] += value;
  }
  int offset_index(const PressureNode<D>& from, const PressureNode<D>& to) const {
    int at = 0;
    for (int a = 0; a < D; ++a) at = at * (2 * reach_ + 1) + (to[a] - from[a] + reach_);
    return at;
  }
  /// The same for any two rows; slower. Rows farther apart than the reach have no entry.
  void add_pair(std::int32_t r, std::int32_t c, double value);

  int reach() const { return reach_; }
  std::int64_t bytes() const;

 private:
  void build_pattern();

  PressureLattice<D> lattice_;
  int reach_;
  int width_;  ///< offsets of a row
  std::vector<std::int64_t> nodes_;
  std::vector<std::int32_t> row_of_;  ///< by lattice node
  std::vector<std::int32_t> row_begin_, columns_;
  std::vector<std::int32_t> place_;  ///< entry of each row and offset, -1: none
  std::vector<double> values_, rhs_;
};

extern template class PressureMatrix<2>;
extern template class PressureMatrix<3>;

}  // namespace scree
