// SPDX-License-Identifier: Apache-2.0
#include "solver/coupling/pore_cells.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "solver/coupling/box_slices.hpp"
#include "solver/coupling/load_any.hpp"

namespace scree {
namespace {

using Wide = Lanes<double>;
constexpr int width = lanes_of<Wide>;

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
  for (const FlowChunk<D>& chunk : points.chunks) {
    for (const FlowRun<D>& run : chunk.runs) {
      std::int32_t& number = number_[std::size_t(lattice_.index(run.cell))];
      if (number >= 0) continue;
      number = std::int32_t(cells_.size());
      cells_.emplace_back();
      cells_.back().lower = run.cell;
      for (int k = 0; k < corners; ++k) {
        marks_[std::size_t(lattice_.index(corner<D>(run.cell, k)))] = 1;
      }
    }
  }
  return marks_;
}

template <int D>
void PoreCells<D>::assemble(const FlowPoints<D>& points, double dt, double h,
                            const std::vector<Weight>& weight, double largest_half,
                            ThreadPool& pool) {
  // Blocks of one colour share no cell as long as no box is longer than one and a half; cells
  // beyond a periodic face are those within the other, whatever the colours.
  constexpr double longest = 0.75;
  const bool alone = largest_half > longest || lattice_.periodic();
  for (std::size_t body = 0; body < weight.size(); ++body) {
    for (std::int32_t colour = 0; colour < (1 << D); ++colour) {
      std::vector<const FlowChunk<D>*> together;
      for (const FlowChunk<D>& chunk : points.chunks) {
        if (chunk.body == std::int32_t(body) && chunk.colour == colour) together.push_back(&chunk);
      }
      const auto add_chunk = [&](std::int64_t c, int) {
        for (const FlowRun<D>& run : together[std::size_t(c)]->runs) {
          add_run(points, run, dt, h, weight[body]);
        }
      };
      if (!alone) pool.for_each(std::int64_t(together.size()), add_chunk);
      for (std::size_t c = 0; c < together.size() && alone; ++c) add_chunk(std::int64_t(c), 0);
    }
  }
}

template <int D>
auto PoreCells<D>::surroundings(const PressureNode<D>& home) const -> Surroundings {
  Surroundings around;
  around.home = home;
  for (int n = 0; n < power(3, D); ++n) {
    PressureNode<D> cell = home;
    for (int a = D - 1, rest = n; a >= 0; --a, rest /= 3) cell[std::size_t(a)] += rest % 3 - 1;
    around.number[n] = number_[std::size_t(lattice_.index(cell))];
  }
  return around;
}

template <int D>
// NOLINTNEXTLINE(readability-function-size): a kernel's body
void PoreCells<D>::add_run(const FlowPoints<D>& points, const FlowRun<D>& run, double dt, double h,
                           const Weight& weight) {
  const Surroundings around = surroundings(run.cell);
  LaneSums<D> sums;
  const auto field = [](const AlignedVector<double>& values, std::int64_t first) {
    return load_any<Wide>(values.data() + first);
  };
  for (std::int64_t first = run.begin; first < run.end; first += width) {
    const auto some = first_lanes<Wide>(int(std::min<std::int64_t>(run.end - first, width)));
    Wide xi[D];
    LaneSlice slices[D];
    auto cut = some & !some, simple = some;
    for (std::size_t a = 0; a < D; ++a) {
      xi[a] = select(some, field(points.xi[a], first), 0.5);
      const Wide half = select(some, field(points.half[a], first), 0.25);
      slices[a] = own_slice(xi[a], half);
      cut = cut | (slices[a].cut & some);
      simple = simple & (half <= 0.5);  // no box reaches beyond both sides of its cell
    }
    cut = cut | (some & !simple);
    sums.add_storage(xi, select(some, field(points.capacity, first) * (1 / dt), 0.0),
                     select(some, field(points.content, first) * (1 / dt), 0.0));
    const Wide conductance =
        select(simple, field(points.volume, first) * field(points.mobility, first) * (1 / h), 0.0);
    sums.add_flow(slices, conductance * (1 / h));
    for (int a = 0; a < D; ++a) {
      const double pull = weight[std::size_t(a)];
      if (pull != 0) sums.add_weight(slices, conductance * pull, a);
    }
    if (!any(cut)) continue;
    for (int i = 0; i < width; ++i) {
      if (!lane(cut, i)) continue;
      if (lane(simple, i)) {
        add_rest(points, std::size_t(first + i), around, h, weight);
      } else {
        add_flow(points, std::size_t(first + i), around, h, weight);
      }
    }
  }
  Cell& cell = cells_[std::size_t(around.number[power(3, D) / 2])];
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < 3 * lines; ++j) cell.storage[j][k] += sum_of(sums.storage[j][k]);
    for (int a = 0; a < D; ++a) {
      for (int i = 0; i < lines; ++i) cell.flow[a][i][k] += sum_of(sums.flow[a][i][k]);
    }
  }
  for (int k = 0; k < corners; ++k) cell.source[k] += sum_of(sums.source[k]);
}

/// Adds a part of a particle's box, s[a] of each axis, to the cell that it lies in.
template <int D>
void PoreCells<D>::add_part_of_box(const FlowPoints<D>& points, std::size_t point,
                                   const Surroundings& around, const BoxSlice* const (&s)[D],
                                   double flow, const double (&pull)[D]) {
  int near = 0;
  bool beside = true;
  for (int a = 0; a < D; ++a) {
    near = 3 * near + s[a]->shift + 1;
    beside = beside && std::abs(s[a]->shift) <= 1;
  }
  std::int32_t number = beside ? around.number[near] : -1;
  if (!beside) {
    PressureNode<D> lower = around.home;
    for (std::size_t a = 0; a < D; ++a) lower[a] += s[a]->shift;
    number = number_[std::size_t(lattice_.index(lower))];
  }
  if (number >= 0) {
    Cell& cell = cells_[std::size_t(number)];
    add_part<D, lines>(s, flow, cell.flow);
    add_weight<D>(s, pull, cell.source);
    return;
  }
  // No particle there.
  BoxSlice slices[D];
  const BoxSlice* extended[D];
  for (std::size_t a = 0; a < D; ++a) {
    const double b = s[a]->shift, xi = points.xi[a][point], half = points.half[a][point];
    slices[a] = part(0, std::max(xi - half, b), std::min(xi + half, b + 1), 0.5 / half);
    extended[a] = &slices[a];
  }
  Cell& home = cells_[std::size_t(around.number[power(3, D) / 2])];
  add_part<D, lines>(extended, flow, home.flow);
  add_weight<D>(extended, pull, home.source);
}

/// The parts of a particle's box in cells other than its own, one at most beside it in each axis.
template <int D>
void PoreCells<D>::add_rest(const FlowPoints<D>& points, std::size_t point,
                            const Surroundings& around, double h, const Weight& weight) {
  const double conductance = points.volume[point] * points.mobility[point] / h;
  BoxSlice slices[D][2];
  double pull[D];
  int beside = 0;  // bit a: the box reaches into the next cell of axis a
  for (std::size_t a = 0; a < D; ++a) {
    const double xi = points.xi[a][point], half = points.half[a][point], per = 0.5 / half;
    const double lower = xi - half, upper = xi + half;
    slices[a][0] = part(0, std::max(lower, 0.0), std::min(upper, 1.0), per);
    if (lower < -least_part) {
      slices[a][1] = part(-1, lower + 1, 1, per);
      beside |= 1 << a;
    } else if (upper > 1 + least_part) {
      slices[a][1] = part(1, 0, upper - 1, per);
      beside |= 1 << a;
    }
    pull[a] = conductance * weight[a];
  }
  for (int parts = 1; parts < (1 << D); ++parts) {
    if ((parts & ~beside) != 0) continue;
    const BoxSlice* s[D];
    for (int a = 0; a < D; ++a) s[a] = &slices[a][parts >> a & 1];
    add_part_of_box(points, point, around, s, conductance / h, pull);
  }
}

/// The parts of a particle's box, each in its cell.
template <int D>
void PoreCells<D>::add_flow(const FlowPoints<D>& points, std::size_t point,
                            const Surroundings& around, double h, const Weight& weight) {
  BoxSlice slices[D][4];
  int count[D], parts = 1;
  double pull[D];
  const double conductance = points.volume[point] * points.mobility[point] / h;
  for (std::size_t a = 0; a < D; ++a) {
    count[a] = cut(points.xi[a][point], points.half[a][point], slices[a]);
    parts *= count[a];
    pull[a] = conductance * weight[a];
  }
  int at[D] = {};
  for (int part_number = 0; part_number < parts; ++part_number) {
    const BoxSlice* s[D];
    for (int a = 0; a < D; ++a) s[a] = &slices[a][at[a]];
    for (int a = D - 1; a >= 0; --a) {  // counts up
      if (++at[a] < count[a]) break;
      at[a] = 0;
    }
    add_part_of_box(points, point, around, s, conductance / h, pull);
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
    std::int32_t row[corners];
    for (int j = 0; j < corners; ++j) {
      row[j] = matrix.row(corner<D>(cell.lower, j));
      matrix.rhs()[std::size_t(row[j])] += cell.source[j];
    }
    for (int j = 0; j < corners; ++j) {
      for (int l = j; l < corners; ++l) {
        int product[D];
        for (int a = 0; a < D; ++a) product[a] = (j >> (D - 1 - a) & 1) + (l >> (D - 1 - a) & 1);
        double value = D == 2 ? cell.storage[product[0]][product[1]]
                              : cell.storage[3 * product[0] + product[1]][product[D - 1]];
        for (int a = 0; a < D; ++a) {
          const double sign = product[a] == 1 ? -1.0 : 1.0;
          const int line = D == 2 ? 0 : product[a == 0 ? 1 : 0];
          value += sign * cell.flow[a][line][product[a == D - 1 ? D - 2 : D - 1]];
        }
        matrix.add(row[j], offset[j][l], value);
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
