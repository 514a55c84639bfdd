// SPDX-License-Identifier: Apache-2.0
#include "solver/coupling/point_order.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace scree {
namespace {

using Wide = Lanes<double>;
constexpr int width = lanes_of<Wide>;

}  // namespace

template <int D>
void PointOrder<D>::resize(int points) {
  const std::size_t room = std::size_t((points + width - 1) / width * width);
  if (place_.size() >= room) return;
  for (std::size_t a = 0; a < D; ++a) {
    local_[a].resize(room);
    xi_[a].resize(room);
  }
  key_.resize(room);
  part_.resize(room);
  by_cell_.resize(room);
  place_.resize(room);
}

template <int D>
void PointOrder<D>::find_keys(const FlowChunk<D>& chunk, const PressureLattice<D>& lattice) {
  const int cells = FlowChunk<D>::cells(lattice.spacing());
  const std::int64_t count = chunk.end - chunk.begin;
  const double per = 1.0 / lattice.spacing();  // exact: 1 or 1/2
  // Half cells of a pressure cell, which may begin within one.
  const double quarters = 2.0 * lattice.spacing();
  const double shift = 2 * lattice.offset() - std::floor(2 * lattice.offset());
  for (std::size_t i = 0; i < std::size_t(count); i += width) {
    Wide key = broadcast<Wide>(0.0), part = broadcast<Wide>(0.0), half = broadcast<Wide>(0.0);
    for (int a = 0; a < D; ++a) {
      // All from the block's corner, whose cell is a whole number: the cell and the lowest velocity
      // node of a point then round alike.
      const int corner = block_cells * chunk.block[std::size_t(a)];
      const double cell_at_corner = corner * per;
      double* local = local_[std::size_t(a)].data() + i;
      const Wide u =
          min(max(load<Wide>(local), lattice.limit(a, 0) - corner), lattice.limit(a, 1) - corner);
      store(local, u);
      const Wide y = (u - lattice.offset()) * per, own = floor(y);
      const Wide cell = select(u >= lattice.first_from(a) - corner,
                               max(own, lattice.first_cell() - cell_at_corner), own);
      const Wide xi = y - cell;
      store(xi_[std::size_t(a)].data() + i, xi);
      const Wide quarter = min(max(floor(xi * quarters + shift), 0.0), 3.0);
      const Wide upper = select(quarter >= 2.0, broadcast<Wide>(1.0), broadcast<Wide>(0.0));
      part = part * 2.0 + upper;
      half = half * 2.0 + (quarter - 2.0 * upper);
      key =
          key * double(cells) + (cell + (cell_at_corner - chunk.first_cell(a, lattice.spacing())));
    }
    alignas(64) double keys[width], places[width];
    store(keys, key);
    store(places, part * double(1 << D) + half);
    for (std::size_t l = 0; l < width; ++l) {
      key_[i + l] = std::int32_t(keys[l]);
      part_[i + l] = std::uint8_t(places[l]);
    }
  }
}

template <int D>
void PointOrder<D>::arrange(FlowChunk<D>& chunk, const PressureLattice<D>& lattice,
                            FlowPoints<D>& points) {
  const int cells = FlowChunk<D>::cells(lattice.spacing()), keys = power(cells, D);
  const std::size_t count = std::size_t(chunk.end - chunk.begin);
  for (std::size_t a = 0; a < D; ++a) {  // behind the last point: finite numbers
    std::fill(local_[a].begin() + std::ptrdiff_t(count),
              local_[a].begin() + std::ptrdiff_t((count + width - 1) / width * width), 1.0);
  }
  find_keys(chunk, lattice);
  std::array<std::int32_t, std::size_t(power(block_cells + 2, D)) + 1> begin{};
  for (std::size_t i = 0; i < count; ++i) {
    assert(key_[i] >= 0 && key_[i] < keys);
    ++begin[std::size_t(key_[i]) + 1];
  }
  chunk.runs.clear();
  for (int key = 0; key < keys; ++key) {
    const std::int32_t number = begin[std::size_t(key) + 1];
    begin[std::size_t(key) + 1] += begin[std::size_t(key)];
    if (number == 0) continue;
    FlowRun<D> run;
    run.begin = chunk.begin + begin[std::size_t(key)];
    run.end = run.begin + number;
    for (int a = D - 1, rest = key; a >= 0; --a, rest /= cells) {
      run.cell[std::size_t(a)] = chunk.first_cell(a, lattice.spacing()) + rest % cells;
    }
    chunk.runs.push_back(run);
  }
  for (std::size_t i = 0; i < count; ++i) {
    by_cell_[std::size_t(begin[std::size_t(key_[i])]++)] = std::int32_t(i);
  }
  for (const FlowRun<D>& run : chunk.runs) order_run(run, chunk.begin);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t to = std::size_t(place_[i]);
    for (std::size_t a = 0; a < D; ++a) {
      points.local[a][to] = local_[a][i];
      points.xi[a][to] = xi_[a][i];
    }
  }
}

/// Sets the places of the points of a pressure cell.
template <int D>
void PointOrder<D>::order_run(const FlowRun<D>& run, std::int64_t begin) {
  constexpr std::size_t parts = std::size_t(1) << (2 * D);
  std::array<std::int32_t, parts + 1> next{};
  const auto first = by_cell_.begin() + (run.begin - begin);
  const auto last = by_cell_.begin() + (run.end - begin);
  for (auto i = first; i < last; ++i) ++next[std::size_t(part_[std::size_t(*i)]) + 1];
  for (std::size_t k = 0; k < parts; ++k) next[k + 1] += next[k];
  for (auto i = first; i < last; ++i) {
    place_[std::size_t(*i)] = run.begin + next[std::size_t(part_[std::size_t(*i)])]++;
  }
}

template class PointOrder<2>;
template class PointOrder<3>;

}  // namespace scree
