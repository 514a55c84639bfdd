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
      centre_(width_ / 2),
      row_of_(std::size_t(lattice.size()), -1),
      row_begin_(1, 0) {}

template <int D>
bool PressureMatrix<D>::set_nodes(const std::vector<char>& marks, bool compress) {
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
    if (compress) build_pattern();
  }
  half_.resize(nodes_.size() * std::size_t(centre_ + 1));
  values_.resize(columns_.size());
  rhs_.assign(nodes_.size(), 0.0);
  return !same;
}

template <int D>
void PressureMatrix<D>::build_pattern() {
  row_begin_.assign(1, 0);
  columns_.clear();
  source_.clear();
  further_.clear();
  std::vector<std::pair<std::int32_t, std::int32_t>> near;  // row, source
  for (std::size_t r = 0; r < nodes_.size(); ++r) {
    const PressureNode<D> node = lattice_.node(nodes_[r]);
    near.clear();
    for (int o = 0; o < width_; ++o) {
      PressureNode<D> other = node;
      for (int a = D - 1, rest = o; a >= 0; --a, rest /= 2 * reach_ + 1) {
        other[a] += rest % (2 * reach_ + 1) - reach_;
      }
      const std::int64_t index = lattice_.index(other);
      const bool inside = index >= 0 && index < std::int64_t(row_of_.size());
      const std::int32_t c = inside ? row_of_[std::size_t(index)] : -1;
      if (c < 0) continue;
      const std::int32_t from = o >= centre_ ? std::int32_t(r) : c;
      near.emplace_back(c, from * (centre_ + 1) + std::abs(o - centre_));
    }
    std::stable_sort(near.begin(), near.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t i = 0; i < near.size(); ++i) {
      if (i > 0 && near[i].first == near[i - 1].first) {
        further_.emplace_back(std::int32_t(columns_.size()) - 1, near[i].second);
        continue;
      }
      columns_.push_back(near[i].first);
      source_.push_back(near[i].second);
    }
    row_begin_.push_back(std::int32_t(columns_.size()));
  }
}

template <int D>
void PressureMatrix<D>::finish() {
  for (std::size_t i = 0; i < source_.size(); ++i) values_[i] = half_[std::size_t(source_[i])];
  for (const auto& [entry, source] : further_) {
    values_[std::size_t(entry)] += half_[std::size_t(source)];
  }
}

template <int D>
std::int64_t PressureMatrix<D>::bytes() const {
  const std::size_t whole = row_of_.capacity() + row_begin_.capacity() + columns_.capacity() +
                            source_.capacity() + 2 * nodes_.capacity() + 2 * further_.capacity();
  return std::int64_t(4 * whole + 8 * (values_.capacity() + rhs_.capacity() + half_.capacity()));
}

template class PressureMatrix<2>;
template class PressureMatrix<3>;

}  // namespace scree
