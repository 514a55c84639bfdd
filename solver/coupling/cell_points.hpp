// SPDX-License-Identifier: Apache-2.0
/// \file
/// Points of a pressure cell to the velocity nodes that they touch: products of gradients and hats.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "solver/coupling/flow_points.hpp"
#include "solver/coupling/load_any.hpp"

namespace scree {

/// The nodes of one lattice that the points of a pressure cell touch, and what comes together at
/// them. Zero but between the points and flush().
template <class Kernel, int D, int spacing>
struct CellScratch {
  static constexpr int reach = spacing == 1 ? 3 : 2;  ///< groups an axis
  static constexpr int extent = reach * spacing;      ///< nodes an axis
  static constexpr int nodes = power(extent, D);
  static constexpr int corners = 1 << D;

  alignas(64) double q[nodes][D][corners] = {};
  double load[nodes][D] = {};
  int lattice = 0;

  /// Nodes that points of the run touch, lattice by lattice and axis by axis, the last one
  /// included.
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

/// Some points of a cell, field by field: nodes, gradients [1/cell] and hats, these times a scale.
template <class Kernel, int D>
struct PointGroup {
  static constexpr int nodes = power(Kernel::support, D), corners = 1 << D;
  static constexpr int most = 64;
  alignas(64) double gradient[Kernel::lattices][nodes][D][most];
  alignas(64) double hat[most][corners];
  alignas(64) std::int64_t base[Kernel::lattices][most];  ///< arena node, lattice by lattice
};

/// Gradients of mls: w D^-1 (x_i - x_p).
template <class Kernel, int D, class Point>
void affine_gradients(const Point& at, int to, PointGroup<Kernel, D>& group) {
  constexpr int S = Kernel::support;
  Lanes<double> one[D][D], inverse[D][D];
  for (int a = 0; a < D; ++a) {
    for (int b = 0; b < D; ++b) one[a][b] = broadcast<Lanes<double>>(a == b ? 1.0 : 0.0);
  }
  Kernel::template times_inverse_moment<Lanes<double>, D>(at, one, inverse);
  for (int l = 0; l < Kernel::lattices; ++l) {
    for (int s = 0; s < power(S, D); ++s) {
      Lanes<double> weight = broadcast<Lanes<double>>(1.0), offset[D];
      for (int a = D - 1, rest = s; a >= 0; --a, rest /= S) {
        weight = weight * at.stencil.weight[l][a][rest % S];
        offset[a] = at.stencil.offset[l][a] + double(rest % S);
      }
      for (int a = 0; a < D; ++a) {
        Lanes<double> sum = inverse[a][0] * offset[0];
        for (int b = 1; b < D; ++b) sum = mul_add(inverse[a][b], offset[b], sum);
        store(group.gradient[l][s][a] + to, sum * weight);
      }
    }
  }
}

/// Gradients of the weights.
template <class Kernel, int D, class Point>
void weight_gradients(const Point& at, int to, PointGroup<Kernel, D>& group) {
  constexpr int S = Kernel::support;
  const auto slopes = Kernel::template slopes<Lanes<double>, D>(at);
  for (int l = 0; l < Kernel::lattices; ++l) {
    for (int s = 0; s < power(S, D); ++s) {
      for (int a = 0; a < D; ++a) {
        Lanes<double> g = broadcast<Lanes<double>>(1.0);
        for (int b = D - 1, rest = s; b >= 0; --b, rest /= S) {
          g = g * (a == b ? slopes.slope[l][b][rest % S] : at.stencil.weight[l][b][rest % S]);
        }
        store(group.gradient[l][s][a] + to, g);
      }
    }
  }
}

/// Sets a vector of points from place `to` on; first: the points' number.
template <class Kernel, int D>
void fill_points(const FlowPoints<D>& points, std::int64_t first, double scale, bool affine, int to,
                 PointGroup<Kernel, D>& group) {
  Lanes<double> u[D], xi[D];
  for (int a = 0; a < D; ++a) {
    u[a] = load_any<Lanes<double>>(points.local[std::size_t(a)].data() + first);
    xi[a] = load_any<Lanes<double>>(points.xi[std::size_t(a)].data() + first);
  }
  const auto at = Kernel::template at<Lanes<double>, D>(u);
  if constexpr (Kernel::has_inverse_moment) {
    if (affine) {
      affine_gradients<Kernel, D>(at, to, group);
    } else {
      weight_gradients<Kernel, D>(at, to, group);
    }
  } else {
    weight_gradients<Kernel, D>(at, to, group);
  }
  for (int l = 0; l < Kernel::lattices; ++l) store(group.base[l] + to, at.stencil.base[l]);
  const Lanes<double> pull = load_any<Lanes<double>>(points.volume.data() + first) * scale;
  alignas(64) double hats[1 << D][lanes_of<Lanes<double>>];
  for (int k = 0; k < (1 << D); ++k) {
    Lanes<double> n = pull;
    for (int a = 0; a < D; ++a) n = n * ((k >> (D - 1 - a) & 1) != 0 ? xi[a] : 1.0 - xi[a]);
    store(hats[k], n);
  }
  for (int i = 0; i < lanes_of<Lanes<double>>; ++i) {
    for (int k = 0; k < (1 << D); ++k) group.hat[to + i][k] = hats[k][i];
  }
}

/// Points of a group by the lowest node that they touch on a lattice: those of one node lie
/// together.
template <class Kernel, int D, int spacing>
struct NodeOrder {
  using Scratch = CellScratch<Kernel, D, spacing>;
  /// Nodes that lie outside by rounding, where S > 2.
  static constexpr int rim = Kernel::support > 2 ? 1 : 0;
  static constexpr int side = Scratch::extent + 2 * rim, keys = power(side, D);
  static constexpr int most = PointGroup<Kernel, D>::most;
  std::uint8_t point[most];
  std::uint8_t key[most];  ///< in the order of the points
  std::uint8_t begin[keys + 1];

  /// base: arena nodes; shift[a]: place of the arena's lowest node among the cell's.
  void sort(const std::int64_t* base, int first_base, const int (&shift)[D], int count) {
    static_assert(keys < 256 && most < 256);
    static constexpr ArenaNodes<Kernel, D, side> arena;
    int from = 0;
    for (int a = 0; a < D; ++a) from = from * side + shift[a] + rim;
    std::fill(begin, begin + keys + 1, std::uint8_t(0));
    for (int i = 0; i < count; ++i) {
      const int node = from + arena.at[std::size_t(base[i] - first_base)];
      key[i] = std::uint8_t(node);
      ++begin[node + 1];
    }
    for (int k = 0; k < keys; ++k) begin[k + 1] = std::uint8_t(begin[k + 1] + begin[k]);
    std::uint8_t next[keys];
    std::copy(begin, begin + keys, next);
    for (int i = 0; i < count; ++i) point[next[key[i]]++] = std::uint8_t(i);
  }

  /// Node s of a stencil whose lowest node has the key, among those of the cell; -1: outside. On
  /// the rim of its support, where rounding may decide, a node's weight is zero.
  static int node(int key, int s) {
    int node = 0, stride = 1;
    bool inside = true;
    for (int a = 0; a < D; ++a, stride *= Scratch::extent) {
      const int digit = key % side - rim + s % Kernel::support;
      if constexpr (rim > 0) inside = inside && digit >= 0 && digit < Scratch::extent;
      node += digit * stride;
      key /= side;
      s /= Kernel::support;
    }
    return inside ? node : -1;
  }
};

/// Adds the products of gradients and hats of n points to `nodes` nodes of the cell, in registers:
/// gradient: of the first node and axis, most apart; q[s]: of a node, null: it is outside.
template <int D, int nodes, int most>
void add_products(const double* gradient, const double (*hat)[1 << D], const std::uint8_t* point,
                  int n, double* const* q) {
  using Part = Pack<double, 4>;
  constexpr int parts = (1 << D) / 4, rows = nodes * D;
  Part sum[rows][parts];
  SCREE_UNROLL for (int r = 0; r < rows; ++r) {
    const double* from = q[r / D];
    SCREE_UNROLL for (int k = 0; k < parts; ++k) {
      sum[r][k] =
          from == nullptr ? broadcast<Part>(0.0) : load<Part>(from + (r % D * parts + k) * 4);
    }
  }
  for (int i = 0; i < n; ++i) {
    const double* g = gradient + point[i];
    const double* h = hat[point[i]];
    Part n_k[parts];
    SCREE_UNROLL for (int k = 0; k < parts; ++k) n_k[k] = load<Part>(h + 4 * k);
    SCREE_UNROLL for (int r = 0; r < rows; ++r) {
      const Part x = broadcast<Part>(g[r * most]);
      SCREE_UNROLL for (int k = 0; k < parts; ++k) sum[r][k] = mul_add(x, n_k[k], sum[r][k]);
    }
  }
  SCREE_UNROLL for (int r = 0; r < rows; ++r) {
    if (q[r / D] == nullptr) continue;
    SCREE_UNROLL for (int k = 0; k < parts; ++k) {
      store(q[r / D] + (r % D * parts + k) * 4, sum[r][k]);
    }
  }
}

/// Adds the points of a group to the nodes of a lattice.
template <class Kernel, int D, int spacing>
void add_group(const PointGroup<Kernel, D>& group, const NodeOrder<Kernel, D, spacing>& order,
               CellScratch<Kernel, D, spacing>& scratch) {
  using Order = NodeOrder<Kernel, D, spacing>;
  constexpr int nodes = PointGroup<Kernel, D>::nodes, most = Order::most;
  constexpr int together = D == 3 ? 2 : 4;  // nodes whose sums fit into the registers
  const int l = scratch.lattice;
  for (int key = 0; key < Order::keys; ++key) {
    const int begin = order.begin[key], n = order.begin[key + 1] - begin;
    if (n == 0) continue;
    double* q[nodes];
    for (int s = 0; s < nodes; ++s) {
      const int node = Order::node(key, s);
      q[s] = node >= 0 ? scratch.q[node][0] : nullptr;
    }
    int s = 0;
    for (; s + together <= nodes; s += together) {
      add_products<D, together, most>(group.gradient[l][s][0], group.hat, order.point + begin, n,
                                      q + s);
    }
    for (; s < nodes; ++s) {
      add_products<D, 1, most>(group.gradient[l][s][0], group.hat, order.point + begin, n, q + s);
    }
  }
}

/// Adds the moments of loaded points, the first of which has the number `first`.
template <class Kernel, int D, int spacing>
void add_moments(const FlowPoints<D>& points, std::int64_t first, int count, double cell_size,
                 const PointGroup<Kernel, D>& group, const NodeOrder<Kernel, D, spacing>& order,
                 CellScratch<Kernel, D, spacing>& scratch) {
  using Order = NodeOrder<Kernel, D, spacing>;
  for (int i = 0; i < count; ++i) {
    if (points.loaded[std::size_t(first + i)] == 0) continue;
    const auto& moment = points.moments[std::size_t(first + i)];
    for (int s = 0; s < PointGroup<Kernel, D>::nodes; ++s) {
      const int node = Order::node(order.key[i], s);
      if (node < 0) continue;
      for (int a = 0; a < D; ++a) {
        for (int b = 0; b < D; ++b) {
          scratch.load[node][a] += moment[std::size_t(a) * D + std::size_t(b)] *
                                   group.gradient[scratch.lattice][s][b][i] / cell_size;
        }
      }
    }
  }
}

}  // namespace scree
