// SPDX-License-Identifier: Apache-2.0
#include "solver/coupling/flow_points.hpp"

#include <cassert>
#include <cmath>

namespace scree {

template <int D>
void arrange(FlowChunk<D>& chunk, const PressureLattice<D>& lattice,
             const std::array<std::vector<double>, D>& local, FlowPoints<D>& points,
             std::vector<std::int32_t>& rank) {
  const int cells = FlowChunk<D>::cells(lattice.spacing());
  const std::size_t count = std::size_t(chunk.end - chunk.begin);
  rank.resize(count);
  std::array<std::int32_t, std::size_t(power(block_cells + 2, D)) + 1> begin{};
  for (std::size_t i = 0; i < count; ++i) {
    std::int32_t key = 0;
    for (std::size_t a = 0; a < D; ++a) {
      const double u = local[a][i] + block_cells * chunk.block[a];
      const int cell = int(std::floor(lattice.coordinate(u)));
      key = key * cells + cell - chunk.first_cell(int(a), lattice.spacing());
    }
    assert(key >= 0 && key < power(cells, D));
    rank[i] = key;
    ++begin[std::size_t(key) + 1];
  }
  chunk.runs.clear();
  for (int key = 0; key < power(cells, D); ++key) {
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
    rank[i] = begin[std::size_t(rank[i])]++;
    const std::size_t to = std::size_t(chunk.begin + rank[i]);
    for (std::size_t a = 0; a < D; ++a) {
      const double y = lattice.coordinate(local[a][i] + block_cells * chunk.block[a]);
      points.local[a][to] = local[a][i];
      points.xi[a][to] = y - std::floor(y);
    }
  }
}

template void arrange<2>(FlowChunk<2>&, const PressureLattice<2>&,
                         const std::array<std::vector<double>, 2>&, FlowPoints<2>&,
                         std::vector<std::int32_t>&);
template void arrange<3>(FlowChunk<3>&, const PressureLattice<3>&,
                         const std::array<std::vector<double>, 3>&, FlowPoints<3>&,
                         std::vector<std::int32_t>&);

}  // namespace scree
