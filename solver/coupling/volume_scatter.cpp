// SPDX-License-Identifier: Apache-2.0
// Particles to the operator Q: the points of a pressure cell into a small dense array, from there
// to the groups around the cell.
#include <algorithm>

#include "solver/coupling/cell_points.hpp"
#include "solver/coupling/volume_operator.hpp"
#include "solver/transfer/compact.hpp"
#include "solver/transfer/linear.hpp"
#include "solver/transfer/quadratic.hpp"

namespace scree {
namespace {

typedef double Pair __attribute__((vector_size(16), aligned(8), may_alias));

}  // namespace

/// Adds what the points of a cell have brought to the nodes to the groups around the cell, and
/// clears it.
template <int D>
template <class Kernel, int spacing, class Scratch>
// NOLINTNEXTLINE(readability-function-size): a kernel's body
void VolumeOperator<D>::flush(const PressureNode<D>& cell, Scratch& scratch) {
  constexpr int reach = Scratch::reach, extent = Scratch::extent, corners = Scratch::corners;
  constexpr int hats_axis = reach + 1, own = power(spacing, D);
  for (int g = 0; g < power(reach, D); ++g) {
    PressureNode<D> base = cell;
    int first = 0, hat = 0;  // node of the cell, hat of the group
    for (int a = D - 1, rest = g, stride = 1, nodes = spacing; a >= 0; --a) {
      base[std::size_t(a)] += rest % reach - (reach - 1);
      first += rest % reach * nodes;
      hat += (reach - 1 - rest % reach) * stride;
      rest /= reach;
      stride *= hats_axis;
      nodes *= extent;
    }
    const std::int32_t group = find_group(base);
    for (int s = 0; s < Kernel::lattices * own && group >= 0; ++s) {  // as they lie in memory
      const int l = s / own, node = first + change_extent<D, spacing, extent>(s % own);
      const std::size_t place = std::size_t(group) * std::size_t(slots_) + std::size_t(s);
      if (!scratch.touched[l][node] || record_[place] < 0) continue;
      double* q = touched(place) + hat;
      for (int a = 0; a < D; ++a) {
        const double* from = scratch.q[l][node][a];
        SCREE_UNROLL for (int k = 0; k < corners; k += 2) {
          Pair& to = *reinterpret_cast<Pair*>(q + change_extent<D, 2, hats_axis>(k));
          to += *reinterpret_cast<const Pair*>(from + k);
        }
        q += stride_;
        if (load_.empty()) continue;
        load_[std::size_t(record_[place]) * D + std::size_t(a)] += scratch.load[l][node][a];
      }
    }
  }
  scratch.clear();
}

/// Asks for Q of the g-th group around a cell.
template <int D>
template <int reach>
void VolumeOperator<D>::fetch_group(const PressureNode<D>& cell, int g) const {
  PressureNode<D> base = cell;
  for (int a = D - 1; a >= 0; --a, g /= reach) base[std::size_t(a)] += g % reach - (reach - 1);
  const std::int32_t group = find_group(base);
  if (group < 0) return;
  const std::int64_t size = std::int64_t(slots_) * D * stride_;
  const double* q = q_.data() + group * size;
  for (std::int64_t i = 0; i < size; i += 8) __builtin_prefetch(q + i, 0, 2);
}

/// Adds alpha V g_i N_j of every point of a chunk.
template <int D>
template <class Kernel, int spacing>
// NOLINTNEXTLINE(readability-function-size): a kernel's body
void VolumeOperator<D>::scatter_chunk(const FlowPoints<D>& points, const FlowChunk<D>& chunk,
                                      double biot) {
  using Scratch = CellScratch<Kernel, D, spacing>;
  using Group = PointGroup<Kernel, D>;
  Scratch scratch;
  Group group;
  for (const FlowRun<D>& run : chunk.runs) {
    int lowest[Kernel::lattices][D];  // place of the arena's lowest node among the cell's
    for (int l = 0; l < Kernel::lattices; ++l) {
      for (int a = 0; a < D; ++a) {
        lowest[l][a] = block_cells * chunk.block[std::size_t(a)] + Kernel::first_node(l) -
                       lowest_node(l) - spacing * (run.cell[std::size_t(a)] - Scratch::reach + 1);
      }
    }
    for (std::int64_t first = run.begin; first < run.end; first += Group::most) {
      const int count = int(std::min<std::int64_t>(Group::most, run.end - first));
      for (int i = 0; i < count; i += lanes_of<Lanes<double>>) {
        fill_points<Kernel, D>(points, first + i, biot / cell_size_, transfer_ == TransferType::mls,
                               i, group);
        // The groups come into the second cache while the points are worked out.
        const int batch = int(first - run.begin + i) / lanes_of<Lanes<double>>;
        if (batch < power(Scratch::reach, D)) fetch_group<Scratch::reach>(run.cell, batch);
      }
      add_group<Kernel, D, spacing>(group, lowest, count, scratch);
      if (!points.loaded.empty()) {
        add_moments(points, first, count, cell_size_, group, lowest, scratch);
      }
    }
    flush<Kernel, spacing>(run.cell, scratch);
  }
}

template <int D>
void VolumeOperator<D>::begin(bool loaded) {
  empty_.assign(record_.size(), 1);
  load_.assign(loaded ? place_.size() * D : 0, 0.0);
  unfolded_.clear();
}

template <int D>
void VolumeOperator<D>::scatter(const FlowPoints<D>& points, const FlowChunk<D>& chunk,
                                double biot) {
  switch (kernel_) {
    case KernelType::compact:
      if (lattice_.spacing() == 1) return scatter_chunk<Compact, 1>(points, chunk, biot);
      return scatter_chunk<Compact, 2>(points, chunk, biot);
    case KernelType::quadratic:
      return scatter_chunk<Quadratic, 2>(points, chunk, biot);
    case KernelType::linear:
      return scatter_chunk<Linear, 2>(points, chunk, biot);
  }
}

template class VolumeOperator<2>;
template class VolumeOperator<3>;

}  // namespace scree
