// SPDX-License-Identifier: Apache-2.0
//
// Strides of coupled pore water: steps that share Q, storage and flow go where single steps go.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "solver/io/memory_archive.hpp"
#include "solver/simulation/stride.hpp"
#include "verification/support/consolidation.hpp"
#include "verification/support/final_state.hpp"

namespace scree::testing {
namespace {

constexpr double dx = 0.1, between = dx / 3, height = 0.4;
constexpr double dt = 0x1p-11;  // events at multiples of it are exact

/// Soft soil that settles under a sudden weight, drains at its top and slides along its base.
SimulationSetup scene(int dimension, int steps, int stride, double drift,
                      KernelType kernel = KernelType::compact) {
  SimulationSetup setup = make_setup(dimension, {kernel}, dx, {8, 8, 3});
  setup.gravity = [](double) { return std::array<double, 3>{3, -9.81, 0}; };
  setup.faces[1][0] = FaceType::symmetry;
  setup.faces[2] = {FaceType::symmetry, FaceType::symmetry};
  const auto points = lattice(Vector(0.1, 0, 0), Vector(0.4, height, 0.3), between, dimension);
  BodySetup& body = add_jelly(setup, points, between, {5e5, 0.3, 2000});
  body.pores.emplace();
  body.pores->porosity = 0.4;
  body.pores->mobility = 2e-7;
  body.pores->kozeny_carman = true;
  setup.coupling.emplace();
  setup.coupling->tolerance = 1e-12;
  setup.coupling->stride = stride;
  setup.coupling->stride_drift = drift;
  setup.coupling->drainage.push_back(drained_top(points, height, between, dimension));
  set_steps(setup, steps, dt);
  return setup;
}

struct Outcome {
  std::vector<double> position, pressure;
  FluidBalance water;
};

Outcome outcome(SimulationSetup setup) {
  const Schedule schedule = setup.schedule;
  const auto simulation = Simulation::create(std::move(setup));
  EXPECT_TRUE(simulation->fused());
  run(*simulation, schedule);
  const auto snapshot = simulation->particles({"pore_pressure"});
  return {snapshot.position, field(snapshot, "pore_pressure").values, *simulation->history().fluid};
}

double apart(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return INFINITY;
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / double(a.size()));
}

class CoupledStrides : public ::testing::TestWithParam<int> {};

/// What a stride lags behind is of first order in how far particles move within it. Measured for
/// 0.02, 0.005 and 0.00125 cells: 1.4e-5, 9e-7 and 2e-7 cells; 1e-3, 2e-5 and 1e-5 of the largest
/// pressure.
TEST_P(CoupledStrides, end_where_single_steps_do) {
  const int steps = 400, many = 1000;
  const Outcome single = outcome(scene(GetParam(), steps, 1, 0));
  double largest = 0;
  for (const double p : single.pressure) largest = std::max(largest, std::abs(p));
  double last = INFINITY;
  for (const double drift : {0.02, 0.005, 0.00125}) {
    const Outcome strides = outcome(scene(GetParam(), steps, many, drift));
    const double places = apart(strides.position, single.position) / dx;
    EXPECT_LT(places, 0.005 * drift) << drift;
    EXPECT_LT(places, last / 3) << drift;
    EXPECT_GT(places, 1e-9) << drift << ": no stride of several steps";
    EXPECT_LT(apart(strides.pressure, single.pressure), 0.2 * drift * largest) << drift;
    EXPECT_NEAR(strides.water.outflow, single.water.outflow,
                drift * std::abs(single.water.outflow));
    last = places;
  }
}

/// Volumes that the sum of tr(dt grad v) misses within a stride come back: no water is lost to
/// them. What is still missing is that of the last stride, the square of its strain.
TEST_P(CoupledStrides, lose_no_water) {
  for (const auto& [drift, strain] : {std::pair{0.0, 1e-5}, {0.001, 1e-5}, {0.05, 4e-3}}) {
    const Outcome end = outcome(scene(GetParam(), 400, 1000, drift));
    EXPECT_LT(std::abs(end.water.error), strain * strain) << drift;
  }
}

/// A sealed square that turns freely at 0.3 per second.
SimulationSetup turning(int dimension, int stride, double drift) {
  SimulationSetup setup = make_setup(dimension, {}, dx, {10, 10, 3});
  setup.faces[2] = {FaceType::symmetry, FaceType::symmetry};
  const auto points = lattice(Vector(0.2, 0.2, 0), Vector(0.8, 0.8, 0.3), between, dimension);
  BodySetup& body = add_jelly(setup, points, between, {2e7, 0.2, 2000});
  body.pores.emplace();
  body.pores->porosity = 0.4;
  Matrix turn = Matrix::Zero();
  turn(0, 1) = -0.3;
  turn(1, 0) = 0.3;
  set_velocity(body, Vector::Zero(), turn, Vector(0.5, 0.5, 0));
  setup.coupling.emplace();
  setup.coupling->tolerance = 1e-12;
  setup.coupling->stride = stride;
  setup.coupling->stride_drift = drift;
  return setup;
}

/// Pressures of the particle nearest to a quarter of the square, step by step over the second half
/// of the run.
std::vector<double> pressures_within(SimulationSetup setup) {
  const int steps = 240;
  set_steps(setup, steps, dt, true);
  const auto simulation = Simulation::create(std::move(setup));
  const std::vector<double> start = simulation->particles({"velocity"}).position;
  const auto away = [&](std::size_t p) {
    return std::hypot(start[3 * p] - 0.35, start[3 * p + 1] - 0.35);
  };
  std::size_t middle = 0;
  for (std::size_t p = 0; 3 * p < start.size(); ++p) middle = away(p) < away(middle) ? p : middle;
  std::vector<double> pressures;
  for (int n = 0; n < steps; ++n) {
    simulation->step();
    if (n < steps / 2) continue;
    const auto snapshot = simulation->particles({"pore_pressure"});
    pressures.push_back(field(snapshot, "pore_pressure").values.at(middle));
  }
  return pressures;
}

/// The way of particles turns at a stride's end, not in its steps: what would push them all along
/// does so in the first step of the next one. Its share of rho c v (1.8e4 Pa at the rim) is the
/// drift over the Courant number, 0.0025 for the whole of the way; the mean stays.
TEST_P(CoupledStrides, push_a_turning_body_as_single_steps_do_in_the_mean) {
  const int dimension = GetParam();
  const std::vector<double> single = pressures_within(turning(dimension, 1, 0));
  const std::vector<double> strides = pressures_within(turning(dimension, 64, 0.001));
  const auto mean = [](const std::vector<double>& p) {
    return std::accumulate(p.begin(), p.end(), 0.0) / double(p.size());
  };
  double most = 0;
  for (const double p : strides) most = std::max(most, std::abs(p - mean(single)));
  EXPECT_LT(mean(single), -1);
  EXPECT_NEAR(mean(strides), mean(single), 0.1 * std::abs(mean(single)));
  EXPECT_LT(most, 0.0025 * 1.8e4);
}

/// Area between the particles farthest along the diagonals, over that at the start.
double growth(const std::vector<double>& start, const std::vector<double>& end) {
  const auto area = [&](const std::vector<double>& x) {
    double sum = 0;
    std::array<std::size_t, 4> corner{};
    const std::array<std::array<int, 2>, 4> way{{{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};
    for (std::size_t k = 0; k < 4; ++k) {
      const auto far = [&](std::size_t p) {
        return way[k][0] * start[3 * p] + way[k][1] * start[3 * p + 1];
      };
      for (std::size_t p = 0; 3 * p < start.size(); ++p) {
        corner[k] = far(p) > far(corner[k]) ? p : corner[k];
      }
    }
    for (std::size_t k = 0; k < 4; ++k) {
      const double *a = &x[3 * corner[k]], *b = &x[3 * corner[(k + 1) % 4]];
      sum += 0.5 * (a[0] * b[1] - a[1] * b[0]);
    }
    return sum;
  };
  return area(end) / area(start);
}

/// Particles that go along the chords of their ways take up more room by the square of a stride's
/// angle, here 1.4e-4, and the law must see it at the stride's end: else a body swells without end,
/// here by five of them.
TEST_P(CoupledStrides, deform_particles_as_they_move_them) {
  SimulationSetup setup = turning(GetParam(), 1000, 0.05);
  set_steps(setup, 400, dt);
  const Schedule schedule = setup.schedule;
  const auto simulation = Simulation::create(std::move(setup));
  const std::vector<double> start = simulation->particles({"velocity"}).position;
  run(*simulation, schedule);
  const auto end = simulation->particles({"volume_ratio"});
  const std::vector<double>& ratios = field(end, "volume_ratio").values;
  const double mean = std::accumulate(ratios.begin(), ratios.end(), 0.0) / double(ratios.size());
  EXPECT_NEAR(growth(start, end.position), mean, 1.5e-4);
}

/// Positions that are looked at within a stride are those that the velocities have led to.
TEST_P(CoupledStrides, particles_move_by_their_velocities) {
  SimulationSetup setup = scene(GetParam(), 24, 5, 0.05);
  set_steps(setup, 24, dt, true);
  const auto simulation = Simulation::create(std::move(setup));
  std::vector<double> before = simulation->particles({"velocity"}).position;
  for (int step = 0; step < 24; ++step) {
    simulation->step();
    const auto now = simulation->particles({"velocity"});
    const std::vector<double>& v = field(now, "velocity").values;
    double most = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
      most = std::max(most, std::abs(now.position[i] - before[i] - dt * v[i]));
    }
    EXPECT_LT(most, 1e-15) << step;  // rounding of places within 1 m
    before = now.position;
  }
}

TEST_P(CoupledStrides, continue_bitwise_from_any_step) {
  const SimulationSetup setup = scene(GetParam(), 20, 7, 0.05);
  const MemoryArchive end = final_state(setup, 1);
  const auto whole = Simulation::create(setup);
  for (int step = 1; step <= 15; ++step) {
    whole->step();
    MemoryArchive middle;
    whole->save(middle);
    EXPECT_TRUE(end == continued_state(setup, middle)) << step;
  }
}

/// Rows of the history in every step or one at the end: the same run.
TEST_P(CoupledStrides, looking_leaves_no_trace) {
  SimulationSetup seldom = scene(GetParam(), 20, 7, 0.05), often = seldom;
  set_steps(often, 20, dt, true);
  const Outcome a = outcome(std::move(seldom)), b = outcome(std::move(often));
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.pressure, b.pressure);
  EXPECT_EQ(a.water.mass, b.water.mass);
}

/// A run goes on when the last particle has left.
TEST_P(CoupledStrides, end_with_nothing) {
  SimulationSetup setup = turning(GetParam(), 64, 0.001);
  set_velocity(setup.bodies[0], Vector(4, 0, 0));
  // The last particles hold their nodes by next to nothing: not quite undrained, as soil is.
  setup.bodies[0].pores->mobility = 1e-13;
  setup.coupling->tolerance = 1e-8;
  set_steps(setup, 600, dt);
  const Schedule schedule = setup.schedule;
  const auto simulation = Simulation::create(std::move(setup));
  run(*simulation, schedule);
  EXPECT_EQ(simulation->particle_count(), 0);
  EXPECT_NEAR(simulation->history().fluid->error, 0, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(all, CoupledStrides, ::testing::Values(2, 3));

}  // namespace
}  // namespace scree::testing
