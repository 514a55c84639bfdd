// SPDX-License-Identifier: Apache-2.0
//
// A run that is saved at any step and continued by another object equals the uninterrupted one bit
// for bit: state, steps and history.
#include <gtest/gtest.h>

#include "solver/io/memory_archive.hpp"
#include "verification/support/effort.hpp"
#include "verification/support/scene.hpp"

namespace scree::testing {
namespace {

SimulationSetup tumbling_block(int dimension, const Method& method) {
  const double dx = 0.1;
  SimulationSetup setup = make_setup(dimension, method, dx, {14, 12, 10});
  setup.gravity = [](double t) { return std::array<double, 3>{3 * t, -9.81, 0}; };
  setup.faces[1][0] = FaceType::friction;
  setup.face_friction[1][0] = 0.3;
  setup.faces[0] = {FaceType::periodic, FaceType::periodic};
  const auto points = lattice(Vector(0.2, 0.1, 0.2), Vector(0.8, 0.6, 0.5), dx / 3, dimension);
  Matrix L = Matrix::Zero();
  L(0, 1) = -3;
  L(1, 0) = 2;
  set_velocity(add_jelly(setup, points, dx / 3, {5e4, 0.3, 1000}), Vector(1.5, -1, 0), L,
               Vector(0.5, 0.3, 0.3));
  // With hat functions edge particles blow up sooner or later: stop before.
  const double end = method.kernel == KernelType::linear ? 0.03 : 0.1;
  setup.schedule = Schedule(end, end / 10, 0, 0);
  return setup;
}

void expect_same(const HistoryRow& a, const HistoryRow& b) {
  EXPECT_EQ(a.step, b.step);
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(a.dt, b.dt);
  EXPECT_EQ(a.kinetic_energy, b.kinetic_energy);
  EXPECT_EQ(a.elastic_energy, b.elastic_energy);
  EXPECT_EQ(a.max_speed, b.max_speed);
  for (int c = 0; c < 3; ++c) {
    EXPECT_EQ(a.momentum[c], b.momentum[c]);
    EXPECT_EQ(a.angular_momentum[c], b.angular_momentum[c]);
    EXPECT_EQ(a.center[c], b.center[c]);
  }
}

class Restart : public ::testing::TestWithParam<Method> {};

TEST_P(Restart, continues_bit_for_bit) {
  for (int dimension : {2, 3})
    for (Precision precision : {Precision::double_, Precision::single_})
      for (int stop : {0, 3, 11}) {  // before the first step, and between two history rows
        if (slow_build && (dimension == 3) != (stop == 11)) continue;
        Method method = GetParam();
        method.precision = precision;
        const SimulationSetup setup = tumbling_block(dimension, method);
        const auto whole = Simulation::create(setup);
        for (int n = 0; n < stop; ++n) whole->step();
        MemoryArchive middle;
        whole->save(middle);
        const auto resumed = Simulation::create(setup);
        resumed->load(middle);
        EXPECT_EQ(resumed->time(), whole->time());
        EXPECT_EQ(resumed->dt(), whole->dt());
        MemoryArchive again;
        resumed->save(again);
        EXPECT_TRUE(again == middle);
        run(*whole, setup.schedule);
        run(*resumed, setup.schedule);
        MemoryArchive end, resumed_end;
        whole->save(end);
        resumed->save(resumed_end);
        EXPECT_TRUE(end == resumed_end) << dimension << " " << stop;
        expect_same(whole->history(), resumed->history());
      }
}

INSTANTIATE_TEST_SUITE_P(methods, Restart, ::testing::ValuesIn(all_methods()),
                         [](const auto& info) { return to_string(info.param); });

}  // namespace
}  // namespace scree::testing
