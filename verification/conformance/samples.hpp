// SPDX-License-Identifier: Apache-2.0
/// \file
/// Parameters and states of a law by its C++ type, for the tests of single laws. The parameters of
/// samples/<header>.hpp are also those of the tests that run for every law.
#pragma once

#include <cmath>
#include <cstring>
#include <vector>

#include "materials/typical_input.hpp"
#include "verification/conformance/law.hpp"
#include "verification/support/floating_point_traps.hpp"
#include "verification/support/lanes_testing.hpp"

namespace scree::testing {

/// Inputs for the tests of a law. A new law gets one from its schema (defaults, and a value by unit
/// for every required number); samples/<header>.hpp has better ones.
template <class M>
std::vector<typename M::Input> sample_inputs() {
  const auto schema = M::schema();
  typename M::Input input{};
  set_typical_values(schema, &input, 3);
  return {input};
}

/// P-wave modulus at small strain [Pa]: the scale of stress errors.
template <class M>
double stiffness(const typename M::Input& input) {
  const auto p = M::template params<double>(input, density, 3);
  const double c = M::wave_speed(p, M::template initial<double>(p));
  return density * c * c;
}

/// Number of V's in a state.
template <class M>
inline constexpr int entry_count = int(sizeof(typename M::template State<double>) / sizeof(double));

/// A state as a list of numbers, in the order of M::fields().
template <class M, class T>
std::vector<T> entries(const typename M::template State<T>& state) {
  std::vector<T> list(entry_count<M>);
  std::memcpy(list.data(), &state, sizeof state);
  return list;
}

template <class M, class V>
typename M::template State<V> from_entries(const std::vector<V>& list) {
  typename M::template State<V> state;
  std::memcpy(static_cast<void*>(&state), list.data(), sizeof state);
  return state;
}

template <class M>
typename M::template State<float> to_float(const typename M::template State<double>& state) {
  const auto list = entries<M, double>(state);
  return from_entries<M, float>(std::vector<float>(list.begin(), list.end()));
}

/// The state seen from a rotated frame: 9 components are F -> Q F, 6 components A -> Q A Q^T.
template <class M>
typename M::template State<double> rotated(const typename M::template State<double>& state,
                                           const Mat3<double>& q) {
  auto list = entries<M, double>(state);
  double* x = list.data();
  for (const StateField& field : M::fields()) {
    if (field.components == 9) {
      Mat3<double> f;
      std::memcpy(&f, x, sizeof f);
      f = q * f;
      std::memcpy(x, &f, sizeof f);
    } else if (field.components == 6) {
      Sym3<double> a;
      std::memcpy(&a, x, sizeof a);
      a = sym(q * to_mat(a) * transpose(q));
      std::memcpy(x, &a, sizeof a);
    }
    x += field.components;
  }
  return from_entries<M, double>(list);
}

inline double distance(const Sym3<double>& a, const Sym3<double>& b) { return norm(a - b); }

template <class T>
Sym3<double> to_double(const Sym3<T>& a) {
  return {double(a.xx), double(a.xy), double(a.xz), double(a.yy), double(a.yz), double(a.zz)};
}

/// State after `steps` random increments of this size; yields where the law yields.
template <class M>
typename M::template State<double> random_state(const typename M::template Params<double>& p,
                                                MatrixSource& source, double size, int steps = 5) {
  auto state = M::template initial<double>(p);
  for (int i = 0; i < steps; ++i) {
    M::kirchhoff(p, state, from_eigen<double>(source.entries(size)), 1e-2);
  }
  return state;
}

/// State inside every yield surface: a compression and small shear, then a rotation of the body.
template <class M>
typename M::template State<double> elastic_state(const typename M::template Params<double>& p,
                                                 MatrixSource& source, double compression,
                                                 double shear) {
  auto state = M::template initial<double>(p);
  const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
  M::kirchhoff(p, state, from_eigen<double>(-compression * one), 1e-2);
  M::kirchhoff(p, state, from_eigen<double>(source.entries(shear)), 1e-2);
  return rotated<M>(state, from_eigen<double>(source.rotation()));
}

}  // namespace scree::testing
