// SPDX-License-Identifier: Apache-2.0
/// \file
/// Boxes of particles, cut at the faces of pressure cells: what their parts give to the moments of
/// a cell.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "solver/base/pack.hpp"

namespace scree {

/// Over the part of a box within one cell, in one axis: shares of the box.
struct BoxSlice {
  alignas(32) double product[4];  ///< integrals of (1 - x)^2, x (1 - x) and x^2; zero
  double hat[2];                  ///< of 1 - x and x
  double share;                   ///< of the box's length
  std::int32_t shift;             ///< of the cell, from the particle's
};

/// Parts of a box thinner than this [cells] are rounding.
inline constexpr double least_part = 1e-12;

/// From the share and the means of x and x^2 over the part.
inline BoxSlice slice(std::int32_t shift, double share, double mean, double square) {
  const double first = share * mean, second = share * square;
  return {{share - 2 * first + second, first - second, second, 0},
          {share - first, first},
          share,
          shift};
}

/// A part from a to b in the coordinate of the cell; `per`: 1 over the length of the box.
inline BoxSlice part(std::int32_t shift, double a, double b, double per) {
  return slice(shift, (b - a) * per, 0.5 * (a + b), (a * a + a * b + b * b) / 3);
}

/// A box from xi - half to xi + half, cut at whole numbers. Thinner parts than rounding are left.
inline int cut(double xi, double half, BoxSlice (&slices)[4]) {
  const double lower = xi - half, upper = xi + half;
  if (lower >= 0 && upper <= 1) {
    slices[0] = slice(0, 1, xi, xi * xi + half * half / 3);
    return 1;
  }
  const double per = 0.5 / half;
  int count = 0;
  for (std::int32_t c = std::int32_t(std::floor(lower)); c < upper && count < 4; ++c) {
    const double a = std::max(lower - c, 0.0), b = std::min(upper - c, 1.0);
    if (b - a > least_part) slices[count++] = part(c, a, b, per);
  }
  return count;
}

inline void add_line(double scale, const double* products, double* sums) {
  store(sums, mul_add(broadcast<Pack<double, 4>>(scale), load<Pack<double, 4>>(products),
                      load<Pack<double, 4>>(sums)));
}

/// Adds the part of a box that `s` cuts out to the moments of the flow.
template <int D, int lines>
void add_part(const BoxSlice* const (&s)[D], double flow, double (&moments)[D][lines][4]) {
  if constexpr (D == 2) {
    add_line(flow * s[0]->share, s[1]->product, moments[0][0]);
    add_line(flow * s[1]->share, s[0]->product, moments[1][0]);
  } else {
    const double x = flow * s[0]->share, y = flow * s[1]->share, z = flow * s[2]->share;
    for (int i = 0; i < 3; ++i) {
      add_line(x * s[1]->product[i], s[2]->product, moments[0][i]);
      add_line(y * s[0]->product[i], s[2]->product, moments[1][i]);
      add_line(z * s[0]->product[i], s[1]->product, moments[2][i]);
    }
  }
}

/// Adds the same part, times a vector, to the source of the cell.
template <int D>
void add_weight(const BoxSlice* const (&s)[D], const double (&weight)[D], double* source) {
  for (int a = 0; a < D; ++a) {
    if (weight[a] == 0) continue;
    const double up = weight[a] * s[a]->share;
    for (int k = 0; k < (1 << D); ++k) {
      double slope = (k >> (D - 1 - a) & 1) != 0 ? up : -up;
      for (int b = 0; b < D; ++b) {
        if (b != a) slope *= s[b]->hat[k >> (D - 1 - b) & 1];
      }
      source[k] += slope;
    }
  }
}

/// The part of boxes within the particles' own cell, in one axis, in lanes.
struct LaneSlice {
  Lanes<double> product[3], hat[2], share;
  MaskOf<Lanes<double>> cut;  ///< another cell has a part
};

inline LaneSlice own_slice(const Lanes<double>& xi, const Lanes<double>& half) {
  LaneSlice s;
  const Lanes<double> lower = xi - half, upper = xi + half;
  const Lanes<double> a = max(lower, 0.0), b = min(upper, 1.0);
  s.cut = (lower < -least_part) | (upper > broadcast<Lanes<double>>(1 + least_part));
  s.share = (b - a) * (0.5 / half);
  const Lanes<double> first = s.share * (0.5 * (a + b));
  const Lanes<double> second = s.share * ((a * a + a * b + b * b) * (1.0 / 3));
  s.product[0] = s.share - 2.0 * first + second;
  s.product[1] = first - second;
  s.product[2] = second;
  s.hat[0] = s.share - first;
  s.hat[1] = first;
  return s;
}

inline double sum_of(const Lanes<double>& x) {
  alignas(64) double lanes[lanes_of<Lanes<double>>];
  store(lanes, x);
  return ((lanes[0] + lanes[4]) + (lanes[1] + lanes[5])) +
         ((lanes[2] + lanes[6]) + (lanes[3] + lanes[7]));
}

/// What the points of a run give to their own cell, in lanes.
template <int D>
struct LaneSums {
  static constexpr int corners = 1 << D, lines = D == 2 ? 1 : 3, squares = 3 * lines;
  Lanes<double> storage[squares][3], flow[D][lines][3], source[corners];

  LaneSums() {
    for (auto& line : storage) std::fill(line, line + 3, broadcast<Lanes<double>>(0.0));
    for (auto& axis : flow) {
      for (auto& line : axis) std::fill(line, line + 3, broadcast<Lanes<double>>(0.0));
    }
    std::fill(source, source + corners, broadcast<Lanes<double>>(0.0));
  }
  void add_storage(const Lanes<double> (&xi)[D], const Lanes<double>& capacity,
                   const Lanes<double>& content) {
    Lanes<double> e[D][3], hat[D][2];
    for (int a = 0; a < D; ++a) {
      hat[a][0] = 1.0 - xi[a];
      hat[a][1] = xi[a];
      e[a][0] = hat[a][0] * hat[a][0];
      e[a][1] = hat[a][0] * hat[a][1];
      e[a][2] = hat[a][1] * hat[a][1];
    }
    for (int j = 0; j < squares; ++j) {
      Lanes<double> scale = capacity * e[0][D == 2 ? j : j / 3];
      if constexpr (D == 3) scale = scale * e[1][j % 3];
      for (int k = 0; k < 3; ++k) storage[j][k] = mul_add(scale, e[D - 1][k], storage[j][k]);
    }
    for (int k = 0; k < corners; ++k) {
      Lanes<double> n = content;
      for (int a = 0; a < D; ++a) n = n * hat[a][k >> (D - 1 - a) & 1];
      source[k] = source[k] + n;
    }
  }
  void add_flow(const LaneSlice (&s)[D], const Lanes<double>& scale) {
    for (int a = 0; a < D; ++a) {
      const Lanes<double> along = scale * s[a].share;
      const LaneSlice& outer = s[a == 0 ? 1 : 0];
      const LaneSlice& inner = s[a == D - 1 ? D - 2 : D - 1];
      for (int i = 0; i < lines; ++i) {
        const Lanes<double> x = D == 2 ? along : along * outer.product[i];
        for (int k = 0; k < 3; ++k) flow[a][i][k] = mul_add(x, inner.product[k], flow[a][i][k]);
      }
    }
  }
  /// weight: of an axis, and of the slopes along it.
  void add_weight(const LaneSlice (&s)[D], const Lanes<double>& weight, int axis) {
    const Lanes<double> up = weight * s[axis].share;
    for (int k = 0; k < corners; ++k) {
      Lanes<double> slope = (k >> (D - 1 - axis) & 1) != 0 ? up : -up;
      for (int b = 0; b < D; ++b) {
        if (b != axis) slope = slope * s[b].hat[k >> (D - 1 - b) & 1];
      }
      source[k] = source[k] + slope;
    }
  }
};

}  // namespace scree
