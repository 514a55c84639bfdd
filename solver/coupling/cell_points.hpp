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

/// The nodes that the points of a pressure cell touch, and what comes together at them. Zero but
/// between the points and flush().
template <class Kernel, int D, int spacing>
struct CellScratch {
  static constexpr int reach = spacing == 1 ? 3 : 2;  ///< groups an axis
  static constexpr int extent = reach * spacing;      ///< nodes an axis
  static constexpr int nodes = power(extent, D);
  static constexpr int corners = 1 << D;

  alignas(64) double q[Kernel::lattices][nodes][D][corners] = {};
  double load[Kernel::lattices][nodes][D] = {};
  bool touched[Kernel::lattices][nodes] = {};

  void clear() {
    for (int l = 0; l < Kernel::lattices; ++l) {
      for (int n = 0; n < nodes; ++n) {
        if (!touched[l][n]) continue;
        touched[l][n] = false;
        std::fill_n(q[l][n][0], D * corners, 0.0);
        std::fill_n(load[l][n], D, 0.0);
      }
    }
  }
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

/// Some points of a cell, which fit into the first cache: nodes and gradients [1/cell] field by
/// field, hats, times a scale, point by point.
template <class Kernel, int D>
struct PointGroup {
  static constexpr int nodes = power(Kernel::support, D), corners = 1 << D;
  static constexpr int most = 32;
  alignas(64) double gradient[Kernel::lattices][nodes][D][most];
  alignas(64) double hat[most][corners];
  alignas(64) std::int64_t base[Kernel::lattices][most];  ///< arena nodes, all lattices in a row
};

/// Hats of the corners axis by axis, start + slope x: 1 - x or x.
template <int D>
struct CornerSigns {
  alignas(64) double start[D][1 << D] = {};
  alignas(64) double slope[D][1 << D] = {};
  constexpr CornerSigns() {
    for (int a = 0; a < D; ++a) {
      for (int k = 0; k < (1 << D); ++k) {
        const bool upper = (k >> (D - 1 - a) & 1) != 0;
        start[a][k] = upper ? 0 : 1;
        slope[a][k] = upper ? 1 : -1;
      }
    }
  }
};

/// Products over the axes of a number of each node and axis, last axis fastest; from axis b on.
template <int D, int S, int b = 0, class V>
[[gnu::always_inline]] inline void node_products(const V (&factor)[D][S],
                                                 V (&product)[power(S, D)]) {
  if constexpr (b < D) {
    SCREE_UNROLL for (int s = power(S, b + 1) - 1; s >= 0; --s) {
      product[s] = b == 0 ? factor[0][s] : product[s / S] * factor[b][s % S];
    }
    node_products<D, S, b + 1>(factor, product);
  }
}

/// sum[s] = sum[0] + sum over axes of the node's digit times a step, from axis b on.
template <int D, int S, int b = 0, class V>
[[gnu::always_inline]] inline void node_sums(const V (&step)[D], V (&sum)[power(S, D)]) {
  if constexpr (b < D) {
    constexpr int known = power(S, b);
    V before[known];
    SCREE_UNROLL for (int s = 0; s < known; ++s) before[s] = sum[s];
    SCREE_UNROLL for (int s = 0; s < known; ++s) {
      sum[s * S] = before[s];
      SCREE_UNROLL for (int k = 1; k < S; ++k) sum[s * S + k] = before[s] + step[b] * double(k);
    }
    node_sums<D, S, b + 1>(step, sum);
  }
}

/// Gradients of mls: w D^-1 (x_i - x_p).
template <class Kernel, int D, class Point>
void affine_gradients(const Point& at, int to, PointGroup<Kernel, D>& group) {
  constexpr int S = Kernel::support;
  Lanes<double> one[D][D], inverse[D][D];
  SCREE_UNROLL for (int a = 0; a < D; ++a) {
    SCREE_UNROLL for (int b = 0; b < D; ++b) {
      one[a][b] = broadcast<Lanes<double>>(a == b ? 1.0 : 0.0);
    }
  }
  Kernel::template times_inverse_moment<Lanes<double>, D>(at, one, inverse);
  SCREE_UNROLL for (int l = 0; l < Kernel::lattices; ++l) {
    Lanes<double> weight[power(S, D)];
    node_products<D, S>(at.stencil.weight[l], weight);
    SCREE_UNROLL for (int a = 0; a < D; ++a) {
      Lanes<double> sum[power(S, D)];  // D^-1 (x_i - x_p)
      sum[0] = broadcast<Lanes<double>>(0.0);
      SCREE_UNROLL for (int b = 0; b < D; ++b) {
        sum[0] = mul_add(inverse[a][b], at.stencil.offset[l][b], sum[0]);
      }
      node_sums<D, S>(inverse[a], sum);
      for (int s = 0; s < power(S, D); ++s) {
        store(group.gradient[l][s][a] + to, sum[s] * weight[s]);
      }
    }
  }
}

/// Corners of a pressure cell that lie in one register.
template <int D>
using CornerPart = Pack<double, std::min(1 << D, lanes_of<RegisterLanes<double>>)>;

/// Hats of the corners at x, times a scale.
template <int D>
void scaled_hats(const double (&x)[D], double scale, double* hat) {
  using Part = CornerPart<D>;
  static constexpr CornerSigns<D> signs;
  SCREE_UNROLL for (int k = 0; k < (1 << D); k += lanes_of<Part>) {
    Part n = broadcast<Part>(scale);
    SCREE_UNROLL for (int a = 0; a < D; ++a) {
      n = n * mul_add(load<Part>(signs.slope[a] + k), broadcast<Part>(x[a]),
                      load<Part>(signs.start[a] + k));
    }
    store(hat + k, n);
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
  alignas(64) double pull[lanes_of<Lanes<double>>], place[D][lanes_of<Lanes<double>>];
  store(pull, load_any<Lanes<double>>(points.volume.data() + first) * scale);
  for (int a = 0; a < D; ++a) store(place[a], xi[a]);
  for (int i = 0; i < lanes_of<Lanes<double>>; ++i) {
    double x[D];
    for (int a = 0; a < D; ++a) x[a] = place[a][i];
    scaled_hats<D>(x, pull[i], group.hat[to + i]);
  }
}

/// Place of node s of a stencil among the nodes of the cell; -1: outside. On the rim of its
/// support, where rounding may decide, a node's weight is zero. base: of the stencil, in the arena;
/// lowest: of the arena's first node among the cell's.
template <class Kernel, int D, int spacing>
int cell_node(int base, const int (&lowest)[D], int s) {
  constexpr int extent = CellScratch<Kernel, D, spacing>::extent;
  int node = 0, stride = 1;
  bool inside = true;
  for (int a = D - 1; a >= 0; --a, stride *= extent) {
    const int digit = lowest[a] + base % Kernel::arena_extent + s % Kernel::support;
    inside = inside && digit >= 0 && digit < extent;
    node += digit * stride;
    base /= Kernel::arena_extent;
    s /= Kernel::support;
  }
  return inside ? node : -1;
}

/// Adds the products of gradients and hats of n points to `nodes` nodes of the cell, in registers:
/// gradient: of the first node, axis and point, most apart; q[s]: of a node, null: it is outside.
template <int D, int nodes, int most>
void add_products(const double* gradient, const double (*hat)[1 << D], int n, double* const* q) {
  using Part = CornerPart<D>;
  constexpr int parts = (1 << D) / lanes_of<Part>;
  Part sum[nodes][D][parts];
  const auto each = [](auto&& f) {
    SCREE_UNROLL for (int s = 0; s < nodes; ++s) {
      SCREE_UNROLL for (int a = 0; a < D; ++a) {
        SCREE_UNROLL for (int k = 0; k < parts; ++k) f(s, a, k, (a * parts + k) * lanes_of<Part>);
      }
    }
  };
  each([&](int s, int a, int k, int place) {
    sum[s][a][k] = q[s] == nullptr ? broadcast<Part>(0.0) : load<Part>(q[s] + place);
  });
  for (int i = 0; i < n; ++i) {
    Part n_k[parts];
    SCREE_UNROLL for (int k = 0; k < parts; ++k) n_k[k] = load<Part>(hat[i] + lanes_of<Part> * k);
    each([&](int s, int a, int k, int) {
      const Part x = broadcast<Part>(gradient[(s * D + a) * most + i]);
      sum[s][a][k] = mul_add(x, n_k[k], sum[s][a][k]);
    });
  }
  each([&](int s, int a, int k, int place) {
    if (q[s] != nullptr) store(q[s] + place, sum[s][a][k]);
  });
}

/// Nodes whose sums fit into the registers beside a point: a divisor of `nodes`.
template <int D>
constexpr int nodes_together(int nodes) {
  constexpr int registers = detail::register_bytes == 64 ? 32 : 16;
  constexpr int parts = (1 << D) / lanes_of<CornerPart<D>>;
  int together = 1;
  for (int n = 2; n <= nodes; ++n) {
    if (nodes % n == 0 && n * D * parts + parts + 1 < registers) together = n;
  }
  return together;
}

/// Adds the points of a group to the nodes of the cell; those that follow each other at the same
/// nodes together. lowest: of each lattice's arena, see cell_node().
template <class Kernel, int D, int spacing>
void add_group(const PointGroup<Kernel, D>& group, const int (&lowest)[Kernel::lattices][D],
               int count, CellScratch<Kernel, D, spacing>& scratch) {
  constexpr int nodes = PointGroup<Kernel, D>::nodes, most = PointGroup<Kernel, D>::most;
  constexpr int together = nodes_together<D>(nodes);
  for (int l = 0; l < Kernel::lattices; ++l) {
    const std::int64_t* base = group.base[l];
    for (int i = 0, n = 0; i < count; i += n) {
      n = 1;
      while (i + n < count && base[i + n] == base[i]) ++n;
      double* q[nodes];
      for (int s = 0; s < nodes; ++s) {
        const int from = int(base[i]) - l * power(Kernel::arena_extent, D);
        const int node = cell_node<Kernel, D, spacing>(from, lowest[l], s);
        q[s] = node >= 0 ? scratch.q[l][node][0] : nullptr;
        if (node >= 0) scratch.touched[l][node] = true;
      }
      for (int s = 0; s < nodes; s += together) {
        add_products<D, together, most>(&group.gradient[l][s][0][i], group.hat + i, n, q + s);
      }
    }
  }
}

/// Adds the moments of loaded points, the first of which has the number `first`.
template <class Kernel, int D, int spacing>
void add_moments(const FlowPoints<D>& points, std::int64_t first, int count, double cell_size,
                 const PointGroup<Kernel, D>& group, const int (&lowest)[Kernel::lattices][D],
                 CellScratch<Kernel, D, spacing>& scratch) {
  for (int i = 0; i < count; ++i) {
    if (points.loaded[std::size_t(first + i)] == 0) continue;
    const auto& moment = points.moments[std::size_t(first + i)];
    for (int l = 0; l < Kernel::lattices; ++l) {
      const int base = int(group.base[l][i]) - l * power(Kernel::arena_extent, D);
      for (int s = 0; s < PointGroup<Kernel, D>::nodes; ++s) {
        const int node = cell_node<Kernel, D, spacing>(base, lowest[l], s);
        if (node < 0) continue;
        for (int a = 0; a < D; ++a) {
          for (int b = 0; b < D; ++b) {
            scratch.load[l][node][a] += moment[std::size_t(a) * D + std::size_t(b)] *
                                        group.gradient[l][s][b][i] / cell_size;
          }
        }
      }
    }
  }
}

}  // namespace scree
