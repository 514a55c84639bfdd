// SPDX-License-Identifier: Apache-2.0
#include "solver/coupling/point_order.hpp"

#include <algorithm>
#include <cassert>

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
  place_.resize(room);
}

template <int D>
void PointOrder<D>::find_keys(const FlowChunk<D>& chunk, const PressureLattice<D>& lattice) {
  const int cells = FlowChunk<D>::cells(lattice.spacing());
  const std::int64_t count = chunk.end - chunk.begin;
  const double per = 1.0 / lattice.spacing();  // exact: 1 or 1/2
  for (std::size_t i = 0; i < std::size_t(count); i += width) {
    Wide key = broadcast<Wide>(0.0);
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
      store(xi_[std::size_t(a)].data() + i, y - cell);
      key =
          key * double(cells) + (cell + (cell_at_corner - chunk.first_cell(a, lattice.spacing())));
    }
    alignas(64) double keys[width];
    store(keys, key);
    for (std::size_t l = 0; l < width; ++l) key_[i + l] = std::int32_t(keys[l]);
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
    const std::size_t to = std::size_t(chunk.begin + begin[std::size_t(key_[i])]++);
    place_[i] = std::int64_t(to);
    for (std::size_t a = 0; a < D; ++a) {
      points.local[a][to] = local_[a][i];
      points.xi[a][to] = xi_[a][i];
    }
  }
}

template class PointOrder<2>;
template class PointOrder<3>;

}  // namespace scree
