// SPDX-License-Identifier: Apache-2.0
//
// The number of threads changes no bit, the path of a step only rounding.
#include <gtest/gtest.h>

#include "verification/support/effort.hpp"
#include "verification/support/final_state.hpp"

namespace scree::testing {
namespace {

/// Two jellies that collide above a held floor and beside a mirror wall.
SimulationSetup collision(int dimension, const Method& method) {
  const double dx = 0.1;
  SimulationSetup setup = make_setup(dimension, method, dx, {18, 16, 12});
  setup.gravity = [](double) { return std::array<double, 3>{0, -9.81, 0}; };
  setup.faces[1][0] = FaceType::sticky;
  setup.faces[0][0] = FaceType::symmetry;
  for (int b = 0; b < 2; ++b) {
    const Vector lower(0.05 + 0.7 * b, 0.05, 0.3);
    const auto points = lattice(lower, lower + Vector(0.6, 0.7, 0.4), dx / 3, dimension);
    Matrix L = Matrix::Zero();
    L(0, 1) = b == 0 ? 1 : -2;
    set_velocity(add_jelly(setup, points, dx / 3, {b == 0 ? 1e5 : 3e4, 0.3, 1000}),
                 Vector(b == 0 ? 0.5 : -1.5, -0.2, 0), L, lower);
  }
  // With hat functions edge particles blow up sooner or later: stop before.
  const double end = method.kernel == KernelType::linear ? 0.012 : slow_build ? 0.02 : 0.06;
  setup.schedule = Schedule(end, end / 6, 0, 0);
  return setup;
}

class Threads : public ::testing::TestWithParam<Method> {};

TEST_P(Threads, do_not_change_a_bit) {
  for (int dimension : {2, 3})
    for (Precision precision : {Precision::double_, Precision::single_}) {
      if (slow_build && (dimension == 3) != (precision == Precision::double_)) continue;
      Method method = GetParam();
      method.precision = precision;
      const MemoryArchive one = final_state(collision(dimension, method), 1);
      EXPECT_TRUE(one == final_state(collision(dimension, method), 2));
      EXPECT_TRUE(one == final_state(collision(dimension, method), 5));
    }
}

INSTANTIATE_TEST_SUITE_P(methods, Threads, ::testing::ValuesIn(all_methods()),
                         [](const auto& info) { return to_string(info.param); });

}  // namespace
}  // namespace scree::testing
