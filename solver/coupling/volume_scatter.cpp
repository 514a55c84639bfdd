// SPDX-License-Identifier: Apache-2.0
// Particles to the operator Q, a block of particles at a time.
#include <algorithm>
#include <cmath>

#include "solver/coupling/volume_operator.hpp"
#include "solver/transfer/compact.hpp"
#include "solver/transfer/linear.hpp"
#include "solver/transfer/quadratic.hpp"

namespace scree {
namespace {

/// The nodes around one block: where they lie in the grid and which pressure nodes they touch.
template <class Kernel, int D>
struct Surroundings {
  static constexpr int extent = Kernel::arena_extent;
  static constexpr int arena = Kernel::lattices * power(extent, D);
  std::int64_t record[arena];
  std::int32_t base[Kernel::lattices][D][extent];  ///< lowest pressure node, axis by axis

  Surroundings(const FlowChunk<D>& chunk, const Topology<D>& topology,
               const PressureLattice<D>& lattice, double reach) {
    for (int l = 0; l < Kernel::lattices; ++l) {
      for (int a = 0; a < D; ++a) {
        for (int i = 0; i < extent; ++i) {
          const double x =
              block_cells * chunk.block[std::size_t(a)] + Kernel::first_node(l) + i + 0.5 * l;
          base[l][a][i] = int(std::floor(lattice.coordinate(x - reach)));
        }
      }
    }
    const std::int32_t* near = topology.neighbours(chunk.grid_block);
    for (int n = 0; n < arena; ++n) {
      const int l = n / power(extent, D);
      int rest = n % power(extent, D), block = 0, local = 0;
      int index[D];
      for (int a = D - 1; a >= 0; --a, rest /= extent) {
        index[a] = Kernel::first_node(l) + rest % extent;
      }
      for (int a = 0; a < D; ++a) {
        block = 3 * block + block_of_node(index[a]) + 1;
        local = block_cells * local + node_in_block(index[a]);
      }
      record[n] =
          near[block] < 0
              ? -1
              : (std::int64_t(near[block]) * Kernel::lattices + l) * block_node_count<D> + local;
    }
  }
};

/// D^-1 [1/cells^2] of a particle.
template <class Kernel, int D, class Point>
void inverse_moment(const Point& point, double (&inverse)[D][D]) {
  double one[D][D] = {};
  for (int a = 0; a < D; ++a) one[a][a] = 1;
  Kernel::template times_inverse_moment<double, D>(point, one, inverse);
}

/// Node `n` of a particle's stencil on lattice l: its digits, axis by axis.
template <int D, int S>
void digits(int n, int (&digit)[D]) {
  for (int a = D - 1; a >= 0; --a, n /= S) digit[a] = n % S;
}

}  // namespace

/// Adds alpha V g_i N_j of every particle of a chunk.
template <int D>
template <class Kernel, bool affine>
// NOLINTNEXTLINE(readability-function-size): a kernel's body
void VolumeOperator<D>::scatter_chunk(const FlowPoints<D>& points, const FlowChunk<D>& chunk,
                                      const Topology<D>& topology) {
  constexpr int S = Kernel::support, E = Kernel::arena_extent, corners = 1 << D;
  const Surroundings<Kernel, D> around(chunk, topology, lattice_, reach_);
  int corner_at[corners];
  for (int k = 0; k < corners; ++k) {
    corner_at[k] = 0;
    for (int a = 0; a < D; ++a) corner_at[k] = corner_at[k] * width_ + (k >> (D - 1 - a) & 1);
  }
  for (std::int64_t i = chunk.begin; i < chunk.end; ++i) {
    const FlowPoint<D>& p = points.points[std::size_t(i)];
    const auto at = Kernel::template at<double, D>(p.local);
    double inverse[D][D];
    Slopes<double, D, Kernel::lattices, S> slopes;
    if constexpr (affine) {
      inverse_moment<Kernel, D>(at, inverse);
    } else {
      slopes = Kernel::template slopes<double, D>(at);
    }
    double n[corners];
    scree::hats<D>(p.xi, n);
    const double scale = p.biot * p.volume / cell_size_;
    for (double& value : n) value *= scale;
    for (int l = 0; l < Kernel::lattices; ++l) {
      int first[D];
      digits<D, E>(int(at.stencil.base[l]) - l * power(E, D), first);
      for (int s = 0; s < power(S, D); ++s) {
        int digit[D];
        digits<D, S>(s, digit);
        int arena = 0, hat = 0;
        bool touches = true;
        for (int a = 0; a < D; ++a) {
          arena = arena * E + first[a] + digit[a];
          const int below = p.cell[std::size_t(a)] - around.base[l][a][first[a] + digit[a]];
          // On the rim of its support, where rounding may decide, a node's weight is zero.
          touches = touches && below >= 0 && below + 1 < width_;
          hat = hat * width_ + below;
        }
        const std::int64_t record = around.record[l * power(E, D) + arena];
        if (!touches || record < 0) continue;
        double gradient[D];
        if constexpr (affine) {
          double weight = 1;
          for (int a = 0; a < D; ++a) weight *= at.stencil.weight[l][a][digit[a]];
          for (int a = 0; a < D; ++a) {
            gradient[a] = 0;
            for (int b = 0; b < D; ++b)
              gradient[a] += inverse[a][b] * (at.stencil.offset[l][b] + digit[b]);
            gradient[a] *= weight;
          }
        } else {
          for (int a = 0; a < D; ++a) {
            gradient[a] = 1;
            for (int b = 0; b < D; ++b) {
              gradient[a] *=
                  a == b ? slopes.slope[l][b][digit[b]] : at.stencil.weight[l][b][digit[b]];
            }
          }
        }
        double* q = q_.data() + std::size_t(record) * std::size_t(D * hats_) + hat;
        for (int a = 0; a < D; ++a) {
          for (int k = 0; k < corners; ++k) q[a * hats_ + corner_at[k]] += gradient[a] * n[k];
        }
        if (!p.loaded) continue;
        const auto& moment = points.moments[std::size_t(i)];
        for (int a = 0; a < D; ++a) {
          double& load = load_[std::size_t(record) * D + std::size_t(a)];
          for (int b = 0; b < D; ++b) {
            load += moment[std::size_t(a * D + b)] * gradient[b] / cell_size_;
          }
        }
      }
    }
  }
}

template <int D>
template <class Kernel>
void VolumeOperator<D>::scatter(const FlowPoints<D>& points, const Topology<D>& topology,
                                ThreadPool& pool) {
  const bool affine = transfer_ == TransferType::mls;
  std::int32_t bodies = 0;
  for (const FlowChunk<D>& chunk : points.chunks) bodies = std::max(bodies, chunk.body + 1);
  // Bodies one after the other, blocks of one colour at a time: each node's sum has one order.
  for (std::int32_t body = 0; body < bodies; ++body) {
    for (std::int32_t colour = 0; colour < (1 << D); ++colour) {
      std::vector<const FlowChunk<D>*> together;
      for (const FlowChunk<D>& chunk : points.chunks) {
        if (chunk.body == body && chunk.colour == colour) together.push_back(&chunk);
      }
      pool.for_each(std::int64_t(together.size()), [&](std::int64_t c, int) {
        if constexpr (Kernel::has_inverse_moment) {
          if (affine)
            return scatter_chunk<Kernel, true>(points, *together[std::size_t(c)], topology);
        }
        scatter_chunk<Kernel, false>(points, *together[std::size_t(c)], topology);
      });
    }
  }
}

template <int D>
void VolumeOperator<D>::assemble(const FlowPoints<D>& points, const Topology<D>& topology,
                                 ThreadPool& pool) {
  q_.assign(base_.size() * std::size_t(D * hats_), 0.0);
  load_.assign(points.moments.empty() ? 0 : base_.size() * D, 0.0);
  switch (kernel_) {
    case KernelType::compact:
      return scatter<Compact>(points, topology, pool);
    case KernelType::quadratic:
      return scatter<Quadratic>(points, topology, pool);
    case KernelType::linear:
      return scatter<Linear>(points, topology, pool);
  }
}

template class VolumeOperator<2>;
template class VolumeOperator<3>;

}  // namespace scree
