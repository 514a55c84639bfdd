// SPDX-License-Identifier: Apache-2.0
/// \file
/// Moments of the points of a pressure cell over the cell itself, in lanes.
#pragma once

#include <array>
#include <cstdint>

#include "solver/coupling/flow_points.hpp"
#include "solver/coupling/load_any.hpp"

namespace scree {

/// Sums over points of a cell; lanes add up points that are a vector apart.
template <int D>
struct PoreSums {
  using Wide = Lanes<double>;
  static constexpr int lines = D == 2 ? 1 : 3, others = 1 << (D - 1);
  Wide storage[3 * lines][3];  ///< capacity times products of hats, axis by axis
  Wide flow[D][lines][3];      ///< conductance over the part in the cell, see PoreCells
  Wide content[1 << D];        ///< content times hats
  Wide missed[1 << D];         ///< missed volume times hats
  Wide weight[D][others];      ///< conductance times the hats of the other axes
};

/// What some vectors of points bring to the sums.
template <int D>
struct PorePoints {
  using Wide = Lanes<double>;
  static constexpr int most = 8;  ///< vectors
  struct Axis {
    Wide x;           ///< of the point
    Wide square[3];   ///< (1 - x)^2, x (1 - x), x^2
    Wide product[3];  ///< their means over the box, times the share of it within the cell
    Wide hat[2];      ///< the same of 1 - x and x
    Wide share;
  };
  Axis axis[most][D];
  Wide capacity[most], content[most], missed[most], conductance[most];
};

/// Sets the parts of an axis of a vector of points: xi, half sides; the cell is between `bounds`.
template <class Axis, class Wide>
void set_axis(const Wide& x, const Wide& half, const double (&bounds)[2], Axis& axis) {
  const Wide y = 1.0 - x, from = max(x - half, bounds[0]), to = min(x + half, bounds[1]);
  axis.x = x;
  axis.square[0] = y * y;
  axis.square[1] = x * y;
  axis.square[2] = x * x;
  axis.share = (to - from) * (0.5 / half);
  const Wide first = axis.share * (0.5 * (from + to));
  const Wide second = axis.share * ((from * from + from * to + to * to) * (1.0 / 3));
  axis.product[0] = axis.share - 2.0 * first + second;
  axis.product[1] = first - second;
  axis.product[2] = second;
  axis.hat[0] = axis.share - first;
  axis.hat[1] = first;
}

template <int D>
void add_storage(const PorePoints<D>& points, int vectors, PoreSums<D>& sums) {
  using Wide = Lanes<double>;
  Wide sum[3 * PoreSums<D>::lines][3];
  SCREE_UNROLL for (int j = 0; j < 3 * PoreSums<D>::lines; ++j) {
    SCREE_UNROLL for (int k = 0; k < 3; ++k) sum[j][k] = sums.storage[j][k];
  }
  for (int v = 0; v < vectors; ++v) {
    const auto& axis = points.axis[v];
    SCREE_UNROLL for (int i = 0; i < 3; ++i) {
      const Wide first = points.capacity[v] * axis[0].square[i];
      if constexpr (D == 2) {
        SCREE_UNROLL for (int k = 0; k < 3; ++k) {
          sum[i][k] = mul_add(first, axis[1].square[k], sum[i][k]);
        }
      } else {
        SCREE_UNROLL for (int j = 0; j < 3; ++j) {
          const Wide both = first * axis[1].square[j];
          SCREE_UNROLL for (int k = 0; k < 3; ++k) {
            sum[3 * i + j][k] = mul_add(both, axis[2].square[k], sum[3 * i + j][k]);
          }
        }
      }
    }
  }
  SCREE_UNROLL for (int j = 0; j < 3 * PoreSums<D>::lines; ++j) {
    SCREE_UNROLL for (int k = 0; k < 3; ++k) sums.storage[j][k] = sum[j][k];
  }
}

/// Slopes along axis a: products of the hats of the others.
template <int a, int D>
void add_axis_flow(const PorePoints<D>& points, int vectors, PoreSums<D>& sums) {
  using Wide = Lanes<double>;
  constexpr int lines = PoreSums<D>::lines, b = a == 0 ? 1 : 0, c = a == 2 ? 1 : 2;
  Wide sum[lines][3];
  SCREE_UNROLL for (int i = 0; i < lines * 3; ++i) sum[i / 3][i % 3] = sums.flow[a][i / 3][i % 3];
  for (int v = 0; v < vectors; ++v) {
    const auto& axis = points.axis[v];
    const Wide own = points.conductance[v] * axis[a].share;
    SCREE_UNROLL for (int i = 0; i < lines * 3; ++i) {
      if constexpr (D == 2) {
        sum[0][i] = mul_add(own, axis[b].product[i], sum[0][i]);
      } else {
        sum[i / 3][i % 3] =
            mul_add(own * axis[b].product[i / 3], axis[c].product[i % 3], sum[i / 3][i % 3]);
      }
    }
  }
  SCREE_UNROLL for (int i = 0; i < lines * 3; ++i) sums.flow[a][i / 3][i % 3] = sum[i / 3][i % 3];
}

template <int D>
void add_flow(const PorePoints<D>& points, int vectors, PoreSums<D>& sums) {
  add_axis_flow<0>(points, vectors, sums);
  add_axis_flow<1>(points, vectors, sums);
  if constexpr (D == 3) add_axis_flow<2>(points, vectors, sums);
}

/// Content, missed volume, and conductance times what the slopes along each axis are made of.
template <int D>
void add_source(const PorePoints<D>& points, int vectors, PoreSums<D>& sums) {
  using Wide = Lanes<double>;
  for (int v = 0; v < vectors; ++v) {
    const auto& axis = points.axis[v];
    SCREE_UNROLL for (int k = 0; k < (1 << D); ++k) {
      Wide n = (k >> (D - 1) & 1) != 0 ? axis[0].x : 1.0 - axis[0].x;
      SCREE_UNROLL for (int a = 1; a < D; ++a) {
        n = n * ((k >> (D - 1 - a) & 1) != 0 ? axis[a].x : 1.0 - axis[a].x);
      }
      sums.content[k] = mul_add(points.content[v], n, sums.content[k]);
      sums.missed[k] = mul_add(points.missed[v], n, sums.missed[k]);
    }
    for (int a = 0; a < D; ++a) {
      const Wide own = points.conductance[v] * axis[a].share;
      SCREE_UNROLL for (int m = 0; m < PoreSums<D>::others; ++m) {
        Wide n = own;
        for (int b = D - 1, rest = m; b >= 0; --b) {
          if (b == a) continue;
          n = n * axis[b].hat[rest & 1];
          rest >>= 1;
        }
        sums.weight[a][m] = sums.weight[a][m] + n;
      }
    }
  }
}

/// Sum over lanes, in one order.
inline double sum_lanes(const Lanes<double>& x) {
  alignas(64) double part[lanes_of<Lanes<double>>];
  store(part, x);
  return ((part[0] + part[4]) + (part[2] + part[6])) + ((part[1] + part[5]) + (part[3] + part[7]));
}

}  // namespace scree
