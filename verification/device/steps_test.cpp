// SPDX-License-Identifier: Apache-2.0
//
// A few steps of random scenes on the emulated device equal those of the processor: every kernel,
// every transfer, all kinds of faces, in two and three dimensions.
#include <gtest/gtest.h>

#include <limits>

#include "solver/emulation/launch.hpp"
#include "verification/device/pair_of_runs.hpp"
#include "verification/support/effort.hpp"
#include "verification/support/random.hpp"

namespace scree::testing {
namespace {

/// Two jittered jellies with random velocity fields in a corner of the domain.
SimulationSetup random_scene(int dimension, const Method& method, unsigned seed) {
  const double dx = 0.1;
  Random random(seed);
  SimulationSetup setup = make_setup(dimension, method, dx, {9, 8, 6}, Vector(-0.3, 0.2, 0.1));
  setup.gravity = [](double) { return std::array<double, 3>{1, -9.81, 2}; };
  for (int b = 0; b < 2; ++b) {
    const Vector lower = Vector(-0.3 + 0.45 * b, 0.2, dimension == 3 ? 0.1 : 0.0);
    auto points = lattice(lower, lower + Vector(0.4, 0.5, 0.3), dx / 2, dimension);
    for (Vector& x : points) x += random.vector(0.2 * dx / 2, dimension);
    BodySetup& body = add_jelly(setup, points, dx / 2, {b == 0 ? 1e5 : 3e4, 0.3, 1000});
    set_velocity(body, random.vector(1, dimension), random.matrix(2, dimension), lower);
  }
  set_steps(setup, 4, 1e-3, true);
  return setup;
}

/// Sums of about a hundred terms in another order, magnified by the inverse of the compact moment
/// matrix (< 20), over four steps; measured errors lie ten times below.
double tolerance(const Method& method) {
  return 2e4 * (method.precision == Precision::double_ ? std::numeric_limits<double>::epsilon()
                                                       : std::numeric_limits<float>::epsilon());
}

class Steps : public ::testing::TestWithParam<Method> {};

TEST_P(Steps, walls_of_all_kinds) {
  Method method = GetParam();
  for (const int dimension : {2, 3}) {
    if (slow_build && dimension == 3) continue;
    method.precision = dimension == 2 ? Precision::double_ : Precision::single_;
    SimulationSetup setup = random_scene(dimension, method, 5);
    setup.faces[0] = {FaceType::symmetry, FaceType::open};
    setup.faces[1] = {FaceType::friction, FaceType::separate};
    setup.face_friction[1][0] = 0.3;
    setup.faces[2] = {FaceType::sticky, FaceType::slip};
    if (method.path == PathType::split) setup.damping = DampingType::local;
    if (method.path != PathType::split) setup.damping = DampingType::mass;
    setup.damping_value = 0.2;
    expect_same_run(setup, tolerance(method));
    setup.faces[0][0] = FaceType::sticky;
    setup.damping = DampingType::none;
    expect_same_run(setup, tolerance(method));
    setup.no_slip = NoSlip::face;
    expect_same_run(setup, tolerance(method));
    if (method.path == PathType::split) setup.damping = DampingType::local;
    setup.faces[0] = {FaceType::friction, FaceType::sticky};
    setup.faces[1] = {FaceType::periodic, FaceType::periodic};
    setup.face_friction[0][0] = 0.2;
    expect_same_run(setup, tolerance(method));
  }
}

TEST_P(Steps, periodic_faces) {
  Method method = GetParam();
  for (const int dimension : {2, 3}) {
    if (slow_build && dimension == 3) continue;
    method.precision = dimension == 2 ? Precision::single_ : Precision::double_;
    SimulationSetup setup = random_scene(dimension, method, 9);
    for (int a = 0; a < dimension; ++a) {
      setup.faces[std::size_t(a)] = {FaceType::periodic, FaceType::periodic};
    }
    expect_same_run(setup, tolerance(method));
  }
}

INSTANTIATE_TEST_SUITE_P(methods, Steps, ::testing::ValuesIn(all_methods()),
                         [](const auto& info) { return to_string(info.param); });

/// A result that hangs on the threads' order by more than rounding lacks a barrier.
TEST(StepsInOrder, backward_threads_change_rounding_only) {
  emulation::set_order(emulation::Order::backward);
  Method method;
  for (const PathType path : {PathType::fused, PathType::split}) {
    method.path = path;
    SimulationSetup setup = random_scene(2, method, 3);
    setup.faces[1][0] = FaceType::sticky;
    expect_same_run(setup, tolerance(method));
  }
  emulation::set_order(emulation::Order::forward);
}

/// For a thread sanitizer: threads of the machine instead of fibers.
TEST(StepsInOrder, Threads_that_run_at_once) {
  emulation::set_order(emulation::Order::threads);
  SimulationSetup setup = make_setup(2, {}, 0.1, {4, 4, 1});
  setup.faces[1][0] = FaceType::slip;
  add_jelly(setup, lattice(Vector(0.1, 0, 0), Vector(0.3, 0.2, 0), 0.05, 2), 0.05, {});
  setup.gravity = [](double) { return std::array<double, 3>{0, -9.81, 0}; };
  set_steps(setup, 2, 1e-3);
  expect_same_run(setup, tolerance({}));
  emulation::set_order(emulation::Order::forward);
}

}  // namespace
}  // namespace scree::testing
