// SPDX-License-Identifier: Apache-2.0
//
// The strict group has no objection to the method's block bodies and computes what CpuGroup does.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "materials/fixed_corotated.hpp"
#include "solver/exec/strict_group.hpp"
#include "solver/step/block_bodies.hpp"
#include "solver/transfer/compact.hpp"
#include "solver/transfer/quadratic.hpp"
#include "verification/support/block_scene.hpp"

namespace scree::testing {
namespace {

template <int Dimension, class Real, class KernelType>
struct Case {
  static constexpr int D = Dimension;
  using T = Real;
  using Kernel = KernelType;
};

template <class C>
struct Bodies : ::testing::Test {
  static constexpr int D = C::D;
  using T = typename C::T;
  using Kernel = typename C::Kernel;
  using Scene = BlockScene<D, T>;
  using Plain = CpuGroup<D, T, Kernel>;
  using Strict = StrictGroup<D, T, Kernel>;

  /// Equal to rounding: the two groups are two instances of one source, in which the compiler may
  /// fuse different multiplications with additions; 1000 eps of the largest value covers the
  /// material's stiffness against its stress.
  static void expect_close(const std::vector<T>& a, const std::vector<T>& b) {
    ASSERT_EQ(a.size(), b.size());
    T largest = 0;
    for (const T x : a) largest = std::max(largest, std::abs(x));
    const T tolerance = 1000 * std::numeric_limits<T>::epsilon() * largest;
    for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], tolerance) << i;
  }
  static void expect_close(T a, T b) { expect_close(std::vector<T>{a}, std::vector<T>{b}); }

  /// Runs body(group, data) on twin scenes; particles must agree to rounding, grid sums to that of
  /// about 100 terms of size 1.
  template <class Body>
  void expect_same(PassParameters<T> (*change)(PassParameters<T>), Body body) {
    Scene plain(Kernel::lattices, {61, 5, 200}, 11);
    Scene strict(Kernel::lattices, {61, 5, 200}, 11);
    PassData<D, T> data[2] = {plain.data(), strict.data()};
    for (auto& d : data) d.parameters = change(d.parameters);
    plain.template run<Plain>(data[0], [&](Plain& g) { body(g, data[0]); });
    strict.template run<Strict>(data[1], [&](Strict& g) { body(g, data[1]); });
    for (int f = 0; f < Scene::fields; ++f) expect_close(plain.field(f), strict.field(f));
    for (int f = 0; f < plain.layout.total; ++f) {
      expect_close(plain.field(f, true), strict.field(f, true));
    }
    const T tolerance = 100 * std::numeric_limits<T>::epsilon();
    for (int c = 0; c < 2; ++c) {
      T largest = 0;
      for (const T x : plain.write[c]) largest = std::max(largest, std::abs(x));
      for (std::size_t i = 0; i < plain.write[c].size(); ++i) {
        ASSERT_NEAR(plain.write[c][i], strict.write[c][i], tolerance * largest);
      }
    }
    for (std::size_t b = 0; b < plain.results.size(); ++b) {
      expect_close(plain.results[b].max_speed, strict.results[b].max_speed);
      expect_close(plain.results[b].max_signal, strict.results[b].max_signal);
      expect_close(plain.results[b].max_excursion, strict.results[b].max_excursion);
      EXPECT_EQ(plain.results[b].fault, FaultCode::none);
      EXPECT_EQ(strict.results[b].fault, FaultCode::none);
    }
  }
};

using Cases = ::testing::Types<Case<2, double, Compact>, Case<2, float, Quadratic>,
                               Case<3, float, Compact>, Case<3, double, Quadratic>>;
TYPED_TEST_SUITE(Bodies, Cases);

TYPED_TEST(Bodies, ParticlesToGrid) {
  using Kernel = typename TypeParam::Kernel;
  using P = PassParameters<typename TypeParam::T>;
  const auto body = [](auto& g, const auto& d) { p2g_block<Kernel, Mls<Kernel>>(g, d); };
  this->expect_same([](P p) { return p; }, body);
  this->expect_same(
      [](P p) {
        p.separate_force = true;
        return p;
      },
      body);
}

TYPED_TEST(Bodies, GridToParticles) {
  using Kernel = typename TypeParam::Kernel;
  using P = PassParameters<typename TypeParam::T>;
  this->expect_same([](P p) { return p; },
                    [](auto& g, const auto& d) { g2p_block<Kernel, Mls<Kernel>>(g, d); });
  this->expect_same([](P p) { return p; },
                    [](auto& g, const auto& d) { g2p_block<Kernel, Pic<Kernel, true>>(g, d); });
}

TYPED_TEST(Bodies, Fused) {
  using Kernel = typename TypeParam::Kernel;
  using T = typename TypeParam::T;
  using P = PassParameters<T>;
  const FixedCorotated::Params<T> material{T(10), T(5), T(1)};
  this->expect_same(
      [](P p) {
        p.record = true;
        return p;
      },
      [&](auto& g, const auto& d) { g2p2g_block<Kernel, FixedCorotated>(g, d, material); });
}

TYPED_TEST(Bodies, Stress) {
  using T = typename TypeParam::T;
  using P = PassParameters<T>;
  const FixedCorotated::Params<T> material{T(10), T(5), T(1)};
  this->expect_same([](P p) { return p; },
                    [&](auto& g, const auto& d) { stress_block<FixedCorotated>(g, d, material); });
}

}  // namespace
}  // namespace scree::testing
