// SPDX-License-Identifier: Apache-2.0
#include "solver/geometry/predicates.hpp"

#include <cmath>
#include <limits>

namespace scree {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon() / 2;  // of a rounded operation

int sign_of(double x) { return (x > 0) - (x < 0); }

/// A sum of doubles that loses nothing: terms of increasing size that do not overlap.
class ExactSum {
 public:
  /// Not inlined: a product fused with the sum would not be the number whose error is added.
  [[gnu::noinline]] void add(double x) {
    int kept = 0;
    for (int i = 0; i < count_; ++i) {
      // Two-sum: s + error is x + term exactly.
      const double s = x + term_[i];
      const double part = s - x;
      const double error = (x - (s - part)) + (term_[i] - part);
      if (error != 0) term_[kept++] = error;
      x = s;
    }
    if (x != 0) term_[kept++] = x;
    count_ = kept;
  }
  void add_product(double a, double b) {
    const double product = a * b;
    add(std::fma(a, b, -product));
    add(product);
  }
  int sign() const { return count_ == 0 ? 0 : sign_of(term_[count_ - 1]); }

 private:
  double term_[16];
  int count_ = 0;
};

int exact_orientation(const double a[2], const double b[2], const double c[2]) {
  ExactSum sum;
  sum.add_product(a[0], b[1]);
  sum.add_product(-a[1], b[0]);
  sum.add_product(b[0], c[1]);
  sum.add_product(-b[1], c[0]);
  sum.add_product(c[0], a[1]);
  sum.add_product(-c[1], a[0]);
  return sum.sign();
}

}  // namespace

int orientation(const double a[2], const double b[2], const double c[2]) {
  const double left = (a[0] - c[0]) * (b[1] - c[1]);
  const double right = (a[1] - c[1]) * (b[0] - c[0]);
  const double area = left - right;
  // Shewchuk's bound of the rounding of these four differences, two products and one difference.
  const double bound = (3 + 16 * epsilon) * epsilon * (std::abs(left) + std::abs(right));
  if (std::abs(area) > bound) return sign_of(area);
  return exact_orientation(a, b, c);
}

int perturbed_orientation(const double a[2], const double b[2], const double c[2]) {
  if (const int sign = orientation(a, b, c)) return sign;
  // c + (e, e^2) with an infinitesimal e: the area grows by e (a1 - b1) + e^2 (b0 - a0).
  if (a[1] != b[1]) return a[1] > b[1] ? 1 : -1;
  return sign_of(b[0] - a[0]);
}

int certain_orientation(const double a[3], const double b[3], const double c[3],
                        const double d[3]) {
  double u[3], v[3], w[3];
  for (int i = 0; i < 3; ++i) {
    u[i] = a[i] - d[i];
    v[i] = b[i] - d[i];
    w[i] = c[i] - d[i];
  }
  double volume = 0, size = 0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    volume += u[i] * (v[j] * w[k] - v[k] * w[j]);
    size += std::abs(u[i]) * (std::abs(v[j] * w[k]) + std::abs(v[k] * w[j]));
  }
  const double bound = (7 + 56 * epsilon) * epsilon * size;
  return std::abs(volume) > bound ? sign_of(volume) : 0;
}

}  // namespace scree
