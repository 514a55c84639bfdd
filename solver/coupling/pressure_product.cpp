// SPDX-License-Identifier: Apache-2.0
#include "solver/coupling/pressure_product.hpp"

#include <algorithm>
#include <utility>

#include "solver/coupling/load_any.hpp"
#include "solver/grid/block.hpp"

namespace scree {
namespace {

using Wide = Lanes<double>;

/// The box of pencils around the nodes, in all axes but the last, and what each of them reaches.
template <int D>
struct PencilBox {
  std::array<std::int32_t, D> lower{}, extent{};
  std::vector<std::int32_t> first, last;  ///< own nodes; first > last: none
  std::int64_t size = 1;

  PencilBox(const std::vector<PressureNode<D>>& nodes, int reach) {
    std::array<std::int32_t, D> upper{};
    for (std::size_t a = 0; a + 1 < D; ++a) {
      const auto less = [a](const auto& m, const auto& n) { return m[a] < n[a]; };
      lower[a] = (*std::min_element(nodes.begin(), nodes.end(), less))[a] - reach;
      upper[a] = (*std::max_element(nodes.begin(), nodes.end(), less))[a] + reach;
      extent[a] = upper[a] - lower[a] + 1;
      size *= extent[a];
    }
    first.assign(std::size_t(size), 1);
    last.assign(std::size_t(size), 0);
    for (const PressureNode<D>& node : nodes) {
      const std::size_t p = std::size_t(number(node));
      const std::int32_t z = node[D - 1];
      const bool empty = first[p] > last[p];
      first[p] = empty ? z : std::min(first[p], z);
      last[p] = empty ? z : std::max(last[p], z);
    }
  }
  std::int64_t number(const PressureNode<D>& node) const {
    std::int64_t at = 0;
    for (std::size_t a = 0; a + 1 < D; ++a) at = at * extent[a] + node[a] - lower[a];
    return at;
  }
  bool has_nodes(std::int64_t p) const { return first[std::size_t(p)] <= last[std::size_t(p)]; }
  /// First and last node of a pencil and those in its reach.
  std::pair<std::int32_t, std::int32_t> nodes_in_reach(std::int64_t p, int reach) const {
    std::pair<std::int32_t, std::int32_t> ends{first[std::size_t(p)], last[std::size_t(p)]};
    for (int m = 0; m < power(2 * reach + 1, D - 1); ++m) {
      const std::int64_t q = p + step(m, reach);
      if (!has_nodes(q)) continue;
      ends.first = std::min(ends.first, first[std::size_t(q)]);
      ends.second = std::max(ends.second, last[std::size_t(q)]);
    }
    return ends;
  }
  /// Numbers from a pencil to line m of those in reach.
  std::int64_t step(int m, int reach) const {
    std::int64_t at = 0, stride = 1;
    for (int a = D - 2; a >= 0; --a, m /= 2 * reach + 1) {
      at += stride * (m % (2 * reach + 1) - reach);
      stride *= extent[std::size_t(a)];
    }
    return at;
  }
};

}  // namespace

template <int D>
PressureProduct<D>::PressureProduct(const PressureLattice<D>& lattice, int reach)
    : lattice_(lattice), reach_(reach) {}

template <int D>
void PressureProduct<D>::set_nodes(const PressureMatrix<D>& matrix) {
  std::vector<PressureNode<D>> nodes;
  nodes.reserve(matrix.nodes().size());
  for (const std::int64_t index : matrix.nodes()) nodes.push_back(lattice_.node(index));
  pencils_.clear();
  lines_.clear();
  local_.clear();
  if (!nodes.empty()) add_pencils(nodes, matrix.centre() + 1);
}

/// A pencil has room for all nodes that its neighbours reach, and for a vector behind them.
template <int D>
void PressureProduct<D>::add_pencils(const std::vector<PressureNode<D>>& nodes, int places) {
  const PencilBox<D> box(nodes, reach_);
  const int in_reach = power(2 * reach_ + 1, D - 1);
  std::vector<Line> origin(std::size_t(box.size));  // of node 0 of the last axis
  std::int64_t numbers = 0, entries = 0;
  for (std::int64_t p = 0; p < box.size; ++p) {
    if (!box.has_nodes(p)) continue;
    const auto [low, high] = box.nodes_in_reach(p, reach_);
    const std::int32_t length = high - low + 1 + 2 * reach_ + width;
    origin[std::size_t(p)] = {0, length, numbers + reach_ - low, entries + reach_ - low};
    numbers += length;
    entries += std::int64_t(length) * places;
  }
  entries_.assign(std::size_t(entries), 0.0);
  x_.assign(std::size_t(numbers), 0.0);
  const auto seen_from = [&](std::int32_t z, std::int64_t p, int m) {
    Line line = origin[std::size_t(p)];
    line.number = m;
    line.node += z;
    line.entries += z;
    return line;
  };
  for (std::size_t r = 0; r < nodes.size(); ++r) {
    const std::int64_t p = box.number(nodes[r]);
    const std::int32_t first = box.first[std::size_t(p)], z = nodes[r][D - 1];
    if (z == first) {
      const std::int32_t begin = std::int32_t(lines_.size());
      for (int m = 0; m < in_reach; ++m) {
        const std::int64_t q = p + box.step(m, reach_);
        if (box.has_nodes(q)) lines_.push_back(seen_from(first, q, m));
      }
      pencils_.push_back({seen_from(first, p, in_reach / 2), box.last[std::size_t(p)] - first + 1,
                          std::int32_t(r), 0, begin, std::int32_t(lines_.size())});
    }
    local_.push_back(z - first);
    ++pencils_.back().rows;
  }
}

template <int D>
void PressureProduct<D>::set_values(PressureMatrix<D>& matrix, ThreadPool& pool) {
  pool_ = &pool;
  const int places = matrix.centre() + 1;
  const auto take = [&](std::int64_t number, int) {
    const Pencil& pencil = pencils_[std::size_t(number)];
    for (std::int32_t r = pencil.first_row; r < pencil.first_row + pencil.rows; ++r) {
      const double* from = matrix.stencil(r);
      double* to = entries_.data() + pencil.own.entries + local_[std::size_t(r)];
      for (int k = 0; k < places; ++k) to[std::int64_t(k) * pencil.own.length] = from[k];
    }
  };
  pool.for_each(std::int64_t(pencils_.size()), take, 8);
}

template <int D>
void PressureProduct<D>::multiply(const double* x, double* y) const {
  for (const Pencil& pencil : pencils_) {
    double* to = x_.data() + pencil.own.node;
    for (std::int32_t r = pencil.first_row; r < pencil.first_row + pencil.rows; ++r) {
      to[local_[std::size_t(r)]] = x[r];
    }
  }
  pool_->for_each(
      std::int64_t(pencils_.size()),
      [&](std::int64_t number, int) {
        const Pencil& pencil = pencils_[std::size_t(number)];
        if (reach_ == 2) {
          multiply_pencil<2>(pencil, y);
        } else {
          multiply_pencil<3>(pencil, y);
        }
      },
      16);
}

/// Entries before the centre are those of the node they lead to, after it those of the row.
template <int D>
template <int reach>
void PressureProduct<D>::multiply_pencil(const Pencil& pencil, double* y) const {
  constexpr int axis = 2 * reach + 1, middle = power(axis, D - 1) / 2;
  constexpr int centre = middle * axis + reach;
  constexpr int chains = 4;  // of sums that do not wait for each other
  const std::int64_t length = pencil.own.length;
  const std::int32_t end = pencil.first_row + pencil.rows;
  std::int32_t r = pencil.first_row;
  for (std::int32_t n = 0; n < pencil.count; n += width) {
    Wide sum[chains];
    for (Wide& s : sum) s = broadcast<Wide>(0.0);
    const auto add = [&](const double* entry, const double* x, int z) {
      Wide& s = sum[z % chains];
      s = mul_add(load_any<Wide>(entry), load_any<Wide>(x), s);
    };
    for (std::int32_t l = pencil.begin_lines; l < pencil.end_lines; ++l) {
      const Line& line = lines_[std::size_t(l)];
      const int k = line.number * axis;  // place of the line's first node
      const double* x = x_.data() + line.node + n - reach;
      const double* before =
          entries_.data() + line.entries + n - reach + std::int64_t(centre - k) * line.length;
      const double* after =
          entries_.data() + pencil.own.entries + n + std::int64_t(k - centre) * length;
      if (line.number < middle) {
        SCREE_UNROLL for (int z = 0; z < axis; ++z) add(before - z * (line.length - 1), x + z, z);
      } else if (line.number > middle) {
        SCREE_UNROLL for (int z = 0; z < axis; ++z) add(after + z * length, x + z, z);
      } else {
        SCREE_UNROLL for (int z = 0; z < axis; ++z) {
          add(z < reach ? before - z * (length - 1) : after + z * length, x + z, z);
        }
      }
    }
    alignas(64) double sums[width];
    store(sums, (sum[0] + sum[1]) + (sum[2] + sum[3]));
    for (; r < end && local_[std::size_t(r)] < n + width; ++r) {
      y[r] = sums[local_[std::size_t(r)] - n];
    }
  }
}

template <int D>
void PressureProduct<D>::diagonal(double* d) const {
  for (const Pencil& pencil : pencils_) {
    const double* from = entries_.data() + pencil.own.entries;
    for (std::int32_t r = pencil.first_row; r < pencil.first_row + pencil.rows; ++r) {
      d[r] = from[local_[std::size_t(r)]];
    }
  }
}

template <int D>
std::int64_t PressureProduct<D>::bytes() const {
  return std::int64_t(8 * (entries_.capacity() + x_.capacity()) + 4 * local_.capacity() +
                      sizeof(Pencil) * pencils_.capacity() + sizeof(Line) * lines_.capacity());
}

template class PressureProduct<2>;
template class PressureProduct<3>;

}  // namespace scree
