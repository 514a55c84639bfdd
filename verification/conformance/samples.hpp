// SPDX-License-Identifier: Apache-2.0
/// \file
/// Parameters, states and paths with which every material of materials/list.def is tested.
#pragma once

#include <cfenv>
#include <cmath>
#include <cstring>
#include <tuple>
#include <utility>
#include <vector>

#include "generated/materials.hpp"
#include "materials/registry.hpp"
#include "verification/support/lanes_testing.hpp"

namespace scree::testing {

inline constexpr double degree = 3.14159265358979323846 / 180;
inline constexpr double density = 1700;

/// Inputs for the tests of a law. A new law gets one from its schema (defaults, and a value by unit
/// for every required number); specialise this where more variants are worth testing.
template <class M>
std::vector<typename M::Input> sample_inputs() {
  const auto schema = M::schema();
  typename M::Input input{};
  schema.reset(&input, SchemaContext{});
  for (const auto& entry : schema.entries()) {
    if (!entry->required || entry->kind != EntryKind::number) continue;
    double& value = *static_cast<double*>(entry->member(&input));
    if (entry->unit == Unit::pressure) value = 1e7;
    if (entry->unit == Unit::angle) value = 30 * degree;
    if (entry->unit == Unit::none) value = entry->upper ? 0.3 * *entry->upper : 1.0;
  }
  return {input};
}

template <>
inline std::vector<FixedCorotated::Input> sample_inputs<FixedCorotated>() {
  return {{1e7, 0.3}, {2e5, 0.45}, {1e7, 0.0}, {1e7, -0.4}};
}

template <>
inline std::vector<Hencky::Input> sample_inputs<Hencky>() {
  return {{1e7, 0.3}, {2e5, 0.45}, {1e7, -0.4}};
}

template <>
inline std::vector<VonMises::Input> sample_inputs<VonMises>() {
  return {{1e7, 0.3, 2e5, 0}, {1e7, 0.45, 1e5, 1e6}, {1e7, 0.0, 5e5, 2e4}};
}

template <>
inline std::vector<DruckerPrager::Input> sample_inputs<DruckerPrager>() {
  return {{1e7, 0.3, 30 * degree, 0, 0, Match::compression},
          {1e7, 0.2, 35 * degree, 2e4, 0, Match::plane_strain},
          {1e7, 0.3, 40 * degree, 5e4, 15 * degree, Match::plane_strain},
          {1e7, 0.0, 25 * degree, 1e4, 25 * degree, Match::extension}};
}

template <>
inline std::vector<JFluid::Input> sample_inputs<JFluid>() {
  return {{1e6, 7, 0, 1}, {1e6, 7, 3.0, 0.98}, {1e6, 1, 0.1, 1.01}, {2e5, 4.4, 0, 1}};
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

/// Floating-point exceptions kill the process while this lives: no lane may divide by zero,
/// overflow or make a NaN, not even in a branch that a select drops.
class FloatingPointTraps {
 public:
  FloatingPointTraps() {
    std::feclearexcept(FE_ALL_EXCEPT);
    feenableexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW);
  }
  ~FloatingPointTraps() { fedisableexcept(FE_ALL_EXCEPT); }
  FloatingPointTraps(const FloatingPointTraps&) = delete;
  FloatingPointTraps& operator=(const FloatingPointTraps&) = delete;
};

// All laws of this build, for typed tests: the list's lines end with commas, so it gets one more
// entry, which is dropped again.
struct EndOfList {};
#define SCREE_MATERIAL(header, Type) Type,
// clang-format off
using AllMaterials = std::tuple<
#include "generated/materials.def"
    EndOfList>;
// clang-format on
#undef SCREE_MATERIAL

template <class Tuple, class Indices>
struct AllButLast;
template <class Tuple, std::size_t... I>
struct AllButLast<Tuple, std::index_sequence<I...>> {
  using Types = ::testing::Types<std::tuple_element_t<I, Tuple>...>;
};
using MaterialTypes =
    AllButLast<AllMaterials, std::make_index_sequence<std::tuple_size_v<AllMaterials> - 1>>::Types;

}  // namespace scree::testing
