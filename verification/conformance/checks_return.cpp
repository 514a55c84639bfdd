// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "verification/conformance/checks.hpp"
#include "verification/support/floating_point_traps.hpp"

namespace scree::testing {

namespace {

template <class T>
const Point<T>& point_of(const Law& law) {
  if constexpr (sizeof(T) == 8) {
    return *law.exact;
  } else {
    return *law.single;
  }
}

/// Initial state, or one that has flowed before.
template <class T>
Entries<T> some_state(const Point<T>& point, MatrixSource& source) {
  Entries<T> state = point.initial();
  if (source.uniform(0, 1) < 0.5) return state;
  for (int i = 0; i < 3; ++i) {
    point.kirchhoff(state, from_eigen<T>(source.entries(0.05)), T(0.01));
  }
  return state;
}

template <class T>
State to_double(const Entries<T>& entries) {
  State result;
  std::copy(entries.begin(), entries.end(), result.begin());
  return result;
}

template <class T>
Sym3<double> to_double(const Sym3<T>& a) {
  return {double(a.xx), double(a.xy), double(a.xz), double(a.yy), double(a.yz), double(a.zz)};
}

template <class T>
Eigen::Matrix3d gradient_of(const Law& law, const Entries<T>& state) {
  const int first = law.first_entry("deformation_gradient");
  Eigen::Matrix3d f;
  for (int k = 0; k < 9; ++k) f(k / 3, k % 3) = double(state[std::size_t(first + k)]);
  return f;
}

/// ln b/2
Eigen::Matrix3d log_strain(const Eigen::Matrix3d& f) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> b(f * f.transpose());
  const Eigen::Vector3d half_log = 0.5 * b.eigenvalues().array().log();
  return b.eigenvectors() * half_log.asDiagonal() * b.eigenvectors().transpose();
}

}  // namespace

template <class T>
Returned strong_returns(const Law& law, MatrixSource& source, int count) {
  const Point<T>& point = point_of<T>(law);
  const bool solid = law.has_field("deformation_gradient");
  const FloatingPointTraps traps;
  Returned result;
  for (int n = 0; n < count; ++n) {
    Entries<T> state = some_state(point, source);
    const Eigen::Matrix3d before = solid ? gradient_of(law, state) : Eigen::Matrix3d::Zero();
    const auto L = from_eigen<T>(strong_gradient(source) - Eigen::Matrix3d::Identity());
    const Sym3<T> first = point.kirchhoff(state, L, T(0.01));
    const T c = point.wave_speed(state);  // is computed before a state is refused
    if (!point.admissible(state)) continue;
    const double J = double(point.volume_ratio(state)), e = double(point.energy_density(state));
    const double size = norm(to_double(first)), stiffness = density * double(c) * double(c);
    const bool numbers = std::isfinite(size) && std::isfinite(e) && J > 0 && stiffness > 0;
    Entries<T> again = state;
    const Sym3<T> second = point.kirchhoff(again, zero3<T>(), T(0));
    const double scale = std::max({law.stiffness, size, std::min(stiffness, 1e300)});
    result.repeated.add(numbers ? norm(to_double(second) - to_double(first)) / scale : NAN);
    result.repeated.add(distance_of_entries(to_double(state), to_double(again)));
    const auto yield = point.yield_value(state);
    if (!yield || law.explicit_hardening) continue;
    result.outside.add(std::max(double(*yield), 0.0) / (1 + size / law.stiffness));
    const Eigen::Matrix3d trial = before + to_eigen(L) * before;
    result.flowing += solid && (gradient_of(law, state) - trial).norm() > 1e-4;
  }
  return result;
}
template Returned strong_returns<double>(const Law&, MatrixSource&, int);
template Returned strong_returns<float>(const Law&, MatrixSource&, int);

bool refuses(const Law& law, const Eigen::Matrix3d& f) {
  const FloatingPointTraps traps;
  State state = law.exact->initial();
  advance(law, state, f - Eigen::Matrix3d::Identity());
  const bool bounded = std::isfinite(law.exact->wave_speed(state));  // is asked before
  const bool fluid = !law.has_field("deformation_gradient");
  return bounded && (!law.exact->admissible(state) || (fluid && f.trace() > 2));
}

Worst plastic_strain(const Law& law, MatrixSource& source, int count) {
  Worst worst;
  const int entry = law.first_entry("equivalent_plastic_strain");
  if (entry < 0 || !law.has_field("deformation_gradient")) return worst;
  for (int n = 0; n < count; ++n) {
    State state = state_of_any_size(law, source, 0.05);
    const double before = state[std::size_t(entry)];
    const double size = std::pow(10, source.uniform(-3, -1));
    const Eigen::Matrix3d L = source.entries(size);
    const Eigen::Matrix3d trial = (Eigen::Matrix3d::Identity() + L) * gradient_of(law, state);
    advance(law, state, L);
    if (!law.exact->admissible(state)) continue;
    const Eigen::Matrix3d flow = log_strain(trial) - log_strain(gradient_of(law, state));
    const Eigen::Matrix3d deviator = flow - flow.trace() / 3 * Eigen::Matrix3d::Identity();
    const double expected = std::sqrt(2.0 / 3.0) * deviator.norm();
    worst.add(std::abs(state[std::size_t(entry)] - before - expected) / size);
  }
  return worst;
}

Halving halving(const Law& law, MatrixSource& source, int paths, int n) {
  Halving result;
  for (int path_count = 0; path_count < paths; ++path_count) {
    const double compression = std::pow(10, source.uniform(-3, -1.5));
    const Path path = one_way(source, 0.03);
    const auto final_stress = [&](int steps) {
      State state = law.exact->initial();
      advance(law, state, -compression * Eigen::Matrix3d::Identity());
      follow(law, state, path, steps);
      return stress_at_rest(law, state);
    };
    const Sym3<double> a = final_stress(n), b = final_stress(2 * n), c = final_stress(4 * n);
    result.coarse += norm(a - b) / (law.stiffness + norm(c)) / paths;
    result.fine += norm(b - c) / (law.stiffness + norm(c)) / paths;
  }
  return result;
}

}  // namespace scree::testing
