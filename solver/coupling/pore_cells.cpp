// SPDX-License-Identifier: Apache-2.0
#include "solver/coupling/pore_cells.hpp"

#include <algorithm>
#include <cmath>

namespace scree {
namespace {

/// Over the part of a box within one cell, in one axis: shares of the box.
struct Slice {
  std::int32_t shift;  ///< of the cell, from the particle's
  double share;        ///< of the box's length
  double hat[2];       ///< integrals of 1 - x and x
  double product[3];   ///< of (1 - x)^2, x (1 - x) and x^2
};

/// Integrals from a to b, coordinates in the cell, over the length of the box.
Slice slice(std::int32_t shift, double a, double b, double length) {
  const double n = (b - a) / length, middle = 0.5 * (a + b);
  const double first = n * middle, second = n * (a * a + a * b + b * b) / 3;
  return {shift, n, {n - first, first}, {n - 2 * first + second, first - second, second}};
}

/// A box from xi - half to xi + half, cut at whole numbers. Thinner parts than rounding are left.
int cut(double xi, double half, Slice (&slices)[4]) {
  const double length = 2 * half, least = 1e-12;
  const double lower = xi - half, upper = xi + half;
  int count = 0;
  for (std::int32_t c = std::int32_t(std::floor(lower)); c < upper && count < 4; ++c) {
    const double a = std::max(lower - c, 0.0), b = std::min(upper - c, 1.0);
    if (b - a > least) slices[count++] = slice(c, a, b, length);
  }
  return count;
}

/// Adds the part of a box that `s` cuts out to the moments of the flow and to the source of a cell.
template <int D>
void add_part(const Slice (&s)[D], double flow, const double (&weight)[D], double* moments,
              double* source) {
  for (int i = 0; i < 3; ++i) {
    if constexpr (D == 2) {
      moments[i] += flow * s[0].share * s[1].product[i];
      moments[3 + i] += flow * s[1].share * s[0].product[i];
    } else {
      for (int j = 0; j < 3; ++j) {
        moments[3 * i + j] += flow * s[0].share * s[1].product[i] * s[2].product[j];
        moments[9 + 3 * i + j] += flow * s[1].share * s[0].product[i] * s[2].product[j];
        moments[18 + 3 * i + j] += flow * s[2].share * s[0].product[i] * s[1].product[j];
      }
    }
  }
  for (int k = 0; k < (1 << D); ++k) {
    for (int a = 0; a < D; ++a) {
      double slope = (k >> (D - 1 - a) & 1) ? s[a].share : -s[a].share;
      for (int b = 0; b < D; ++b) {
        if (b != a) slope *= s[b].hat[k >> (D - 1 - b) & 1];
      }
      source[k] += weight[a] * slope;
    }
  }
}

}  // namespace

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
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        const double ij = storage * e[0][i] * e[1][j];
        if constexpr (D == 2) {
          cell.storage[3 * i + j] += ij;
        } else {
          for (int k = 0; k < 3; ++k) cell.storage[9 * i + 3 * j + k] += ij * e[2][k];
        }
      }
    }
    double n[corners];
    hats<D>(p.xi, n);
    const double content = storage * p.pressure - p.biot * p.defect / dt;
    for (int k = 0; k < corners; ++k) cell.source[k] += content * n[k];
    add_flow(p, gravity, h);
  }
}

/// The parts of a particle's box, each in its cell.
template <int D>
void PoreCells<D>::add_flow(const FlowPoint<D>& p, const std::array<double, 3>& gravity, double h) {
  Slice slices[D][4];
  int count[D], parts = 1;
  for (int a = 0; a < D; ++a) {
    count[a] = cut(p.xi[a], p.half[a], slices[a]);
    parts *= count[a];
  }
  const double flow = p.volume * p.mobility / (h * h);
  double weight[D];
  for (int a = 0; a < D; ++a) {
    weight[a] = p.volume * p.mobility * p.fluid_density / h * gravity[std::size_t(a)];
  }
  for (int part = 0; part < parts; ++part) {
    Slice s[D];
    PressureNode<D> lower = p.cell;
    for (int a = D - 1, rest = part; a >= 0; rest /= count[a], --a) {
      s[a] = slices[a][rest % count[a]];
      lower[a] += s[a].shift;
    }
    std::int32_t number = number_[std::size_t(lattice_.index(lower))];
    if (number < 0) {
      for (int a = 0; a < D; ++a) {
        const double b = s[a].shift;
        const double from = std::max(p.xi[a] - p.half[a], b);
        s[a] = slice(0, from, std::min(p.xi[a] + p.half[a], b + 1), 2 * p.half[a]);
      }
      number = number_[std::size_t(lattice_.index(p.cell))];
    }
    Cell& cell = cells_[std::size_t(number)];
    add_part<D>(s, flow, weight, cell.flow, cell.source);
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
