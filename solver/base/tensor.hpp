// SPDX-License-Identifier: Apache-2.0
/// \file
/// 3-vectors, 3x3 matrices and symmetric 3x3 tensors over a scalar or SIMD lanes V. Aggregates that
/// hold V's only (sizeof = n sizeof(V)), always three-dimensional: plane strain has F33 = 1.
#pragma once

#include "solver/base/pack.hpp"

namespace scree {

/// Three components.
template <class V>
struct Vec3 {
  V v[3];
  SCREE_FN V& operator[](int i) { return v[i]; }
  SCREE_FN const V& operator[](int i) const { return v[i]; }
};

/// Row-major 3x3 matrix: m[i][j] is row i, column j.
template <class V>
struct Mat3 {
  V m[3][3];
  SCREE_FN V& operator()(int i, int j) { return m[i][j]; }
  SCREE_FN const V& operator()(int i, int j) const { return m[i][j]; }
};

/// Symmetric tensor, each component stored once.
template <class V>
struct Sym3 {
  V xx, xy, xz, yy, yz, zz;
  /// Component (i, j) = (j, i), for reading.
  SCREE_FN V operator()(int i, int j) const {
    const int k = i + j;
    if (i == 1 && j == 1) return yy;
    return k == 0 ? xx : k == 1 ? xy : k == 2 ? xz : k == 3 ? yz : zz;
  }
};

// ---- vectors ----

template <class V>
SCREE_FN Vec3<V> operator+(const Vec3<V>& a, const Vec3<V>& b) {
  return {{a[0] + b[0], a[1] + b[1], a[2] + b[2]}};
}
template <class V>
SCREE_FN Vec3<V> operator-(const Vec3<V>& a, const Vec3<V>& b) {
  return {{a[0] - b[0], a[1] - b[1], a[2] - b[2]}};
}
template <class V>
SCREE_FN Vec3<V> operator*(const Vec3<V>& a, std::type_identity_t<V> b) {
  return {{a[0] * b, a[1] * b, a[2] * b}};
}
template <class V>
SCREE_FN V dot(const Vec3<V>& a, const Vec3<V>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class V>
SCREE_FN Vec3<V> cross(const Vec3<V>& a, const Vec3<V>& b) {
  return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
}
template <class V>
SCREE_FN V norm(const Vec3<V>& a) {
  return sqrt(dot(a, a));
}

// ---- matrices ----

template <class V>
SCREE_FN Mat3<V> zero3() {
  const V o = broadcast<V>(0);
  return {{{o, o, o}, {o, o, o}, {o, o, o}}};
}
template <class V>
SCREE_FN Mat3<V> identity3() {
  const V o = broadcast<V>(0), l = broadcast<V>(1);
  return {{{l, o, o}, {o, l, o}, {o, o, l}}};
}
template <class V>
SCREE_FN Mat3<V> operator+(const Mat3<V>& a, const Mat3<V>& b) {
  Mat3<V> r;
  SCREE_UNROLL for (int i = 0; i < 3; ++i) {
    SCREE_UNROLL for (int j = 0; j < 3; ++j) r(i, j) = a(i, j) + b(i, j);
  }
  return r;
}
template <class V>
SCREE_FN Mat3<V> operator-(const Mat3<V>& a, const Mat3<V>& b) {
  Mat3<V> r;
  SCREE_UNROLL for (int i = 0; i < 3; ++i) {
    SCREE_UNROLL for (int j = 0; j < 3; ++j) r(i, j) = a(i, j) - b(i, j);
  }
  return r;
}
template <class V>
SCREE_FN Mat3<V> operator*(const Mat3<V>& a, std::type_identity_t<V> b) {
  Mat3<V> r;
  SCREE_UNROLL for (int i = 0; i < 3; ++i) {
    SCREE_UNROLL for (int j = 0; j < 3; ++j) r(i, j) = a(i, j) * b;
  }
  return r;
}
template <class V>
SCREE_FN Vec3<V> operator*(const Mat3<V>& a, const Vec3<V>& b) {
  Vec3<V> r;
  SCREE_UNROLL for (int i = 0; i < 3; ++i) r[i] = a(i, 0) * b[0] + a(i, 1) * b[1] + a(i, 2) * b[2];
  return r;
}
template <class V>
SCREE_FN Mat3<V> operator*(const Mat3<V>& a, const Mat3<V>& b) {
  Mat3<V> r;
  SCREE_UNROLL for (int i = 0; i < 3; ++i) {
    SCREE_UNROLL for (int j = 0; j < 3; ++j) {
      r(i, j) = a(i, 0) * b(0, j) + a(i, 1) * b(1, j) + a(i, 2) * b(2, j);
    }
  }
  return r;
}
template <class V>
SCREE_FN Mat3<V> mul(const Mat3<V>& a, const Mat3<V>& b) {
  return a * b;
}
template <class V>
SCREE_FN Mat3<V> transpose(const Mat3<V>& a) {
  Mat3<V> r;
  SCREE_UNROLL for (int i = 0; i < 3; ++i) {
    SCREE_UNROLL for (int j = 0; j < 3; ++j) r(i, j) = a(j, i);
  }
  return r;
}
template <class V>
SCREE_FN V trace(const Mat3<V>& a) {
  return a(0, 0) + a(1, 1) + a(2, 2);
}
/// Matrix of cofactors: a * transpose(cofactor(a)) = det(a) I.
template <class V>
SCREE_FN Mat3<V> cofactor(const Mat3<V>& a) {
  Mat3<V> r;
  SCREE_UNROLL for (int i = 0; i < 3; ++i) {
    SCREE_UNROLL for (int j = 0; j < 3; ++j) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      r(i, j) = a(i1, j1) * a(i2, j2) - a(i1, j2) * a(i2, j1);
    }
  }
  return r;
}
template <class V>
SCREE_FN V det(const Mat3<V>& a) {
  return a(0, 0) * (a(1, 1) * a(2, 2) - a(1, 2) * a(2, 1)) +
         a(0, 1) * (a(1, 2) * a(2, 0) - a(1, 0) * a(2, 2)) +
         a(0, 2) * (a(1, 0) * a(2, 1) - a(1, 1) * a(2, 0));
}
/// det(I + L) - 1 = tr L + the principal minors + det L, to full relative accuracy for small L:
/// without a cancellation against 1.
template <class V>
SCREE_FN V volume_growth(const Mat3<V>& L) {
  const V minors = L(0, 0) * L(1, 1) - L(0, 1) * L(1, 0) + L(1, 1) * L(2, 2) - L(1, 2) * L(2, 1) +
                   L(2, 2) * L(0, 0) - L(2, 0) * L(0, 2);
  return trace(L) + minors + det(L);
}

/// Inverse by cofactors; det(a) must not be zero. Relative error about cond(a) units in the last
/// place.
template <class V>
SCREE_FN Mat3<V> inverse(const Mat3<V>& a) {
  const Mat3<V> c = cofactor(a);
  const V d = Scalar<V>(1) / (a(0, 0) * c(0, 0) + a(0, 1) * c(0, 1) + a(0, 2) * c(0, 2));
  return transpose(c) * d;
}
/// Frobenius norm.
template <class V>
SCREE_FN V norm(const Mat3<V>& a) {
  V s = broadcast<V>(0);
  SCREE_UNROLL for (int i = 0; i < 3; ++i) {
    SCREE_UNROLL for (int j = 0; j < 3; ++j) s = s + a(i, j) * a(i, j);
  }
  return sqrt(s);
}

// ---- symmetric tensors ----

template <class V>
SCREE_FN Sym3<V> operator+(const Sym3<V>& a, const Sym3<V>& b) {
  return {a.xx + b.xx, a.xy + b.xy, a.xz + b.xz, a.yy + b.yy, a.yz + b.yz, a.zz + b.zz};
}
template <class V>
SCREE_FN Sym3<V> operator-(const Sym3<V>& a, const Sym3<V>& b) {
  return {a.xx - b.xx, a.xy - b.xy, a.xz - b.xz, a.yy - b.yy, a.yz - b.yz, a.zz - b.zz};
}
template <class V>
SCREE_FN Sym3<V> operator*(const Sym3<V>& a, std::type_identity_t<V> b) {
  return {a.xx * b, a.xy * b, a.xz * b, a.yy * b, a.yz * b, a.zz * b};
}
template <class V>
SCREE_FN V trace(const Sym3<V>& a) {
  return a.xx + a.yy + a.zz;
}
template <class V>
SCREE_FN V det(const Sym3<V>& a) {
  return a.xx * (a.yy * a.zz - a.yz * a.yz) - a.xy * (a.xy * a.zz - a.yz * a.xz) +
         a.xz * (a.xy * a.yz - a.yy * a.xz);
}
/// a - tr(a)/3 I
template <class V>
SCREE_FN Sym3<V> deviator(const Sym3<V>& a) {
  const V m = trace(a) * Scalar<V>(1.0 / 3.0);
  return {a.xx - m, a.xy, a.xz, a.yy - m, a.yz, a.zz - m};
}
/// Frobenius norm of the full tensor.
template <class V>
SCREE_FN V norm(const Sym3<V>& a) {
  const V off = a.xy * a.xy + a.xz * a.xz + a.yz * a.yz;
  return sqrt(a.xx * a.xx + a.yy * a.yy + a.zz * a.zz + (off + off));
}
template <class V>
SCREE_FN Mat3<V> to_mat(const Sym3<V>& a) {
  return {{{a.xx, a.xy, a.xz}, {a.xy, a.yy, a.yz}, {a.xz, a.yz, a.zz}}};
}
/// Symmetric part (a + a^T)/2.
template <class V>
SCREE_FN Sym3<V> sym(const Mat3<V>& a) {
  const Scalar<V> h = Scalar<V>(0.5);
  return {a(0, 0), h * (a(0, 1) + a(1, 0)), h * (a(0, 2) + a(2, 0)),
          a(1, 1), h * (a(1, 2) + a(2, 1)), a(2, 2)};
}
/// a * b, a symmetric.
template <class V>
SCREE_FN Mat3<V> operator*(const Sym3<V>& a, const Mat3<V>& b) {
  return to_mat(a) * b;
}
template <class V>
SCREE_FN Vec3<V> operator*(const Sym3<V>& a, const Vec3<V>& b) {
  return to_mat(a) * b;
}
/// F F^T, the left Cauchy-Green tensor of a deformation gradient.
template <class V>
SCREE_FN Sym3<V> symmetric_product(const Mat3<V>& f) {
  const auto rows = [&f](int i, int j) {
    return f(i, 0) * f(j, 0) + f(i, 1) * f(j, 1) + f(i, 2) * f(j, 2);
  };
  return {rows(0, 0), rows(0, 1), rows(0, 2), rows(1, 1), rows(1, 2), rows(2, 2)};
}
/// U diag(d) U^T, the columns of u being the axes.
template <class V>
SCREE_FN Sym3<V> from_principal(const Mat3<V>& u, const Vec3<V>& d) {
  Mat3<V> ud;
  SCREE_UNROLL for (int i = 0; i < 3; ++i) {
    SCREE_UNROLL for (int j = 0; j < 3; ++j) ud(i, j) = u(i, j) * d[j];
  }
  const auto rows = [&](int i, int j) {
    return ud(i, 0) * u(j, 0) + ud(i, 1) * u(j, 1) + ud(i, 2) * u(j, 2);
  };
  return {rows(0, 0), rows(0, 1), rows(0, 2), rows(1, 1), rows(1, 2), rows(2, 2)};
}

}  // namespace scree
