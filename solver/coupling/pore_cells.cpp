// SPDX-License-Identifier: Apache-2.0
#include "solver/coupling/pore_cells.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <limits>

#include "solver/coupling/pore_moments.hpp"

namespace scree {
namespace {

using Quad = Pack<double, 4>;

/// Over the part of a box within one cell, in one axis: shares of the box.
struct Slice {
  alignas(32) double product[4];  ///< integrals of (1 - x)^2, x (1 - x) and x^2; zero
  double hat[2];                  ///< of 1 - x and x
  double share;                   ///< of the box's length
  std::int32_t shift;             ///< of the cell, from the particle's
  double from, to;                ///< of the box, in the particle's cell
};

/// From the share and the means of x and x^2 over the part.
Slice slice(std::int32_t shift, double share, double mean, double square) {
  const double first = share * mean, second = share * square;
  return {{share - 2 * first + second, first - second, second, 0},
          {share - first, first},
          share,
          shift,
          0,
          0};
}

/// A part from a to b in the coordinate of the cell; `per`: 1 over the length of the box.
Slice part(std::int32_t shift, double a, double b, double per) {
  return slice(shift, (b - a) * per, 0.5 * (a + b), (a * a + a * b + b * b) / 3);
}

/// The parts of a box in one axis.
struct Slices {
  Slice at[8];
  int count = 0;
};

/// Cuts a box from `lower` to `upper`, part of one whose length is 1/per, at whole numbers; no cell
/// is lower than `first`. Thinner parts than rounding are left. `image`: the wall beyond which the
/// box is an image of what was meant; infinite: it is none.
void cut(double lower, double upper, double per, std::int32_t first, double image, Slices& slices) {
  constexpr double least = 1e-12;
  for (std::int32_t c = std::max(std::int32_t(std::floor(lower)), first); c < upper; ++c) {
    const double from = c == first ? lower : std::max(lower, double(c));
    const double to = std::min(upper, c + 1.0);
    if (to - from <= least || slices.count == int(std::size(slices.at))) continue;
    Slice& s = slices.at[slices.count++] = part(c, from - c, to - c, per);
    s.from = std::isfinite(image) ? 2 * image - to : from;
    s.to = std::isfinite(image) ? 2 * image - from : to;
  }
}

/// A box from xi - half to xi + half, cut at the cells' faces. What lies beyond a wall is folded
/// back to where the image's box, whose particle is not there, would lie within.
void cut(double xi, double half, const PoreAxis& axis, Slices& slices) {
  slices.count = 0;
  const double lower = xi - half, upper = xi + half;
  if (lower >= axis.whole[0] && upper <= axis.whole[1]) {
    slices.at[slices.count++] = slice(0, 1, xi, xi * xi + half * half / 3);
    slices.at[0].from = lower;
    slices.at[0].to = upper;
    return;
  }
  const double per = 0.5 / half;
  const double from = std::max(lower, axis.wall[0]), to = std::min(upper, axis.wall[1]);
  cut(from, to, per, axis.first, std::numeric_limits<double>::infinity(), slices);
  if (lower < axis.wall[0]) {
    const double w = axis.wall[0];
    cut(std::max(w, 2 * w - upper), 2 * w - lower, per, axis.first, w, slices);
  }
  if (upper > axis.wall[1]) {
    const double w = axis.wall[1];
    cut(2 * w - upper, std::min(w, 2 * w - lower), per, axis.first, w, slices);
  }
}

void add_line(double scale, const double* products, double* sums) {
  store(sums, mul_add(broadcast<Quad>(scale), load<Quad>(products), load<Quad>(sums)));
}

/// Adds the part of a box that `s` cuts out to the moments of the flow.
template <int D, int lines>
void add_part(const Slice* const (&s)[D], double flow, double (&moments)[D][lines][4]) {
  if constexpr (D == 2) {
    add_line(flow * s[0]->share, s[1]->product, moments[0][0]);
    add_line(flow * s[1]->share, s[0]->product, moments[1][0]);
  } else {
    const double x = flow * s[0]->share, y = flow * s[1]->share, z = flow * s[2]->share;
    for (int i = 0; i < 3; ++i) {
      add_line(x * s[1]->product[i], s[2]->product, moments[0][i]);
      add_line(y * s[0]->product[i], s[2]->product, moments[1][i]);
      add_line(z * s[0]->product[i], s[1]->product, moments[2][i]);
    }
  }
}

/// Adds the same part to what weight along each axis does.
template <int D>
void add_weight(const Slice* const (&s)[D], double pull, double (&weight)[D][1 << D]) {
  for (int a = 0; a < D; ++a) {
    const double up = pull * s[a]->share;
    for (int k = 0; k < (1 << D); ++k) {
      double slope = (k >> (D - 1 - a) & 1) != 0 ? up : -up;
      for (int b = 0; b < D; ++b) {
        if (b != a) slope *= s[b]->hat[k >> (D - 1 - b) & 1];
      }
      weight[a][k] += slope;
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
void PoreCells<D>::begin(const std::vector<FlowChunk<D>>& chunks) {
  for (const Cell& cell : cells_) {
    number_[std::size_t(lattice_.index(cell.lower))] = -1;
    for (int k = 0; k < corners; ++k) {
      marks_[std::size_t(lattice_.index(corner<D>(cell.lower, k)))] = 0;
    }
  }
  cells_.clear();
  for (const FlowChunk<D>& chunk : chunks) {
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
}

template <int D>
void PoreCells<D>::add(const FlowPoints<D>& points, const FlowChunk<D>& chunk, const Measures& m,
                       double density) {
  for (const FlowRun<D>& run : chunk.runs) add_run(points, run, m, density);
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
  for (int a = 0; a < D; ++a) {
    PoreAxis& axis = around.axis[a];
    const std::int32_t at = home[std::size_t(a)];
    for (int side = 0; side < 2; ++side) {
      axis.wall[side] = lattice_.coordinate(lattice_.wall(a, side)) - at;
    }
    axis.first = lattice_.ends_at_wall(a) ? std::min(lattice_.first_cell() - at, 0)
                                          : std::numeric_limits<std::int32_t>::min();
    axis.whole[0] = std::max(axis.first == 0 ? axis.wall[0] : 0.0, axis.wall[0]);
    axis.whole[1] = std::min(axis.wall[1], 1.0);
  }
  return around;
}

/// Whether what points of the cell bring may be folded at a wall.
template <int D>
bool PoreCells<D>::near_wall(const Surroundings& around, double largest_half) {
  for (const PoreAxis& axis : around.axis) {
    if (axis.wall[0] > -largest_half || axis.wall[1] < 1 + largest_half ||
        axis.first > -std::int32_t(std::ceil(largest_half))) {
      return true;
    }
  }
  return false;
}

template <int D>
// NOLINTNEXTLINE(readability-function-size): a kernel's body
void PoreCells<D>::add_run(const FlowPoints<D>& points, const FlowRun<D>& run, const Measures& m,
                           double density) {
  using Wide = Lanes<double>;
  constexpr int width = lanes_of<Wide>;
  const Surroundings around = surroundings(run.cell);
  // Beside a wall, boxes that are cut are added part by part; else their part within the cell is
  // added with those of the others, and the rest of them alone.
  const bool folds = near_wall(around, m.largest_half);
  PoreSums<D> sums{};
  PorePoints<D> group;
  for (std::int64_t first = run.begin; first < run.end; first += width * group.most) {
    int v = 0;
    for (; v < group.most && first + v * width < run.end; ++v) {
      const std::int64_t at = first + v * width;
      const MaskOf<Wide> there =
          first_lanes<Wide>(int(std::min<std::int64_t>(run.end - at, width)));
      const auto field = [&](const auto& f) { return load_any<Wide>(f.data() + at); };
      MaskOf<Wide> whole = there;
      for (std::size_t a = 0; a < D; ++a) {
        const Wide x = field(points.xi[a]), half = select(there, field(points.half[a]), 1.0);
        set_axis(x, half, around.axis[a].whole, group.axis[v][a]);
        whole =
            whole & (x - half >= around.axis[a].whole[0]) & (x + half <= around.axis[a].whole[1]);
      }
      group.capacity[v] = select(there, field(points.capacity), 0.0);
      group.content[v] = select(there, field(points.content), 0.0);
      group.missed[v] = select(there, field(points.missed), 0.0);
      group.conductance[v] =
          select(folds ? whole : there, field(points.volume) * field(points.mobility), 0.0);
      const MaskOf<Wide> cut = there & !whole;
      for (int l = 0; any(cut) && l < width; ++l) {
        if (lane(cut, l)) add_flow(points, std::size_t(at + l), around, !folds, m.h, density);
      }
    }
    scree::add_storage(group, v, sums);
    scree::add_flow(group, v, sums);
    add_source(group, v, sums);
  }
  take(sums, m, density, cells_[std::size_t(around.number[power(3, D) / 2])]);
}

/// Adds the sums over the points of a cell.
template <int D>
void PoreCells<D>::take(const PoreSums<D>& sums, const Measures& m, double density, Cell& cell) {
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < 3 * lines; ++j) cell.storage[j][k] += sum_lanes(sums.storage[j][k]);
    for (int i = 0; i < D * lines; ++i) {
      cell.flow[i / lines][i % lines][k] +=
          sum_lanes(sums.flow[i / lines][i % lines][k]) / (m.h * m.h);
    }
  }
  for (int k = 0; k < corners; ++k) {
    cell.content[k] += sum_lanes(sums.content[k]);
    cell.missed[k] += sum_lanes(sums.missed[k]);
  }
  for (int a = 0; a < D; ++a) {
    double pull[PoreSums<D>::others];
    for (int n = 0; n < PoreSums<D>::others; ++n) {
      pull[n] = sum_lanes(sums.weight[a][n]) * density / m.h;
    }
    const int low = D - 1 - a;  // bit of the axis; the others' bits in order number the sums
    for (int k = 0; k < corners; ++k) {
      const int n = (k >> (low + 1) << low) | (k & ((1 << low) - 1));
      cell.weight[a][k] += (k >> low & 1) != 0 ? pull[n] : -pull[n];
    }
  }
}

/// The parts of a particle's box, each in its cell; rest: but for the one in the particle's own.
template <int D>
void PoreCells<D>::add_flow(const FlowPoints<D>& points, std::size_t point,
                            const Surroundings& around, bool rest, double h, double density) {
  Slices slices[D];
  int parts = 1;
  const double conductance = points.volume[point] * points.mobility[point] / h;
  for (std::size_t a = 0; a < D; ++a) {
    cut(points.xi[a][point], points.half[a][point], around.axis[a], slices[a]);
    parts *= slices[a].count;
  }
  int at[D] = {};
  for (int part_number = 0; part_number < parts; ++part_number) {
    const Slice* s[D];
    Slice extended[D];
    int near = 0;
    bool beside = true, home = true;
    for (int a = 0; a < D; ++a) {
      s[a] = &slices[a].at[at[a]];
      home = home && s[a]->shift == 0;
      near = 3 * near + s[a]->shift + 1;
      beside = beside && std::abs(s[a]->shift) <= 1;
    }
    for (int a = D - 1; a >= 0; --a) {  // counts up
      if (++at[a] < slices[a].count) break;
      at[a] = 0;
    }
    if (rest && home) continue;
    std::int32_t number = beside ? around.number[near] : -1;
    if (!beside) {
      PressureNode<D> lower = around.home;
      for (std::size_t a = 0; a < D; ++a) lower[a] += s[a]->shift;
      number = number_[std::size_t(lattice_.index(lower))];
    }
    if (number < 0) {  // no particle there
      number = around.number[power(3, D) / 2];
      for (std::size_t a = 0; a < D; ++a) {
        extended[a] = part(0, s[a]->from, s[a]->to, 0.5 / points.half[a][point]);
        s[a] = &extended[a];
      }
    }
    Cell* cell = &cells_[std::size_t(number)];
    add_part<D, lines>(s, conductance / h, cell->flow);
    add_weight<D>(s, conductance * density, cell->weight);
  }
}

/// S of corners j and l.
template <int D>
double PoreCells<D>::storage(const Cell& cell, int j, int l) {
  int product[D];
  for (int a = 0; a < D; ++a) product[a] = (j >> (D - 1 - a) & 1) + (l >> (D - 1 - a) & 1);
  return D == 2 ? cell.storage[product[0]][product[1]]
                : cell.storage[3 * product[0] + product[1]][product[D - 1]];
}

/// H of corners j and l.
template <int D>
double PoreCells<D>::conductance(const Cell& cell, int j, int l) {
  int product[D];
  for (int a = 0; a < D; ++a) product[a] = (j >> (D - 1 - a) & 1) + (l >> (D - 1 - a) & 1);
  double value = 0;
  for (int a = 0; a < D; ++a) {
    const double sign = product[a] == 1 ? -1.0 : 1.0;
    const int line = D == 2 ? 0 : product[a == 0 ? 1 : 0];
    value += sign * cell.flow[a][line][product[a == D - 1 ? D - 2 : D - 1]];
  }
  return value;
}

/// S p of corner j.
template <int D>
double PoreCells<D>::content(const Cell& cell, int j, const double* nodal) const {
  if (nodal == nullptr) return cell.content[j];
  double sum = 0;
  for (int l = 0; l < corners; ++l) {
    sum += storage(cell, j, l) * nodal[lattice_.index(corner<D>(cell.lower, l))];
  }
  return sum;
}

template <int D>
void PoreCells<D>::add_sources(double dt, const std::array<double, 3>& gravity, const double* nodal,
                               PressureMatrix<D>& matrix) const {
  for (const Cell& cell : cells_) {
    for (int j = 0; j < corners; ++j) {
      double source = content(cell, j, nodal) / dt;
      for (int a = 0; a < D; ++a) source += gravity[std::size_t(a)] * cell.weight[a][j];
      matrix.rhs()[std::size_t(matrix.row(corner<D>(cell.lower, j)))] += source;
    }
  }
}

template <int D>
std::vector<double> PoreCells<D>::missed() const {
  std::vector<double> missed(std::size_t(lattice_.size()), 0.0);
  for (const Cell& cell : cells_) {
    for (int j = 0; j < corners; ++j) {
      missed[std::size_t(lattice_.index(corner<D>(cell.lower, j)))] += cell.missed[j];
    }
  }
  return missed;
}

/// matrix += factor times an operator that is a sum over cells, product(cell, j, l) for its corners
/// j and l.
template <int D>
void PoreCells<D>::add_products(double factor, double (*product)(const Cell&, int, int),
                                PressureMatrix<D>& matrix) const {
  int offset[corners][corners];
  for (int j = 0; j < corners; ++j) {
    for (int l = 0; l < corners; ++l) {
      offset[j][l] = matrix.offset_index(corner<D>({}, j), corner<D>({}, l));
    }
  }
  for (const Cell& cell : cells_) {
    for (int j = 0; j < corners; ++j) {
      const std::int32_t row = matrix.row(corner<D>(cell.lower, j));
      for (int l = j; l < corners; ++l) matrix.add(row, offset[j][l], factor * product(cell, j, l));
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
