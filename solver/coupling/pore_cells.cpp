// SPDX-License-Identifier: Apache-2.0
#include "solver/coupling/pore_cells.hpp"

#include <algorithm>

namespace scree {

template <int D>
PoreCells<D>::PoreCells(const PressureLattice<D>& lattice)
    : lattice_(lattice),
      number_(std::size_t(lattice.size()), -1),
      marks_(std::size_t(lattice.size()), 0) {}

template <int D>
const std::vector<char>& PoreCells<D>::find_cells(const FlowPoints<D>& points) {
  for (const Cell& cell : cells_) {
    number_[std::size_t(lattice_.index(cell.lower))] = -1;
    for (int k = 0; k < corners; ++k) {
      marks_[std::size_t(lattice_.index(corner<D>(cell.lower, k)))] = 0;
    }
  }
  cells_.clear();
  for (const FlowPoint<D>& p : points.points) {
    std::int32_t& number = number_[std::size_t(lattice_.index(p.cell))];
    if (number >= 0) continue;
    number = std::int32_t(cells_.size());
    cells_.emplace_back();
    cells_.back().lower = p.cell;
    for (int k = 0; k < corners; ++k) {
      marks_[std::size_t(lattice_.index(corner<D>(p.cell, k)))] = 1;
    }
  }
  return marks_;
}

template <int D>
void PoreCells<D>::assemble(const FlowPoints<D>& points, double dt,
                            const std::array<double, 3>& gravity, double h) {
  for (const FlowPoint<D>& p : points.points) {
    Cell& cell = cells_[std::size_t(number_[std::size_t(lattice_.index(p.cell))])];
    double e[D][3];
    for (int a = 0; a < D; ++a) {
      const double x = p.xi[a], y = 1 - x;
      e[a][0] = y * y;
      e[a][1] = x * y;
      e[a][2] = x * x;
    }
    const double storage = p.volume * p.storage / dt;
    const double flow = p.volume * p.mobility / (h * h);
    if constexpr (D == 2) {
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) cell.storage[3 * i + j] += storage * e[0][i] * e[1][j];
        cell.flow[i] += flow * e[1][i];
        cell.flow[3 + i] += flow * e[0][i];
      }
    } else {
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
          const double ij = storage * e[0][i] * e[1][j];
          for (int k = 0; k < 3; ++k) cell.storage[9 * i + 3 * j + k] += ij * e[2][k];
          cell.flow[3 * i + j] += flow * e[1][i] * e[2][j];
          cell.flow[9 + 3 * i + j] += flow * e[0][i] * e[2][j];
          cell.flow[18 + 3 * i + j] += flow * e[0][i] * e[1][j];
        }
      }
    }
    double n[corners], slope[corners][D];
    hats<D>(p.xi, n);
    hat_slopes<D>(p.xi, slope);
    const double content = storage * p.pressure - p.biot * p.defect / dt;
    const double weight = p.volume * p.mobility * p.fluid_density / h;
    for (int k = 0; k < corners; ++k) {
      double source = content * n[k];
      for (int a = 0; a < D; ++a) source += weight * gravity[std::size_t(a)] * slope[k][a];
      cell.source[k] += source;
    }
  }
}

template <int D>
void PoreCells<D>::add(PressureMatrix<D>& matrix) const {
  int offset[corners][corners];
  for (int j = 0; j < corners; ++j) {
    for (int l = 0; l < corners; ++l) {
      offset[j][l] = matrix.offset_index(corner<D>({}, j), corner<D>({}, l));
    }
  }
  for (const Cell& cell : cells_) {
    for (int j = 0; j < corners; ++j) {
      const std::int32_t row = matrix.row(corner<D>(cell.lower, j));
      matrix.rhs()[std::size_t(row)] += cell.source[j];
      for (int l = 0; l < corners; ++l) {
        int product = 0;
        double value = 0;
        for (int a = 0; a < D; ++a) {
          const int bit = D - 1 - a;
          product = 3 * product + (j >> bit & 1) + (l >> bit & 1);
          int others = 0;
          for (int b = 0; b < D; ++b) {
            if (b != a) others = 3 * others + (j >> (D - 1 - b) & 1) + (l >> (D - 1 - b) & 1);
          }
          const double sign = (j >> bit & 1) == (l >> bit & 1) ? 1.0 : -1.0;
          value += sign * cell.flow[a * (slopes / D) + others];
        }
        matrix.add(row, offset[j][l], value + cell.storage[product]);
      }
    }
  }
}

template <int D>
std::int64_t PoreCells<D>::bytes() const {
  return std::int64_t(cells_.capacity() * sizeof(Cell) + 4 * number_.capacity() +
                      marks_.capacity());
}

template class PoreCells<2>;
template class PoreCells<3>;

}  // namespace scree
