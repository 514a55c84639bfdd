// SPDX-License-Identifier: Apache-2.0
//
// Every law of the emulation (SCREE_EMULATED) runs on the device as on the processor: the fused
// pass of both kernels and the split one, in two and three dimensions, while it yields or flows.
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "materials/registry.hpp"
#include "materials/typical_input.hpp"
#include "verification/device/pair_of_runs.hpp"
#include "verification/support/effort.hpp"
#include "verification/support/random.hpp"

namespace scree::testing {
namespace {

constexpr const char* laws[] = {
#define SCREE_MATERIAL(header, Type) #header,
#include "generated/emulated.def"
#undef SCREE_MATERIAL
};

/// A jittered block between walls.
SimulationSetup block(int dimension, const Method& method, const char* model) {
  const double dx = 0.1;
  Random random(3);
  SimulationSetup setup = make_setup(dimension, method, dx, {8, 8, 6});
  auto points = lattice(Vector(0, 0, 0), Vector(0.5, 0.4, 0.3), dx / 2, dimension);
  for (Vector& x : points) x += random.vector(0.2 * dx / 2, dimension);
  BodySetup& body = add_jelly(setup, points, dx / 2, {});
  body.name = body.material = body.model = model;
  body.input = typical_input(*find_material_model(model), dimension);
  body.density = 1500;
  return setup;
}

/// The block with a velocity field that strains it by 0.3 % in each of six steps of its own length.
SimulationSetup strained_block(int dimension, const Method& method, const char* model) {
  SimulationSetup setup = block(dimension, method, model);
  setup.schedule = Schedule(1, 1, 0, 0);
  const double dt = Simulation::create(setup)->dt();
  Random random(4);
  set_velocity(setup.bodies[0], Vector::Zero(), random.matrix(0.003 / dt, dimension),
               Vector(0.25, 0.2, 0.15));
  setup.schedule = Schedule(6 * dt, 2 * dt, 0, 0);
  return setup;
}

/// As in steps_test.cpp: sums of about a hundred terms in another order, times the inverse of the
/// moment matrix (< 20); where a law yields, a stress changes by the stiffness over the strength,
/// another 100.
double tolerance(Precision precision) {
  return precision == Precision::double_ ? 2e6 * std::numeric_limits<double>::epsilon()
                                         : 2e4 * double(std::numeric_limits<float>::epsilon());
}

class DeviceLaws : public ::testing::TestWithParam<const char*> {};

TEST_P(DeviceLaws, are_those_of_the_processor) {
  for (const int dimension : {2, 3}) {
    if (slow_build && dimension == 3) continue;
    for (const KernelType kernel : {KernelType::compact, KernelType::quadratic}) {
      for (const PathType path : {PathType::fused, PathType::split}) {
        for (const Precision precision : {Precision::double_, Precision::single_}) {
          Method method;
          method.kernel = kernel;
          method.path = path;
          method.precision = precision;
          SCOPED_TRACE(to_string(method) + " " + std::to_string(dimension));
          expect_same_run(strained_block(dimension, method, GetParam()), tolerance(precision));
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(laws, DeviceLaws, ::testing::ValuesIn(laws),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace scree::testing
