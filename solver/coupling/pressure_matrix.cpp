// SPDX-License-Identifier: Apache-2.0
#include "solver/coupling/pressure_matrix.hpp"

#include <algorithm>

#include "solver/grid/block.hpp"

namespace scree {

template <int D>
PressureMatrix<D>::PressureMatrix(const PressureLattice<D>& lattice, int reach)
    : lattice_(lattice),
      reach_(reach),
      width_(power(2 * reach + 1, D)),
      row_of_(std::size_t(lattice.size()), -1),
      row_begin_(1, 0) {}

template <int D>
bool PressureMatrix<D>::set_nodes(const std::vector<char>& marks) {
  std::size_t count = 0;
  bool same = true;
  for (std::size_t i = 0; i < marks.size() && same; ++i) {
    same = (marks[i] != 0) == (row_of_[i] >= 0);
    count += marks[i] != 0;
  }
  same = same && count == nodes_.size();
  if (!same) {
    nodes_.clear();
    for (std::size_t i = 0; i < marks.size(); ++i) {
      row_of_[i] = marks[i] != 0 ? std::int32_t(nodes_.size()) : -1;
      if (marks[i] != 0) nodes_.push_back(std::int64_t(i));
    }
    build_pattern();
  }
  values_.assign(columns_.size(), 0.0);
  rhs_.assign(nodes_.size(), 0.0);
  return !same;
}

template <int D>
void PressureMatrix<D>::build_pattern() {
  row_begin_.assign(1, 0);
  columns_.clear();
  place_.assign(nodes_.size() * std::size_t(width_), -1);
  const std::size_t width = std::size_t(width_);
  std::vector<std::int32_t> near(width);
  for (std::size_t r = 0; r < nodes_.size(); ++r) {
    const PressureNode<D> node = lattice_.node(nodes_[r]);
    for (int o = 0; o < width_; ++o) {
      PressureNode<D> other = node;
      for (int a = D - 1, rest = o; a >= 0; --a, rest /= 2 * reach_ + 1) {
        other[a] += rest % (2 * reach_ + 1) - reach_;
      }
      const std::int64_t index = lattice_.index(other);
      const bool inside = index >= 0 && index < std::int64_t(row_of_.size());
      near[std::size_t(o)] = inside ? row_of_[std::size_t(index)] : -1;
    }
    // In a short periodic axis several offsets lead to the same node.
    std::vector<std::int32_t> sorted;
    for (const std::int32_t c : near) {
      if (c >= 0) sorted.push_back(c);
    }
    std::sort(sorted.begin(), sorted.end());
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    for (int o = 0; o < width_; ++o) {
      if (near[std::size_t(o)] < 0) continue;
      const auto at = std::lower_bound(sorted.begin(), sorted.end(), near[std::size_t(o)]);
      place_[r * std::size_t(width_) + std::size_t(o)] =
          row_begin_.back() + std::int32_t(at - sorted.begin());
    }
    columns_.insert(columns_.end(), sorted.begin(), sorted.end());
    row_begin_.push_back(std::int32_t(columns_.size()));
  }
}

template <int D>
void PressureMatrix<D>::add_pair(std::int32_t r, std::int32_t c, double value) {
  const auto first = columns_.begin() + row_begin_[std::size_t(r)];
  const auto last = columns_.begin() + row_begin_[std::size_t(r) + 1];
  const auto at = std::lower_bound(first, last, c);
  if (at != last && *at == c) values_[std::size_t(at - columns_.begin())] += value;
}

template <int D>
std::int64_t PressureMatrix<D>::bytes() const {
  const std::size_t whole = row_of_.capacity() + row_begin_.capacity() + columns_.capacity() +
                            place_.capacity() + 2 * nodes_.capacity();
  return std::int64_t(4 * whole + 8 * (values_.capacity() + rhs_.capacity()));
}

template class PressureMatrix<2>;
template class PressureMatrix<3>;

}  // namespace scree
