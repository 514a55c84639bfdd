// SPDX-License-Identifier: Apache-2.0
//
// Motions with exact answers: free fall, rigid translation, rigid rotation (case V06), periodic
// faces.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "verification/reference/closed_forms.hpp"
#include "verification/support/effort.hpp"
#include "verification/support/scene.hpp"

namespace scree::testing {
namespace {

class MotionTest : public ::testing::TestWithParam<Method> {};

TEST_P(MotionTest, free_fall) {
  for (int dimension : {2, 3}) {
    for (int side : {1, 4}) {  // one particle, and a block of 4^d
      if (slow_build && side == 4 && dimension == 3) continue;
      SimulationSetup setup = make_setup(dimension, GetParam(), 0.25, {20, 40, 20});
      const double g[3] = {0.4, -9.81, dimension == 3 ? 1.5 : 0.0};
      setup.gravity = [g](double) { return std::array<double, 3>{g[0], g[1], g[2]}; };
      const Vector lower(2.03, 8.01, 2.07), v0(0.7, 1.1, dimension == 3 ? -0.3 : 0.0);
      const auto points = lattice(lower, lower + Vector::Constant(side * 0.125), 0.125, dimension);
      set_velocity(add_jelly(setup, points, 0.125, {}), v0);
      const int steps = 100;
      const double dt = 4e-3;
      set_steps(setup, steps, dt);
      const Schedule schedule = setup.schedule;
      const auto simulation = Simulation::create(std::move(setup));
      run(*simulation, schedule);
      const State state = state_of(*simulation);
      ASSERT_EQ(state.x.size(), points.size());
      for (std::size_t p = 0; p < points.size(); ++p) {
        for (int a = 0; a < dimension; ++a) {
          const reference::Fall fall = reference::symplectic_euler_fall(steps, dt, g[a], v0[a]);
          EXPECT_NEAR(state.x[p][a], points[p][a] + fall.position, 1e-12);
          EXPECT_NEAR(state.v[p][a], fall.velocity, 1e-12);
        }
        EXPECT_LT((state.F[p] - Matrix::Identity()).norm(), 1e-13);
      }
    }
  }
}

/// A stress-free block at v = (0.37, 0.21, 0.11) m/s through 20 cells.
TEST_P(MotionTest, translation_leaves_no_stress_and_no_distortion) {
  const double dx = 0.05;
  const Jelly jelly{4000, 0.3, 1000};
  for (int dimension : {2, 3}) {
    if (slow_build && dimension == 3) continue;
    SimulationSetup setup = make_setup(dimension, GetParam(), dx, {32, 24, 20});
    const Vector lower(0.21, 0.23, 0.22), v(0.37, 0.21, dimension == 3 ? 0.11 : 0.0);
    const auto points = lattice(lower, lower + Vector::Constant(3 * dx), dx / 2, dimension);
    set_velocity(add_jelly(setup, points, dx / 2, jelly), v);
    const double end = 20 * dx / v[0];
    setup.schedule = Schedule(end, 0, 0, 0);
    const Schedule schedule = setup.schedule;
    const auto simulation = Simulation::create(std::move(setup));
    run(*simulation, schedule);
    const auto snapshot = simulation->particles({"stress"});
    for (double s : field(snapshot, "stress").values) EXPECT_LT(std::abs(s), 1e-9 * 4000);
    const State state = state_of(*simulation);
    for (std::size_t p = 0; p < points.size(); ++p)
      EXPECT_LT((state.x[p] - points[p] - end * v).norm(), 1e-10 * dx + 1e-12);
  }
}

/// A block that crosses a periodic face moves as in an endless domain.
TEST_P(MotionTest, periodic_face_is_invisible) {
  // The hat function's force does not fade with its node's mass: edge particles blow up sooner or
  // later.
  if (GetParam().kernel == KernelType::linear) return;
  const double dx = 0.1, length = 8 * dx;
  const Matrix L = (Matrix() << 0.3, -1.0, 0, 0.8, -0.4, 0, 0, 0, 0).finished();
  State states[2];
  for (bool periodic : {false, true}) {
    SimulationSetup setup = make_setup(2, GetParam(), dx, {periodic ? 8 : 24, 8, 1});
    if (periodic) setup.faces[0] = {FaceType::periodic, FaceType::periodic};
    const Vector lower(0.35, 0.26, 0), upper(0.65, 0.56, 0);
    const auto points = lattice(lower, upper, dx / 3, 2);
    set_velocity(add_jelly(setup, points, dx / 3, {}), Vector(3, 0.1, 0), L, 0.5 * (lower + upper));
    set_steps(setup, 300, 1e-3);
    const Schedule schedule = setup.schedule;
    const auto simulation = Simulation::create(std::move(setup));
    run(*simulation, schedule);
    states[periodic] = state_of(*simulation);
  }
  ASSERT_EQ(states[0].x.size(), states[1].x.size());
  EXPECT_GT(states[0].x[0][0], length);
  for (std::size_t p = 0; p < states[0].x.size(); ++p) {
    Vector difference = states[0].x[p] - states[1].x[p];
    difference[0] = std::remainder(difference[0], length);
    EXPECT_LT(difference.norm(), 1e-10);
    EXPECT_GE(states[1].x[p][0], 0);
    EXPECT_LE(states[1].x[p][0], length);
  }
}

/// Largest relative change of the particles' axial stress, uniform at first, after a body that
/// fills a periodic domain has moved by a twelfth of a cell.
double scatter_of_moved_stress(const Method& method, int particles) {
  const double dx = 0.1, dt = 1e-3;
  const int steps = 500;
  SimulationSetup setup = make_setup(2, method, dx, {4, 4, 1});
  for (int axis : {0, 1}) setup.faces[axis] = {FaceType::periodic, FaceType::periodic};
  const auto points = lattice(Vector::Zero(), Vector(4 * dx, 4 * dx, 0), dx / particles, 2);
  BodySetup& body = add_jelly(setup, points, dx / particles, {1e6, 0, 1800});
  body.states = {{0.99, 0, 0, 0, 1, 0, 0, 0, 1}};  // F: E/100 along x
  body.state_of.assign(points.size(), 0);
  set_velocity(body, Vector(dx / 12 / (steps * dt), 0, 0));
  set_steps(setup, steps, dt);
  const Schedule schedule = setup.schedule;
  const auto simulation = Simulation::create(std::move(setup));
  const auto axial = [&](std::size_t p) {
    return field(simulation->particles({"stress"}), "stress").values[9 * p];
  };
  const double before = axial(0);
  run(*simulation, schedule);
  double largest = 0;
  const auto snapshot = simulation->particles({"stress"});
  for (std::size_t p = 0; p < points.size(); ++p)
    largest = std::max(largest, std::abs(field(snapshot, "stress").values[9 * p] / before - 1));
  return largest;
}

/// The forces of mls on the dual grid see the third harmonic of s/D, of amplitude 0.049, if there
/// are three particles a direction (docs/method.md, section 2); its balance changes their stresses
/// by 2 x 0.049/1.43 = 7 % at most.
TEST_P(MotionTest, uniform_stress_stays_uniform) {
  if (GetParam().kernel == KernelType::linear) return;  // cell crossing
  const bool dual = GetParam().kernel == KernelType::compact;
  for (int particles : {2, 3, 4}) {
    const double scatter = scatter_of_moved_stress(GetParam(), particles);
    if (dual && GetParam().transfer == TransferType::mls && particles == 3) {
      EXPECT_GT(scatter, 0.04);
      EXPECT_LT(scatter, 0.07);
    } else {
      EXPECT_LT(scatter, 1e-9) << particles;  // rounding of 500 steps
    }
  }
}

/// Kinetic energy about the centre of mass of a disk that vibrates, as a share of the first, in a
/// frame of reference that moves with `wind`.
std::vector<double> energies_of_a_vibration(const Method& method, const Vector& wind) {
  const double h = 0.025;
  const Jelly soft{1000, 0.3, 1000};
  SimulationSetup setup = make_setup(2, method, h, {96, 64, 1});
  const Vector center(0.7, 0.7, 0), reach(0.25, 0.25, 0);
  const auto points = lattice(center - reach, center + reach, h / 4, 2,
                              [&](const Vector& x) { return (x - center).norm() < 0.2; });
  const Matrix stretching = (Matrix() << 0.1, 0.05, 0, 0.05, -0.1, 0, 0, 0, 0).finished();
  set_velocity(add_jelly(setup, points, h / 4, soft), wind, stretching, center);
  setup.step = 0.3 * h / (soft.wave_speed() + 0.5);
  setup.schedule = Schedule(2.0, 0.05, 0, 0);
  const Schedule schedule = setup.schedule;
  const auto simulation = Simulation::create(std::move(setup));
  std::vector<double> shares;
  double first = 0;
  for (const HistoryRow& row : run_with_history(*simulation, schedule)) {
    double bulk = 0;
    for (int a = 0; a < 2; ++a) bulk += row.momentum[a] * row.momentum[a] / (2 * row.mass);
    if (shares.empty()) first = row.kinetic_energy - bulk;
    shares.push_back((row.kinetic_energy - bulk) / first);
  }
  return shares;
}

/// A body vibrates on a moving grid as on one at rest, but for the places of the particles in
/// their cells.
TEST_P(MotionTest, vibration_does_not_depend_on_the_frame_of_reference) {
  if (GetParam().kernel == KernelType::linear || !GetParam().affine()) return;
  if (slow_build) GTEST_SKIP() << "hundreds of steps, minutes with sanitizers";
  const auto rest = energies_of_a_vibration(GetParam(), Vector::Zero());
  const auto moving = energies_of_a_vibration(GetParam(), Vector(0.37, 0.21, 0));
  ASSERT_EQ(rest.size(), moving.size());
  EXPECT_LT(*std::ranges::min_element(rest), 0.3) << "no vibration";
  for (std::size_t i = 0; i < rest.size(); ++i) EXPECT_NEAR(moving[i], rest[i], 0.01) << i;
}

/// A lattice of particles that moves a whole number of their spacings lies beside nodes again, off
/// by rounding: nodes that only rims of kernels reach must not throw anything.
TEST_P(MotionTest, passing_nodes_exactly_throws_nothing) {
  if (GetParam().kernel == KernelType::linear) return;
  const double h = 0.05;
  const Jelly soft{1000, 0.3, 1000};
  for (int particles : {2, 3}) {
    SimulationSetup setup = make_setup(2, GetParam(), h, {48, 48, 1});
    setup.flip_blend = 0.95;
    for (int b = 0; b < 2; ++b) {
      const Vector center = Vector(14.3 * h, 14.3 * h, 0) + b * Vector(8 * h, 8 * h, 0);
      const Vector reach(0.25, 0.25, 0);
      const auto points = lattice(center - reach, center + reach, h / particles, 2,
                                  [&](const Vector& x) { return (x - center).norm() < 0.2; });
      const double v = b == 0 ? 0.1 : -0.1;
      set_velocity(add_jelly(setup, points, h / particles, soft), Vector(v, v, 0));
    }
    setup.step = 0.3 * h / soft.wave_speed();
    setup.schedule = Schedule(1.5, 0.1, 0, 0);  // 0.1 s: a fifth of a cell
    const Schedule schedule = setup.schedule;
    const auto simulation = Simulation::create(std::move(setup));
    run(*simulation, schedule);
    // Two bodies that meet at 0.2 m/s an axis: nothing is faster than that.
    for (const Vector& v : state_of(*simulation).v) EXPECT_LT(v.norm(), 0.2 * std::sqrt(2.0));
  }
}

INSTANTIATE_TEST_SUITE_P(methods, MotionTest, ::testing::ValuesIn(all_methods()),
                         [](const auto& info) { return to_string(info.param); });

/// A stiff square of 16 cells spins once. Its corners stretch by omega^2 R^2/(2 c^2) at most.
void spin(const Method& method, double kinetic_share) {
  const double dx = 1.0 / 16, omega = 2 * std::numbers::pi;
  const Jelly jelly{1e6, 0.3, 1000};
  SimulationSetup setup = make_setup(2, method, dx, {32, 32, 1});
  const Vector center(1.01, 0.98, 0), half(0.5, 0.5, 0);
  const auto points = lattice(center - half, center + half, dx / 2, 2);
  Matrix rotation = Matrix::Zero();
  rotation(0, 1) = -omega;
  rotation(1, 0) = omega;
  set_velocity(add_jelly(setup, points, dx / 2, jelly), Vector::Zero(), rotation, center);
  setup.schedule = Schedule(1.0, 0.05, 0, 0);
  const Schedule schedule = setup.schedule;
  const auto simulation = Simulation::create(std::move(setup));
  const auto rows = run_with_history(*simulation, schedule);
  // sum over lattice points of m r^2 omega; the affine part adds m omega tr D.
  EXPECT_NEAR(rows[0].angular_momentum[2] / (1000 * omega / 6), 1, 0.02);
  for (const HistoryRow& row : rows)
    EXPECT_NEAR(row.angular_momentum[2] / rows[0].angular_momentum[2], 1, 1e-11);
  EXPECT_GT(rows.back().kinetic_energy / rows[0].kinetic_energy, kinetic_share);
  EXPECT_LT(rows.back().kinetic_energy / rows[0].kinetic_energy, 1.001);
  const double R = std::sqrt(0.5), c = jelly.wave_speed();
  const State state = state_of(*simulation);
  for (std::size_t p = 0; p < points.size(); ++p) {
    const double before = (points[p] - center).norm(), after = (state.x[p] - center).norm();
    EXPECT_LT(after - before, R * (omega * omega * R * R / (2 * c * c) + 0.005));
  }
}

TEST(Rotation, square_keeps_its_spin) {
  if (slow_build) GTEST_SKIP() << "thousands of steps, minutes with sanitizers";
  for (KernelType kernel : {KernelType::compact, KernelType::quadratic}) {
    spin({kernel, TransferType::mls, PathType::fused, Precision::double_}, 0.99);
    spin({kernel, TransferType::apic, PathType::split, Precision::double_}, 0.99);
  }
}

}  // namespace
}  // namespace scree::testing
