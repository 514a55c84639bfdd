// SPDX-License-Identifier: Apache-2.0
// Particles to the operator Q: the points of a pressure cell into a small dense array, from there
// to the groups around the cell.
#include <algorithm>
#include <cmath>

#include "solver/coupling/volume_operator.hpp"
#include "solver/transfer/compact.hpp"
#include "solver/transfer/linear.hpp"
#include "solver/transfer/quadratic.hpp"

namespace scree {
namespace {

using Wide = Lanes<double>;
constexpr int width = lanes_of<Wide>;

/// The nodes that the points of one pressure cell touch, and what comes together at them. Zero but
/// between the points and flush().
template <class Kernel, int D, int spacing>
struct CellScratch {
  static constexpr int reach = spacing == 1 ? 3 : 2;  ///< groups an axis
  static constexpr int extent = reach * spacing;      ///< nodes an axis and lattice
  static constexpr int nodes = power(extent, D);
  static constexpr int corners = 1 << D;

  alignas(64) double q[Kernel::lattices * nodes][D][corners] = {};
  double load[Kernel::lattices * nodes][D] = {};

  /// Nodes that the points of the run touch, axis by axis, the last one included.
  std::int8_t lower[Kernel::lattices][D], upper[Kernel::lattices][D];
};

/// Digits of n in a number system of `extent`, last axis fastest, read in one of `other`.
template <int D, int extent, int other>
constexpr int change_extent(int n) {
  int result = 0;
  for (int a = 0, stride = 1; a < D; ++a, n /= extent, stride *= other) {
    result += n % extent * stride;
  }
  return result;
}

/// Numbers of arena nodes, changed to those of a cell's nodes.
template <class Kernel, int D, int extent>
struct ArenaNodes {
  static constexpr int count = power(Kernel::arena_extent, D);
  std::array<std::int16_t, std::size_t(count)> at{};
  constexpr ArenaNodes() {
    for (int n = 0; n < count; ++n) {
      at[std::size_t(n)] = std::int16_t(change_extent<D, Kernel::arena_extent, extent>(n));
    }
  }
};

/// Numbers of the nodes of a particle in a cell, from the lowest one.
template <int D, int S, int extent>
struct StencilNodes {
  std::array<std::int16_t, std::size_t(power(S, D))> at{};
  constexpr StencilNodes() {
    for (int s = 0; s < power(S, D); ++s) {
      at[std::size_t(s)] = std::int16_t(change_extent<D, S, extent>(s));
    }
  }
};

typedef double Pair __attribute__((vector_size(16), aligned(8), may_alias));

Wide load_any(const double* p) {
  Wide v;
  __builtin_memcpy(&v, p, sizeof(v));
  return v;
}

/// A vector of points: nodes, gradients [1/cell] and hats, all of them times `scale`.
template <class Kernel, int D>
struct Batch {
  static constexpr int nodes = power(Kernel::support, D), corners = 1 << D;
  alignas(64) double gradient[Kernel::lattices][nodes][D][width];
  alignas(64) double hat[width][corners];
  alignas(64) std::int64_t base[Kernel::lattices][width];  ///< arena node, lattice by lattice
};

/// Gradients of mls: w D^-1 (x_i - x_p).
template <class Kernel, int D, class Point>
void affine_gradients(const Point& at, Batch<Kernel, D>& batch) {
  constexpr int S = Kernel::support;
  Wide one[D][D], inverse[D][D];
  for (int a = 0; a < D; ++a) {
    for (int b = 0; b < D; ++b) one[a][b] = broadcast<Wide>(a == b ? 1.0 : 0.0);
  }
  Kernel::template times_inverse_moment<Wide, D>(at, one, inverse);
  for (int l = 0; l < Kernel::lattices; ++l) {
    for (int s = 0; s < power(S, D); ++s) {
      Wide weight = broadcast<Wide>(1.0), offset[D];
      for (int a = D - 1, rest = s; a >= 0; --a, rest /= S) {
        weight = weight * at.stencil.weight[l][a][rest % S];
        offset[a] = at.stencil.offset[l][a] + double(rest % S);
      }
      for (int a = 0; a < D; ++a) {
        Wide sum = inverse[a][0] * offset[0];
        for (int b = 1; b < D; ++b) sum = mul_add(inverse[a][b], offset[b], sum);
        store(batch.gradient[l][s][a], sum * weight);
      }
    }
  }
}

/// Gradients of the weights.
template <class Kernel, int D, class Point>
void weight_gradients(const Point& at, Batch<Kernel, D>& batch) {
  constexpr int S = Kernel::support;
  const auto slopes = Kernel::template slopes<Wide, D>(at);
  for (int l = 0; l < Kernel::lattices; ++l) {
    for (int s = 0; s < power(S, D); ++s) {
      for (int a = 0; a < D; ++a) {
        Wide g = broadcast<Wide>(1.0);
        for (int b = D - 1, rest = s; b >= 0; --b, rest /= S) {
          g = g * (a == b ? slopes.slope[l][b][rest % S] : at.stencil.weight[l][b][rest % S]);
        }
        store(batch.gradient[l][s][a], g);
      }
    }
  }
}

template <class Kernel, int D>
void fill_batch(const FlowPoints<D>& points, std::int64_t first, double scale, bool affine,
                Batch<Kernel, D>& batch) {
  Wide u[D], xi[D];
  for (int a = 0; a < D; ++a) {
    u[a] = load_any(points.local[std::size_t(a)].data() + first);
    xi[a] = load_any(points.xi[std::size_t(a)].data() + first);
  }
  const auto at = Kernel::template at<Wide, D>(u);
  if constexpr (Kernel::has_inverse_moment) {
    if (affine) {
      affine_gradients<Kernel, D>(at, batch);
    } else {
      weight_gradients<Kernel, D>(at, batch);
    }
  } else {
    weight_gradients<Kernel, D>(at, batch);
  }
  for (int l = 0; l < Kernel::lattices; ++l) {
    store(batch.base[l], at.stencil.base[l]);
  }
  const Wide pull = load_any(points.volume.data() + first) * scale;
  alignas(64) double hats[1 << D][width];
  for (int k = 0; k < (1 << D); ++k) {
    Wide n = pull;
    for (int a = 0; a < D; ++a) n = n * ((k >> (D - 1 - a) & 1) != 0 ? xi[a] : 1.0 - xi[a]);
    store(hats[k], n);
  }
  for (int i = 0; i < width; ++i) {
    for (int k = 0; k < (1 << D); ++k) batch.hat[i][k] = hats[k][i];
  }
}

/// Sets the nodes that points within a box touch, from the nodes of its two ends.
template <class Kernel, int D, int spacing>
void set_range(const FlowPoints<D>& points, const FlowRun<D>& run,
               const int (&lowest)[Kernel::lattices][D], CellScratch<Kernel, D, spacing>& scratch) {
  constexpr int last = CellScratch<Kernel, D, spacing>::extent - 1;
  double lower[D], upper[D];
  for (std::size_t a = 0; a < D; ++a) {
    const double* u = points.local[a].data();
    const auto ends = std::minmax_element(u + run.begin, u + run.end);
    lower[a] = *ends.first;
    upper[a] = *ends.second;
  }
  const auto low = Kernel::template at<double, D>(lower);
  const auto high = Kernel::template at<double, D>(upper);
  for (int l = 0; l < Kernel::lattices; ++l) {
    int from = int(low.stencil.base[l]) - l * power(Kernel::arena_extent, D);
    int to = int(high.stencil.base[l]) - l * power(Kernel::arena_extent, D);
    for (int a = D - 1; a >= 0; --a) {
      const int begin = from % Kernel::arena_extent + lowest[l][a];
      const int end = to % Kernel::arena_extent + Kernel::support - 1 + lowest[l][a];
      scratch.lower[l][a] = std::int8_t(std::max(begin, 0));
      scratch.upper[l][a] = std::int8_t(std::min(end, last));
      from /= Kernel::arena_extent;
      to /= Kernel::arena_extent;
    }
  }
}

/// Adds the points `begin` to `end`, all of one cell. lowest[l][a]: place of the arena's lowest
/// node of a lattice among the cell's.
template <class Kernel, int D, int spacing>
// NOLINTNEXTLINE(readability-function-size): a kernel's body
void add_points(const FlowPoints<D>& points, std::int64_t begin, std::int64_t end, double scale,
                double cell_size, bool affine, const int (&lowest)[Kernel::lattices][D],
                CellScratch<Kernel, D, spacing>& scratch) {
  using Scratch = CellScratch<Kernel, D, spacing>;
  using Hats = Pack<double, Scratch::corners>;
  constexpr int S = Kernel::support, nodes = power(S, D), extent = Scratch::extent;
  static constexpr ArenaNodes<Kernel, D, extent> arena;
  static constexpr StencilNodes<D, S, extent> stencil;
  Batch<Kernel, D> batch;
  for (std::int64_t first = begin; first < end; first += width) {
    fill_batch<Kernel, D>(points, first, scale, affine, batch);
    const int active = int(std::min<std::int64_t>(width, end - first));
    for (int i = 0; i < active; ++i) {
      const Hats hat = load<Hats>(batch.hat[i]);
      const bool loaded = !points.loaded.empty() && points.loaded[std::size_t(first + i)] != 0;
      for (int l = 0; l < Kernel::lattices; ++l) {
        const int from = int(batch.base[l][i]) - l * arena.count;
        int node = arena.at[std::size_t(from)], digit[D];  // of the lowest node, in the cell
        for (int a = D - 1, rest = from, stride = 1; a >= 0; --a, stride *= extent) {
          node += lowest[l][a] * stride;
          if constexpr (S > 2) digit[a] = rest % Kernel::arena_extent + lowest[l][a];
          if constexpr (S > 2) rest /= Kernel::arena_extent;
        }
        for (int s = 0; s < nodes; ++s) {
          if constexpr (S > 2) {
            // On the rim of its support, where rounding may decide, a node's weight is zero.
            bool inside = true;
            for (int a = D - 1, rest = s; a >= 0; --a, rest /= S) {
              inside = inside && digit[a] + rest % S >= 0 && digit[a] + rest % S < extent;
            }
            if (!inside) continue;
          }
          const int n = l * Scratch::nodes + node + stencil.at[std::size_t(s)];
          const double(&gradient)[D][width] = batch.gradient[l][s];
          for (int a = 0; a < D; ++a) {
            double* q = scratch.q[n][a];
            store(q, mul_add(broadcast<Hats>(gradient[a][i]), hat, load<Hats>(q)));
          }
          if (!loaded) continue;
          const auto& moment = points.moments[std::size_t(first + i)];
          for (int a = 0; a < D; ++a) {
            for (int b = 0; b < D; ++b) {
              scratch.load[n][a] +=
                  moment[std::size_t(a) * D + std::size_t(b)] * gradient[b][i] / cell_size;
            }
          }
        }
      }
    }
  }
}

}  // namespace

/// Adds what the points of a cell have brought to the groups around it, and clears it.
template <int D>
template <class Kernel, int spacing, class Scratch>
// NOLINTNEXTLINE(readability-function-size): a kernel's body
void VolumeOperator<D>::flush(const PressureNode<D>& cell, Scratch& scratch) {
  constexpr int reach = Scratch::reach, extent = Scratch::extent, corners = Scratch::corners;
  constexpr int hats_axis = reach + 1, own = power(spacing, D);
  for (int g = 0; g < power(reach, D); ++g) {
    PressureNode<D> base = cell;
    int first[D], hat = 0;
    for (int a = D - 1, rest = g, stride = 1; a >= 0; --a, rest /= reach, stride *= hats_axis) {
      first[a] = rest % reach * spacing;
      base[std::size_t(a)] += rest % reach - (reach - 1);
      hat += (reach - 1 - rest % reach) * stride;
    }
    const std::int32_t group = find_group(base);
    if (group < 0) continue;
    for (int s = 0; s < Kernel::lattices * own; ++s) {  // as they lie in memory
      const int l = s / own;
      bool reached = true;
      int node = l * Scratch::nodes;
      for (int a = D - 1, rest = s, stride = 1; a >= 0; --a, rest /= spacing, stride *= extent) {
        const int at = first[a] + rest % spacing;
        reached = reached && at >= scratch.lower[l][a] && at <= scratch.upper[l][a];
        node += at * stride;
      }
      const std::size_t place = std::size_t(group) * std::size_t(slots_) + std::size_t(s);
      if (!reached || record_[place] < 0) continue;
      double* q = touched(place) + hat;
      for (int a = 0; a < D; ++a) {
        double* from = scratch.q[node][a];
        SCREE_UNROLL for (int k = 0; k < corners; k += 2) {
          Pair& to = *reinterpret_cast<Pair*>(q + change_extent<D, 2, hats_axis>(k));
          to += *reinterpret_cast<const Pair*>(from + k);
        }
        std::fill(from, from + corners, 0.0);
        q += stride_;
        if (load_.empty()) continue;
        load_[std::size_t(record_[place]) * D + std::size_t(a)] += scratch.load[node][a];
        scratch.load[node][a] = 0;
      }
    }
  }
}

/// Adds alpha V g_i N_j of every point of a chunk.
template <int D>
template <class Kernel, int spacing>
void VolumeOperator<D>::scatter_chunk(const FlowPoints<D>& points, const FlowChunk<D>& chunk,
                                      double biot) {
  using Scratch = CellScratch<Kernel, D, spacing>;
  Scratch scratch;
  for (const FlowRun<D>& run : chunk.runs) {
    int lowest[Kernel::lattices][D];
    for (int l = 0; l < Kernel::lattices; ++l) {
      for (int a = 0; a < D; ++a) {
        lowest[l][a] = block_cells * chunk.block[std::size_t(a)] + Kernel::first_node(l) -
                       lowest_node(l) - spacing * (run.cell[std::size_t(a)] - Scratch::reach + 1);
      }
    }
    set_range<Kernel, D, spacing>(points, run, lowest, scratch);
    add_points<Kernel, D, spacing>(points, run.begin, run.end, biot / cell_size_, cell_size_,
                                   transfer_ == TransferType::mls, lowest, scratch);
    flush<Kernel, spacing>(run.cell, scratch);
  }
}

template <int D>
template <class Kernel, int spacing>
void VolumeOperator<D>::scatter(const FlowPoints<D>& points, const std::vector<double>& biot,
                                ThreadPool& pool) {
  // Bodies one after the other, blocks of one colour at a time: each node's sum has one order.
  for (std::size_t body = 0; body < biot.size(); ++body) {
    for (std::int32_t colour = 0; colour < (1 << D); ++colour) {
      std::vector<const FlowChunk<D>*> together;
      for (const FlowChunk<D>& chunk : points.chunks) {
        if (chunk.body == std::int32_t(body) && chunk.colour == colour) together.push_back(&chunk);
      }
      pool.for_each(std::int64_t(together.size()), [&](std::int64_t c, int) {
        scatter_chunk<Kernel, spacing>(points, *together[std::size_t(c)], biot[body]);
      });
    }
  }
}

template <int D>
void VolumeOperator<D>::assemble(const FlowPoints<D>& points, const std::vector<double>& biot,
                                 ThreadPool& pool) {
  empty_.assign(record_.size(), 1);
  load_.assign(points.moments.empty() ? 0 : place_.size() * D, 0.0);
  switch (kernel_) {
    case KernelType::compact:
      if (lattice_.spacing() == 1) return scatter<Compact, 1>(points, biot, pool);
      return scatter<Compact, 2>(points, biot, pool);
    case KernelType::quadratic:
      return scatter<Quadratic, 2>(points, biot, pool);
    case KernelType::linear:
      return scatter<Linear, 2>(points, biot, pool);
  }
}

template class VolumeOperator<2>;
template class VolumeOperator<3>;

}  // namespace scree
