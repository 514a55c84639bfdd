// SPDX-License-Identifier: Apache-2.0
//
// The solver against the reference method, particle by particle, for every kernel and transfer, 2D
// and 3D, fused and split, double and single precision (case V04).
#include <gtest/gtest.h>

#include <cmath>

#include "verification/support/effort.hpp"
#include "verification/support/random.hpp"
#include "verification/support/scene.hpp"

namespace scree::testing {
namespace {

constexpr double dx = 0.1;

/// Two jellies side by side in a corner of the domain, jittered off the lattice, with random
/// velocities and velocity gradients; a symmetric wall at x_min, a held floor, gravity askew.
SimulationSetup random_scene(int dimension, const Method& method) {
  SimulationSetup setup = make_setup(dimension, method, dx, {10, 9, 8}, Vector(-0.3, 0.2, 0.1));
  setup.flip_blend = 0.9;
  setup.gravity = [](double) { return std::array<double, 3>{0.7, -9.81, 0.4}; };
  setup.faces[0][0] = FaceType::symmetry;
  setup.faces[1][0] = FaceType::sticky;
  Random random(51);
  const double spacing = dx / 2;
  const Vector corner(-0.3, 0.2, 0.1);
  for (int b = 0; b < 2; ++b) {
    const Vector lower = corner + Vector(b * 3 * dx, 0, 2 * dx);
    const Vector size = dimension == 2 ? Vector(3 * dx, 5 * dx, 0) : Vector(3 * dx, 3 * dx, 2 * dx);
    std::vector<Vector> points = lattice(lower, lower + size, spacing, dimension);
    for (Vector& x : points) x += random.vector(0.15 * spacing, dimension);
    BodySetup& body = add_jelly(setup, points, spacing, {b == 0 ? 1e5 : 4e4, 0.3, 1000});
    for (std::size_t p = 0; p < points.size(); ++p) {
      const Vector v = random.vector(0.5, dimension);
      const Matrix L = random.matrix(3.0, dimension);
      body.velocity.insert(body.velocity.end(), {v[0], v[1], v[2]});
      for (int i = 0; i < 9; ++i) body.velocity_gradient.push_back(L(i / 3, i % 3));
    }
  }
  return setup;
}

struct Difference {
  double x, v, F;
};

Difference difference_after(int steps, int dimension, const Method& method,
                            NoSlip no_slip = NoSlip::node) {
  SimulationSetup setup = random_scene(dimension, method);
  setup.no_slip = no_slip;
  const double dt = 5e-4;
  set_steps(setup, steps, dt);
  const Twin twin = reference_twin(setup);
  const Schedule schedule = setup.schedule;
  const auto simulation = Simulation::create(std::move(setup));
  run(*simulation, schedule);
  EXPECT_EQ(simulation->step_count(), steps);
  for (int n = 0; n < steps; ++n) twin.solver->step(dt);
  const State got = state_of(*simulation), expected = twin.state();
  EXPECT_GT(distance(got.v, std::vector<Vector>(got.v.size(), Vector::Zero())), 0.05);
  return {distance(got.x, expected.x), distance(got.v, expected.v), distance(got.F, expected.F)};
}

class AgainstReference : public ::testing::TestWithParam<Method> {};

TEST_P(AgainstReference, one_step) {
  for (int dimension : {2, 3}) {
    const Difference d = difference_after(1, dimension, GetParam());
    // Rounding of velocities of size 1; stresses of 1e5 dt/(rho dx) = 0.5 m/s add their own; the
    // gradient-form force divides weights of 1e-16 accuracy by small node masses.
    EXPECT_LT(d.x, 1e-15) << dimension;
    EXPECT_LT(d.v, 1e-12) << dimension;
    EXPECT_LT(d.F, 1e-12) << dimension;
  }
}

TEST_P(AgainstReference, one_step_held_at_the_face) {
  for (int dimension : {2, 3}) {
    const Difference d = difference_after(1, dimension, GetParam(), NoSlip::face);
    EXPECT_LT(d.x, 1e-15) << dimension;  // as above
    EXPECT_LT(d.v, 1e-12) << dimension;
    EXPECT_LT(d.F, 1e-12) << dimension;
  }
}

TEST_P(AgainstReference, forty_steps) {
  for (int dimension : {2, 3}) {
    const Difference d = difference_after(effort(40), dimension, GetParam());
    EXPECT_LT(d.x, 1e-12) << dimension;
    EXPECT_LT(d.v, 1e-10) << dimension;
    EXPECT_LT(d.F, 1e-10) << dimension;
  }
  const Difference d = difference_after(effort(40), 2, GetParam(), NoSlip::face);
  EXPECT_LT(d.x, 1e-12);
  EXPECT_LT(d.v, 1e-10);
  EXPECT_LT(d.F, 1e-10);
}

/// Sand and a viscous fluid in a corner.
SimulationSetup sand_beside_fluid(const Method& method) {
  SimulationSetup setup = make_setup(2, method, dx, {10, 9, 1});
  setup.flip_blend = 0.9;
  setup.gravity = [](double) { return std::array<double, 3>{0, -9.81, 0}; };
  setup.faces[0][0] = FaceType::symmetry;
  setup.faces[1][0] = FaceType::sticky;
  Random random(52);
  auto jittered = [&](double left) {
    auto points = lattice(Vector(left, 0, 0), Vector(left + 0.3, 0.4, 0), dx / 3, 2);
    for (Vector& x : points) x += random.vector(0.1 * dx / 3, 2);
    return points;
  };
  DruckerPrager::Input sand;
  sand.youngs_modulus = 1e5;
  sand.poissons_ratio = 0.3;
  sand.friction_angle = 0.55;
  sand.cohesion = 20;
  const Matrix squeeze = (Matrix() << 1.5, 2, 0, -1, -2, 0, 0, 0, 0).finished();
  set_velocity(add_sand(setup, jittered(0), dx / 3, sand, 1600), Vector::Zero(), squeeze);
  JFluid::Input water;
  water.bulk_modulus = 1e4;
  water.gamma = 7;
  water.viscosity = 3;
  set_velocity(add_fluid(setup, jittered(0.3), dx / 3, water, 1000), Vector(-0.3, -0.2, 0));
  return setup;
}

/// With the history of the sand.
TEST_P(AgainstReference, sand_and_fluid) {
  SimulationSetup setup = sand_beside_fluid(GetParam());
  const int steps = effort(40);
  const double dt = 5e-4;
  set_steps(setup, steps, dt);
  const Twin twin = reference_twin(setup);
  const Schedule schedule = setup.schedule;
  const auto simulation = Simulation::create(std::move(setup));
  run(*simulation, schedule);
  for (int n = 0; n < steps; ++n) twin.solver->step(dt);
  const auto snapshot = simulation->particles({"velocity", "stress"});
  const auto& velocity = field(snapshot, "velocity").values;
  const auto& stress = field(snapshot, "stress").values;
  int yielded = 0;
  for (std::size_t p = 0; p < snapshot.id.size(); ++p) {
    const reference::Particle& expected = twin.solver->particles()[p];
    const double J = std::exp(expected.state.log_volume_ratio);
    yielded += expected.state.equivalent_plastic_strain > 0;
    for (int a = 0; a < 2; ++a) {
      EXPECT_NEAR(snapshot.position[3 * p + a], expected.x[a], 1e-12);
      EXPECT_NEAR(velocity[3 * p + a], expected.v[a], 1e-10);
    }
    for (int i = 0; i < 9; ++i)
      EXPECT_NEAR(stress[9 * p + i], expected.state.tau(i / 3, i % 3) / J, 1e-10 * 1e5);
  }
  EXPECT_GT(yielded, 20) << "elastic sand tests little";
}

TEST_P(AgainstReference, single_precision_to_its_rounding) {
  Method method = GetParam();
  method.precision = Precision::single_;
  for (int dimension : {2, 3}) {
    const Difference d = difference_after(4, dimension, method);
    EXPECT_LT(d.x, 2e-7) << dimension;  // positions are kept in cells of 0.1 m, 4 of them a block
    EXPECT_LT(d.v, 1e-4) << dimension;
    EXPECT_LT(d.F, 1e-5) << dimension;
  }
}

INSTANTIATE_TEST_SUITE_P(methods, AgainstReference, ::testing::ValuesIn(all_methods()),
                         [](const auto& info) { return to_string(info.param); });

}  // namespace
}  // namespace scree::testing
