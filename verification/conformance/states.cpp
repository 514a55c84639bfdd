// SPDX-License-Identifier: Apache-2.0
#include "verification/conformance/states.hpp"

#include <algorithm>
#include <cstring>

namespace scree::testing {

namespace {

constexpr double pi = 3.14159265358979323846;

/// Replaces the entries of fields with 9 and 6 components.
template <class F9, class F6>
State mapped(const Law& law, State state, F9 gradient, F6 tensor) {
  double* x = state.data();
  for (const StateField& field : law.fields) {
    if (field.components == 9) {
      Mat3<double> f;
      std::memcpy(&f, x, sizeof f);
      f = from_eigen<double>(gradient(to_eigen(f)));
      std::memcpy(x, &f, sizeof f);
    } else if (field.components == 6) {
      Sym3<double> a;
      std::memcpy(&a, x, sizeof a);
      a = sym(from_eigen<double>(tensor(to_eigen(a))));
      std::memcpy(x, &a, sizeof a);
    }
    x += field.components;
  }
  return state;
}

}  // namespace

State random_state(const Law& law, MatrixSource& source, double size) {
  State state = law.exact->initial();
  for (int i = 0; i < 5; ++i) advance(law, state, source.entries(size));
  return state;
}

State state_of_any_size(const Law& law, MatrixSource& source, double largest) {
  return random_state(law, source, std::pow(10, source.uniform(-4, std::log10(largest))));
}

std::optional<State> elastic_state(const Law& law, MatrixSource& source) {
  State state = law.exact->initial();
  const double compression = std::pow(10, source.uniform(-4, -1));
  advance(law, state, -compression * Eigen::Matrix3d::Identity());
  advance(law, state, source.entries(0.1 * compression));
  const auto yield = law.exact->yield_value(state);
  if (yield && *yield > -1e-3) return std::nullopt;
  return turned(law, state, source.rotation());
}

State turned(const Law& law, const State& state, const Eigen::Matrix3d& q) {
  return mapped(
      law, state, [&](const Eigen::Matrix3d& f) { return Eigen::Matrix3d(q * f); },
      [&](const Eigen::Matrix3d& a) { return Eigen::Matrix3d(q * a * q.transpose()); });
}

State turned_before(const Law& law, const State& state, const Eigen::Matrix3d& q) {
  return mapped(
      law, state, [&](const Eigen::Matrix3d& f) { return Eigen::Matrix3d(f * q); },
      [](const Eigen::Matrix3d& a) { return a; });
}

double stress_scale(const Law& law, const State& state, const Sym3<double>& stress) {
  const double c = law.exact->wave_speed(state);
  return std::max({law.stiffness, density * c * c, norm(stress)});
}

Eigen::Matrix3d strong_gradient(MatrixSource& source) {
  const double a = source.uniform(0.3, 3), b = source.uniform(0.3, 3), c = source.uniform(0.3, 3);
  const double kind = source.uniform(0, 10);
  if (kind < 1) return source.with_stretches(a, a, b);
  if (kind < 2) return source.with_stretches(a, a, a);
  if (kind < 2.5) return a * Eigen::Matrix3d::Identity();
  if (kind < 3) return Eigen::Vector3d(a, a, b).asDiagonal();
  if (kind < 3.5) return Eigen::Matrix3d::Identity();
  if (kind < 4) return source.rotation();
  return source.with_stretches(a, b, c);
}

double distance_of_entries(const State& a, const State& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double error = std::abs(a[i] - b[i]) / (1 + std::abs(a[i]));
    if (!(error <= worst)) worst = error;
  }
  return worst;
}

Path loop(MatrixSource& source, double size) {
  const Eigen::Matrix3d a = source.entries(size), b = source.entries(size);
  return [a, b](double t) {
    const double s = std::sin(pi * t), s2 = std::sin(2 * pi * t);
    return Eigen::Matrix3d(Eigen::Matrix3d::Identity() + s * s * a + s2 * s2 * b);
  };
}

Path one_way(MatrixSource& source, double size) {
  const Eigen::Matrix3d a = source.entries(size), b = source.entries(size);
  return [a, b](double t) {
    const double s = std::sin(0.5 * pi * t), s2 = std::sin(pi * t);
    return Eigen::Matrix3d(Eigen::Matrix3d::Identity() + s * s * a + s2 * s2 * b);
  };
}

void follow(const Law& law, State& state, const Path& path, int steps,
            const std::function<void(const Eigen::Matrix3d&, const Sym3<double>&)>& visit) {
  Eigen::Matrix3d last = path(0);
  for (int n = 1; n <= steps; ++n) {
    const Eigen::Matrix3d next = path(double(n) / steps);
    const Eigen::Matrix3d increment = (next - last) * last.inverse();
    const Sym3<double> stress = advance(law, state, increment, 1.0 / steps);
    if (visit) visit(increment, stress);
    last = next;
  }
}

}  // namespace scree::testing
