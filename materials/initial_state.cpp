// SPDX-License-Identifier: Apache-2.0
#include "materials/initial_state.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/base/eigen.hpp"

namespace scree {
namespace {

using Vector = Vec3<double>;

double largest(const Vector& a) {
  return std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])});
}

/// One stretch from the law's initial state, as a function of its three logarithms.
class Stretching {
 public:
  Stretching(MaterialPoint& point, const std::vector<StateField>& fields)
      : point_(point), start_(point.entries()) {
    std::size_t first = 0;
    for (const StateField& field : fields) {
      if (field.name == "log_volume_ratio") volume_ = first;
      first += std::size_t(field.components);
    }
  }

  /// The normal stresses after the stretch, NaN where the law does not know the state; the volume
  /// counts from there.
  Vector operator()(const Vector& strain) {
    point_.set_entries(start_);
    stretch(strain);
    if (!point_.admissible()) return unknown();
    if (volume_) {
      std::vector<double> entries = point_.entries();
      entries[*volume_] = 0;
      point_.set_entries(entries);
    }
    const Sym3<double> tau = point_.advance(zero3<double>(), 1);  // at rest: no viscous stress
    return {{tau.xx, tau.yy, tau.zz}};
  }

  const std::vector<double>& start() const { return start_; }

  /// True if the way back leads to the initial state. (Laws without a yield surface have no other
  /// way; the volume of some fluids is not exact in so large a step.)
  bool reversible(const Vector& strain) {
    if (!point_.yield_value()) return true;
    point_.set_entries(start_);
    stretch(strain);
    stretch(strain * -1.0);
    const std::vector<double> end = point_.entries();
    for (std::size_t i = 0; i < end.size(); ++i) {
      const double rounding = 1e-9 * largest(strain) + 1e-13 * std::abs(start_[i]);
      if (!(std::abs(end[i] - start_[i]) <= rounding)) return false;
    }
    return true;
  }

 private:
  static Vector unknown() {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    return {{nan, nan, nan}};
  }

  void stretch(const Vector& strain) {
    Mat3<double> increment = zero3<double>();
    for (int i = 0; i < 3; ++i) increment(i, i) = std::expm1(strain[i]);
    point_.advance(increment, 1);
  }

  MaterialPoint& point_;
  std::vector<double> start_;
  std::optional<std::size_t> volume_;  ///< entry of the total ln J
};

bool known(const Vector& stress) { return std::isfinite(stress[0] + stress[1] + stress[2]); }

/// d tau_i/d e_j by central differences. The step is small beside 1e-4, the first strain that is
/// tried, and large beside the rounding of stretches.
Mat3<double> tangent(Stretching& stress, const Vector& strain) {
  constexpr double step = 1e-6;
  Mat3<double> result;
  for (int j = 0; j < 3; ++j) {
    Vector up = strain, down = strain;
    up[j] += step;
    down[j] -= step;
    const Vector difference = stress(up) - stress(down);
    for (int i = 0; i < 3; ++i) result(i, j) = difference[i] / (2 * step);
  }
  return result;
}

/// The shortest x with A x = b in the least squares' sense. The stiffness of a fluid has rank one.
Vector solve(const Mat3<double>& a, const Vector& b) {
  const SymEigen<double> e = eigen_symmetric(symmetric_product(transpose(a)));
  const Vector c = transpose(a) * b;
  Vector x{{0, 0, 0}};
  for (int k = 0; k < 3; ++k) {
    if (!(e.values[k] > 1e-10 * std::max({e.values[0], e.values[1], e.values[2]}))) continue;
    const Vector v{{e.vectors(0, k), e.vectors(1, k), e.vectors(2, k)}};
    x = x + v * (dot(v, c) / e.values[k]);
  }
  return x;
}

double stiffness(const Mat3<double>& a) {
  double sum = 0;  // no comparison: entries may be NaN
  for (int i = 0; i < 9; ++i) sum += std::abs(a(i / 3, i % 3));
  return sum / 3;
}

}  // namespace

std::optional<std::vector<double>> initial_state(MaterialPoint& point,
                                                 const std::vector<StateField>& fields,
                                                 const std::array<double, 3>& target) {
  constexpr int most_steps = 60, most_halvings = 30;
  const Vector goal{{target[0], target[1], target[2]}};
  Stretching stress(point, fields);
  Vector strain{{0, 0, 0}};
  Vector rest = goal - stress(strain);
  if (!known(rest)) return std::nullopt;
  if (largest(rest) <= 1e-12 * largest(goal)) return stress.start();
  // The tangent of a cohesionless law is not that of its apex: the first one is taken beside it.
  const double sign = goal[0] + goal[1] + goal[2] > 0 ? 1.0 : -1.0;
  Vector base{{1e-4 * sign, 1e-4 * sign, 1e-4 * sign}};
  for (int n = 0; n < most_steps; ++n) {
    const Mat3<double> a = tangent(stress, n == 0 ? base : strain);
    const double stiff = stiffness(a);
    if (!std::isfinite(stiff)) return std::nullopt;
    if (largest(rest) <= std::max(1e-12 * largest(goal), 4e-16 * stiff)) {
      if (!stress.reversible(strain)) return std::nullopt;
      stress(strain);
      return point.entries();
    }
    const Vector step = solve(a, rest);
    double share = 1;
    Vector next, left;
    for (int h = 0; h < most_halvings; ++h, share /= 2) {
      next = strain + step * share;
      left = goal - stress(next);
      if (known(left) && norm(left) < norm(rest)) break;
    }
    if (!known(left) || !(norm(left) < norm(rest))) return std::nullopt;
    strain = next;
    rest = left;
  }
  return std::nullopt;
}

}  // namespace scree
