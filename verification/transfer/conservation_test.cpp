// SPDX-License-Identifier: Apache-2.0
//
// What one step of the solver must conserve and reproduce (case V04 a, b, d).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "verification/support/random.hpp"
#include "verification/support/scene.hpp"

namespace scree::testing {
namespace {

constexpr double dx = 0.1;

/// Jittered jelly around the middle of an open domain, far from its faces.
std::vector<Vector> jittered_points(int dimension, Random& random) {
  std::vector<Vector> points =
      lattice(Vector(0.5, 0.5, 0.5), Vector(0.9, 0.9, 0.8), dx / 2, dimension);
  for (Vector& x : points) x += random.vector(0.2 * dx / 2, dimension);
  return points;
}

SimulationSetup random_motion(int dimension, const Method& method) {
  SimulationSetup setup = make_setup(dimension, method, dx, {14, 14, 14});
  Random random(61);
  BodySetup& body = add_jelly(setup, jittered_points(dimension, random), dx / 2, {});
  for (std::size_t p = 0; p < body.position.size() / 3; ++p) {
    const Vector v = Vector(0.3, 0.1, 0.2) + random.vector(0.5, dimension);
    const Matrix L = random.matrix(4.0, dimension);
    for (int c = 0; c < 3; ++c) body.velocity.push_back(c < dimension ? v[c] : 0.0);
    for (int i = 0; i < 9; ++i) body.velocity_gradient.push_back(L(i / 3, i % 3));
  }
  return setup;
}

class Conservation : public ::testing::TestWithParam<Method> {};

TEST_P(Conservation, mass_momentum_and_angular_momentum) {
  for (int dimension : {2, 3}) {
    SimulationSetup setup = random_motion(dimension, GetParam());
    set_steps(setup, 25, 5e-4, true);
    const Schedule schedule = setup.schedule;
    const auto simulation = Simulation::create(std::move(setup));
    const auto rows = run_with_history(*simulation, schedule);
    ASSERT_EQ(rows.size(), 26u);
    const double mass = rows[0].mass;
    const double angular_scale = mass * 1.0 * 1.0;  // mass times 1 m times 1 m/s
    double affine_drift = 0;
    for (const HistoryRow& row : rows) {
      EXPECT_EQ(row.mass, mass);
      EXPECT_EQ(row.particle_count, rows[0].particle_count);
      for (int a = 0; a < 3; ++a) {
        EXPECT_NEAR(row.momentum[a], rows[0].momentum[a], 25 * 1e-15 * mass);
        affine_drift =
            std::max(affine_drift, std::abs(row.angular_momentum[a] - rows[0].angular_momentum[a]));
      }
    }
    if (GetParam().affine()) {
      EXPECT_LT(affine_drift, 25 * 2e-15 * angular_scale);
    } else {
      EXPECT_GT(affine_drift, 1e-7 * angular_scale);  // they lose it: the sum is not a constant
    }
  }
}

/// The particles of a body from the last to the first.
void reverse(BodySetup& body) {
  const auto turn = [](std::vector<double>& values, std::ptrdiff_t size) {
    std::vector<double> turned;
    for (auto end = values.end(); end != values.begin(); end -= size)
      turned.insert(turned.end(), end - size, end);
    values = turned;
  };
  turn(body.position, 3);
  turn(body.velocity, 3);
  turn(body.velocity_gradient, 9);
}

TEST_P(Conservation, order_of_the_particles_is_rounding) {
  for (int dimension : {2, 3}) {
    State states[2];
    for (const bool turned : {false, true}) {
      SimulationSetup setup = random_motion(dimension, GetParam());
      if (turned) reverse(setup.bodies[0]);
      set_steps(setup, 3, 5e-4);
      const Schedule schedule = setup.schedule;
      const auto simulation = Simulation::create(std::move(setup));
      run(*simulation, schedule);
      states[turned] = state_of(*simulation);
    }
    std::reverse(states[1].x.begin(), states[1].x.end());
    std::reverse(states[1].v.begin(), states[1].v.end());
    EXPECT_LT(distance(states[0].x, states[1].x), 1e-14);  // 1e-12 of v times the steps
    EXPECT_LT(distance(states[0].v, states[1].v), 1e-12);  // sums in another order, light nodes
  }
}

TEST_P(Conservation, affine_velocity_field_survives_a_step) {
  if (!GetParam().affine()) return;
  for (int dimension : {2, 3}) {
    SimulationSetup setup = make_setup(dimension, GetParam(), dx, {14, 14, 14});
    Random random(62);
    BodySetup& body = add_jelly(setup, jittered_points(dimension, random), dx / 2, {});
    const Matrix L = random.matrix(2.0, dimension);
    const Vector v0 = random.vector(1.0, dimension);
    set_velocity(body, v0, L);
    const double dt = 1e-3;
    set_steps(setup, 1, dt);
    const std::vector<double> position = body.position;
    const Schedule schedule = setup.schedule;
    const auto simulation = Simulation::create(std::move(setup));
    run(*simulation, schedule);
    const State state = state_of(*simulation);
    for (std::size_t p = 0; p < state.x.size(); ++p) {
      const Vector X = Eigen::Map<const Vector>(&position[3 * p]);
      const Vector v = v0 + L * X;  // no stress in the first step: F = I
      EXPECT_LT((state.v[p] - v).norm(), 1e-13);
      EXPECT_LT((state.x[p] - X - dt * v).norm(), 1e-15 * 8);
      EXPECT_LT((state.F[p] - Matrix::Identity() - dt * L).norm(), 1e-13);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(methods, Conservation, ::testing::ValuesIn(all_methods()),
                         [](const auto& info) { return to_string(info.param); });

}  // namespace
}  // namespace scree::testing
