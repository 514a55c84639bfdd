// SPDX-License-Identifier: Apache-2.0
/// \file
/// Eigenvalues and eigenvectors of a symmetric 3x3 tensor.
#pragma once

#include "solver/base/tensor.hpp"

namespace scree {

/// A = vectors diag(values) vectors^T. The columns of `vectors` are orthonormal, det = +1. Values
/// are not sorted.
template <class V>
struct SymEigen {
  Vec3<V> values;
  Mat3<V> vectors;
};

namespace detail {

/// Cosine and sine of the rotation that makes [[p, b], [b, q]] diagonal, and t = s/c; the smaller
/// of the two angles, |t| <= 1.
template <class V>
struct JacobiRotation {
  V c, s, t;
};

/// By the half-angle formulas, which need two reciprocal roots and no division:
/// cos 2x = |q - p|/h, h^2 = (q - p)^2 + 4 b^2.
template <class V>
SCREE_FN JacobiRotation<V> jacobi_rotation(V p, V q, V b) {
  using T = Scalar<V>;
  // Keeps the diagonal case, 0/0, a rotation by zero.
  constexpr T tiny = sizeof(T) == 4 ? T(1e-17) : T(1e-140);
  const V d = q - p;
  const V gap = abs(d) + tiny;
  V twice = b + b;
  // In single precision converged entries would have subnormal squares, which cost a hundred cycles
  // each.
  if constexpr (sizeof(T) == 4) twice = select(abs(twice) > tiny, twice, T(0));
  const V inverse = rsqrt(mul_add(gap, gap, twice * twice));
  const V cc = mul_add(T(0.5) * gap, inverse, broadcast<V>(T(0.5)));
  const V secant = rsqrt(cc);
  const V size = T(0.5) * twice * inverse * secant;
  const V s = select(d < T(0), -size, size);
  return {cc * secant, s, s * secant};
}

/// One rotation in the plane (P, Q); R is the third axis.
template <int P, int Q, class V>
SCREE_FN void jacobi_step(Mat3<V>& a, Mat3<V>& u) {
  constexpr int R = 3 - P - Q;
  const auto [c, s, t] = jacobi_rotation(a(P, P), a(Q, Q), a(P, Q));
  const V shift = t * a(P, Q);
  a(P, P) = a(P, P) - shift;
  a(Q, Q) = a(Q, Q) + shift;
  a(P, Q) = broadcast<V>(0);
  // Only the upper triangle is kept: the entry between axis R and axis P (or Q).
  V& pr = P < R ? a(P, R) : a(R, P);
  V& qr = Q < R ? a(Q, R) : a(R, Q);
  const V x = c * pr - s * qr;
  qr = s * pr + c * qr;
  pr = x;
  SCREE_UNROLL for (int i = 0; i < 3; ++i) {
    const V y = c * u(i, P) - s * u(i, Q);
    u(i, Q) = s * u(i, P) + c * u(i, Q);
    u(i, P) = y;
  }
}

}  // namespace detail

/// Cyclic Jacobi iteration (Golub and Van Loan, Matrix Computations, section 8.5) with a fixed
/// number of sweeps, hence no branch. Residual |A - U diag U^T| and
/// values: a few units in the last place of |A|, also for repeated values. Entries between 1e-15
/// and 1e17 (float), 1e-140 and 1e150 (double); smaller ones count as zero.
template <class V>
SCREE_FN SymEigen<V> eigen_symmetric(const Sym3<V>& tensor) {
  // Measured over 1e7 random tensors: largest off-diagonal 1.4e-5 after 3 sweeps, 1e-20 after 4.
  constexpr int sweeps = 4;
  Mat3<V> a = to_mat(tensor);
  Mat3<V> u = identity3<V>();
  SCREE_UNROLL for (int sweep = 0; sweep < sweeps; ++sweep) {
    detail::jacobi_step<0, 1>(a, u);
    detail::jacobi_step<0, 2>(a, u);
    detail::jacobi_step<1, 2>(a, u);
  }
  return {{{a(0, 0), a(1, 1), a(2, 2)}}, u};
}

}  // namespace scree
