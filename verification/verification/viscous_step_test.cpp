// SPDX-License-Identifier: Apache-2.0
//
// Explicit viscosity and the time step: the limit of diffusion, and a fluid far beyond its wave
// speed's limit that only comes to rest.
#include <gtest/gtest.h>

#include <cmath>

#include "solver/simulation/lone_particle.hpp"
#include "verification/support/random.hpp"
#include "verification/support/scene.hpp"

namespace scree::testing {
namespace {

constexpr double cell = 0.1, density = 1000, bulk = 1e4, gamma = 1;
constexpr double viscosity = 1e3;  // 2 d D/dx is 25 (2D) and 38 (3D) times the speed of sound
const double sound = std::sqrt(bulk * gamma / density);

/// A block of 4 cells that jitters at up to 0.1 m/s.
SimulationSetup jittering_block(int dimension) {
  SimulationSetup setup = make_setup(dimension, {}, cell, {8, 8, 8});
  setup.step.reset();
  const auto points = lattice(Vector(0.2, 0.2, 0.2), Vector(0.6, 0.6, 0.6), cell / 2, dimension);
  JFluid::Input input;
  input.bulk_modulus = bulk;
  input.gamma = gamma;
  input.viscosity = viscosity;
  BodySetup& body = add_fluid(setup, points, cell / 2, input, density);
  set_velocity(body, Vector::Zero());
  Random random(3);
  for (std::size_t i = 0; i < body.velocity.size(); ++i) {
    if (int(i % 3) < dimension) body.velocity[i] = random.uniform(-0.1, 0.1);
  }
  return setup;
}

TEST(ViscousStep, StaysBelowTheLimitOfDiffusion) {
  for (const int dimension : {2, 3}) {
    SimulationSetup setup = jittering_block(dimension);
    const double diffusivity = 2 * viscosity / density;
    setup.schedule = Schedule(1, 1, 1, 0);
    const auto simulation = Simulation::create(setup);
    simulation->step();
    const double cfl = courant_number(setup);  // of drops, docs/method.md, section 3
    const double rest = cfl * cell / (sound + 2 * dimension * diffusivity / cell);
    // Particles move at up to sqrt(d) 0.1 m/s beside 50 m/s and more, densities differ by 1 %.
    EXPECT_NEAR(simulation->dt() / rest, 1, 0.02);
    EXPECT_LT(simulation->dt(), cfl * cell * cell / (2 * dimension * diffusivity));
  }
}

TEST(ViscousStep, AFluidFarBeyondTheLimitOfSoundComesToRest) {
  for (const int dimension : {2, 3}) {
    SimulationSetup setup = jittering_block(dimension);
    setup.schedule = Schedule(0.02, 1e-4, 1, 0);
    const auto simulation = Simulation::create(setup);
    const auto rows = run_with_history(*simulation, setup.schedule);
    ASSERT_GT(rows.size(), 100u);
    for (std::size_t i = 1; i < rows.size(); ++i) {
      EXPECT_LE(rows[i].kinetic_energy, rows[i - 1].kinetic_energy * (1 + 1e-12)) << i;
    }
  }
}

}  // namespace
}  // namespace scree::testing
