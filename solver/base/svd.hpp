// SPDX-License-Identifier: Apache-2.0
/// \file
/// Singular value decomposition of a 3x3 matrix.
#pragma once

#include "solver/base/eigen.hpp"

namespace scree {

/// A = u diag(values) v^T with rotations u, v (det = +1), values[0] >= values[1] >= |values[2]| and
/// sign(values[2]) = sign(det A): the convention in which an inverted element shows as one negative
/// stretch.
template <class V>
struct Svd {
  Mat3<V> u;
  Vec3<V> values;
  Mat3<V> v;
};

namespace detail {

template <class V>
SCREE_FN Vec3<V> column(const Mat3<V>& a, int j) {
  return {{a(0, j), a(1, j), a(2, j)}};
}

/// Rotates columns P and Q of b (and of v) so that they become orthogonal.
template <int P, int Q, class V>
SCREE_FN void orthogonalise_columns(Mat3<V>& b, Mat3<V>& v) {
  const Vec3<V> p = column(b, P), q = column(b, Q);
  const auto [c, s, t] = jacobi_rotation(dot(p, p), dot(q, q), dot(p, q));
  SCREE_UNROLL for (int i = 0; i < 3; ++i) {
    const V x = c * b(i, P) - s * b(i, Q), y = c * v(i, P) - s * v(i, Q);
    b(i, Q) = s * b(i, P) + c * b(i, Q);
    v(i, Q) = s * v(i, P) + c * v(i, Q);
    b(i, P) = x;
    v(i, P) = y;
  }
}

/// Exchanges columns P and Q where column Q is the longer one; one sign is flipped, so v stays a
/// rotation.
template <int P, int Q, class V>
SCREE_FN void sort_columns(Mat3<V>& b, Mat3<V>& v) {
  const Vec3<V> p = column(b, P), q = column(b, Q);
  const auto exchange = dot(p, p) < dot(q, q);
  SCREE_UNROLL for (int i = 0; i < 3; ++i) {
    const V x = b(i, P), y = v(i, P);
    b(i, P) = select(exchange, b(i, Q), x);
    b(i, Q) = select(exchange, -x, b(i, Q));
    v(i, P) = select(exchange, v(i, Q), y);
    v(i, Q) = select(exchange, -y, v(i, Q));
  }
}

/// Givens rotation of rows P and Q that makes b(Q, C) zero and b(P, C) >= 0; u collects its
/// transpose.
template <int P, int Q, int C, class V>
SCREE_FN void eliminate(Mat3<V>& b, Mat3<V>& u) {
  using T = Scalar<V>;
  constexpr T tiny = sizeof(T) == 4 ? T(1e-36) : T(1e-290);
  const V x = b(P, C), y = b(Q, C);
  const V square = x * x + y * y;
  const auto regular = square > tiny;
  const V inverse = rsqrt(select(regular, square, T(1)));
  const V c = select(regular, x * inverse, T(1)), s = select(regular, y * inverse, T(0));
  SCREE_UNROLL for (int i = 0; i < 3; ++i) {
    const V r = c * b(P, i) + s * b(Q, i), w = c * u(i, P) + s * u(i, Q);
    b(Q, i) = c * b(Q, i) - s * b(P, i);
    u(i, Q) = c * u(i, Q) - s * u(i, P);
    b(P, i) = r;
    u(i, P) = w;
  }
}

}  // namespace detail

/// One-sided Jacobi iteration on the columns (Hestenes; Golub and Van Loan, section 8.6.3), 5
/// (float) or 6 (double) sweeps, then Givens rotations for u, so that u is a rotation also where
/// singular values are zero or repeated. Error of the values and of u diag v^T: a few units in the
/// last place of the largest value. Branch-free.
template <class V>
SCREE_FN Svd<V> svd(const Mat3<V>& matrix) {
  using T = Scalar<V>;
  constexpr int sweeps = sizeof(T) == 4 ? 5 : 6;
  V scale = broadcast<V>(0);
  SCREE_UNROLL for (int i = 0; i < 3; ++i) {
    SCREE_UNROLL for (int j = 0; j < 3; ++j) scale = max(scale, abs(matrix(i, j)));
  }
  scale = select(scale > T(0), scale, T(1));
  Mat3<V> b = matrix * (T(1) / scale);
  Mat3<V> v = identity3<V>(), u = identity3<V>();
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    detail::orthogonalise_columns<0, 1>(b, v);
    detail::orthogonalise_columns<0, 2>(b, v);
    detail::orthogonalise_columns<1, 2>(b, v);
  }
  detail::sort_columns<0, 1>(b, v);
  detail::sort_columns<0, 2>(b, v);
  detail::sort_columns<1, 2>(b, v);
  detail::eliminate<0, 1, 0>(b, u);
  detail::eliminate<0, 2, 0>(b, u);
  detail::eliminate<1, 2, 1>(b, u);
  return {u, {{scale * b(0, 0), scale * b(1, 1), scale * b(2, 2)}}, v};
}

}  // namespace scree
