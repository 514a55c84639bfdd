// SPDX-License-Identifier: Apache-2.0
#include "solver/coupling/point_order.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace scree {

template <int D>
auto PointOrder<D>::find(const FlowChunk<D>& chunk, const double (&u)[D][width]) const -> Spot {
  const int cells = FlowChunk<D>::cells(lattice_.spacing());
  const double per = 1.0 / lattice_.spacing();  // exact: 1 or 1/2
  // Half cells of a pressure cell, which may begin within one.
  const double halves = 2.0 * lattice_.spacing();
  const double shift = 2 * lattice_.offset() - std::floor(2 * lattice_.offset());
  Spot spot;
  Wide upper = broadcast<Wide>(0.0), lower = broadcast<Wide>(0.0);
  spot.cell = broadcast<Wide>(0.0);
  for (int a = 0; a < D; ++a) {
    // All from the block's corner, whose cell is a whole number: the cell and the lowest velocity
    // node of a point then round alike.
    const int corner = block_cells * chunk.block[std::size_t(a)];
    const double cell_at_corner = corner * per;
    const Wide local =
        min(max(load<Wide>(u[a]), lattice_.limit(a, 0) - corner), lattice_.limit(a, 1) - corner);
    const Wide y = (local - lattice_.offset()) * per, own = floor(y);
    const Wide cell = select(local >= lattice_.first_from(a) - corner,
                             max(own, lattice_.first_cell() - cell_at_corner), own);
    const Wide xi = y - cell;
    spot.local[a] = local;
    spot.xi[a] = xi;
    spot.cell = spot.cell * double(cells) +
                (cell + (cell_at_corner - chunk.first_cell(a, lattice_.spacing())));
    const Wide half = min(max(floor(xi * halves + shift), 0.0), 3.0);
    const Wide second = select(half >= 2.0, broadcast<Wide>(1.0), 0.0);
    upper = upper * 2.0 + second;
    lower = lower * 2.0 + (half - 2.0 * second);
  }
  spot.part = upper * double(1 << D) + lower;
  return spot;
}

template <int D>
void PointOrder<D>::resize(std::int64_t points) {
  if (std::size_t(points) != place_.size()) forget();
  place_.resize(std::size_t(points));
  key_.resize(std::size_t(points));
}

template <int D>
bool PointOrder<D>::note(const FlowChunk<D>& chunk, int first, int count,
                         const double (&u)[D][width]) {
  static_assert(power(block_cells + 2, D) * parts < 65536);
  const Spot spot = find(chunk, u);
  alignas(64) double key[width];
  store(key, spot.cell * double(parts) + spot.part);
  std::uint16_t* known = key_.data() + chunk.begin + first;
  bool same = true;
  for (int i = 0; i < count; ++i) {
    const auto now = std::uint16_t(key[i]);
    same = same && known[i] == now;
    known[i] = now;
  }
  return same;
}

template <int D>
void PointOrder<D>::arrange(FlowChunk<D>& chunk) {
  const int cells = FlowChunk<D>::cells(lattice_.spacing()), keys = power(cells, D) * parts;
  const std::size_t count = std::size_t(chunk.end - chunk.begin);
  const std::uint16_t* key = key_.data() + chunk.begin;
  std::int32_t* place = place_.data() + chunk.begin;
  thread_local std::vector<std::int32_t> begin;
  begin.assign(std::size_t(keys) + 1, 0);
  for (std::size_t i = 0; i < count; ++i) {
    assert(key[i] < keys);
    ++begin[std::size_t(key[i]) + 1];
  }
  chunk.runs.clear();
  for (int cell = 0; cell < power(cells, D); ++cell) {
    const std::int32_t first = begin[std::size_t(cell) * parts];
    for (int k = cell * parts; k < (cell + 1) * parts; ++k) {
      begin[std::size_t(k) + 1] += begin[std::size_t(k)];
    }
    const std::int32_t last = begin[std::size_t(cell + 1) * parts];
    if (last == first) continue;
    FlowRun<D> run;
    run.begin = first;
    run.end = last;
    for (int a = D - 1, rest = cell; a >= 0; --a, rest /= cells) {
      run.cell[std::size_t(a)] = chunk.first_cell(a, lattice_.spacing()) + rest % cells;
    }
    chunk.runs.push_back(run);
  }
  for (std::size_t i = 0; i < count; ++i) place[i] = begin[std::size_t(key[i])]++;
}

template class PointOrder<2>;
template class PointOrder<3>;

}  // namespace scree
