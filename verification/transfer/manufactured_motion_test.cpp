// SPDX-License-Identifier: Apache-2.0
//
// The solver and the reference method through a whole period of the motion of
// `scree verify manufactured_solution`, in which particles cross cells: both must be off by the
// same.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "materials/registry.hpp"
#include "verification/support/effort.hpp"
#include "verification/support/scene.hpp"

namespace scree::testing {
namespace {

// With 64 cells this tells what is left of the method's error there (page of the case).
constexpr int cells = 16;
constexpr double dx = 1.0 / cells, pi = std::numbers::pi;
constexpr double E = 1e7, nu = 0.3, density = 1000;

/// u_i(X, t) = +-A sin(pi X_i) sin(w t) and the body force that it needs: page of the case.
struct Motion {
  double A = 0.05;
  double w = pi * std::sqrt(E / density);
  reference::Lame lame{E, nu};

  Vector displacement(const double* X, double t) const {
    return A * std::sin(w * t) * Vector(std::sin(pi * X[0]), -std::sin(pi * X[1]), 0);
  }
  Matrix gradient(const double* X, double amplitude) const {
    return (amplitude * pi * Vector(std::cos(pi * X[0]), -std::cos(pi * X[1]), 0)).asDiagonal();
  }
  Vector body_force(const double* X, double t) const {
    const Vector u = displacement(X, t);
    const Matrix F = Matrix::Identity() + gradient(X, A * std::sin(w * t));
    const double pressed = lame.lambda * (1 - std::log(F(0, 0) * F(1, 1))) + lame.mu;
    Vector b = Vector::Zero();
    for (int a = 0; a < 2; ++a)
      b[a] = pi * pi * u[a] / density * (pressed / (F(a, a) * F(a, a)) + lame.mu - E);
    return b;
  }
};

struct Way {
  Method method;
  int per_direction;
};

SimulationSetup square(const Motion& motion, const Way& way) {
  SimulationSetup setup = make_setup(2, way.method, dx, {cells, cells, 1});
  for (int a = 0; a < 2; ++a) setup.faces[a] = {FaceType::symmetry, FaceType::symmetry};
  const double spacing = dx / way.per_direction;
  const auto points = lattice(Vector::Zero(), Vector(1, 1, 0), spacing, 2);
  BodySetup& body = add_rubber(setup, points, spacing, {E, nu}, density);
  for (const Vector& X : points) {
    const double speed = motion.A * motion.w;
    const Vector v = speed * Vector(std::sin(pi * X[0]), -std::sin(pi * X[1]), 0);
    const Matrix L = motion.gradient(X.data(), speed);
    body.velocity.insert(body.velocity.end(), {v[0], v[1], v[2]});
    for (int i = 0; i < 9; ++i) body.velocity_gradient.push_back(L(i / 3, i % 3));
  }
  setup.body_force = [motion](const double* X, const double*, double t) {
    const Vector b = motion.body_force(X, t);
    return std::array<double, 3>{b[0], b[1], 0};
  };
  return setup;
}

/// sqrt(mean |u - exact|^2/2)/A.
double error(const Motion& motion, const BodySetup& body, const std::vector<Vector>& x, double t) {
  double sum = 0;
  for (std::size_t p = 0; p < x.size(); ++p) {
    const double* X = &body.position[3 * p];
    const Vector u = x[p] - Eigen::Map<const Vector>(X);
    sum += (u - motion.displacement(X, t)).squaredNorm();
  }
  return std::sqrt(sum / (2 * static_cast<double>(x.size()))) / motion.A;
}

/// One step of the reference method; forces per mass change the velocities that it scatters.
void step_with_body_force(const Twin& twin, const Motion& motion, const BodySetup& body, double t,
                          double dt) {
  auto& particles = twin.solver->particles();
  for (std::size_t p = 0; p < particles.size(); ++p)
    particles[p].v += dt * motion.body_force(&body.position[3 * p], t);
  twin.solver->step(dt);
}

class ManufacturedMotion : public ::testing::TestWithParam<Way> {};

TEST_P(ManufacturedMotion, is_that_of_the_reference_method) {
  if (find_material_model("neo_hookean") == nullptr) GTEST_SKIP() << "the law is left out";
  const Motion motion;
  const double period = 2 * pi / motion.w;
  const double sound = std::sqrt((motion.lame.lambda + 2 * motion.lame.mu) / density);
  const int steps = 16 * static_cast<int>(std::ceil(period / 16 / (0.2 * dx / sound)));
  SimulationSetup setup = square(motion, GetParam());
  const BodySetup body = setup.bodies[0];
  const double dt = period / steps;
  const int done = effort(steps);
  set_steps(setup, done, dt, true);
  const Twin twin = reference_twin(setup);
  const auto simulation = Simulation::create(std::move(setup));
  double largest = 0, largest_of_reference = 0;
  for (int n = 0; n < done; ++n) {
    step_with_body_force(twin, motion, body, n * dt, dt);
    simulation->step();
    if ((n + 1) % (steps / 16) != 0) continue;
    const double t = (n + 1) * dt;
    largest = std::max(largest, error(motion, body, state_of(*simulation).x, t));
    largest_of_reference = std::max(largest_of_reference, error(motion, body, twin.state().x, t));
  }
  RecordProperty("largest_error", std::to_string(largest));
  EXPECT_NEAR(largest, largest_of_reference, 1e-9);
  // Rounding of forty steps (against_reference_test), carried on through a whole period.
  EXPECT_LT(distance(state_of(*simulation).x, twin.state().x), 1e-10);
}

Way way(KernelType kernel, TransferType transfer, int per_direction) {
  return {{kernel, transfer, PathType::split, Precision::double_}, per_direction};
}

INSTANTIATE_TEST_SUITE_P(ways, ManufacturedMotion,
                         ::testing::Values(way(KernelType::compact, TransferType::apic, 3),
                                           way(KernelType::compact, TransferType::mls, 4),
                                           way(KernelType::quadratic, TransferType::apic, 2)),
                         [](const auto& info) { return to_string(info.param.method); });

}  // namespace
}  // namespace scree::testing
