// SPDX-License-Identifier: Apache-2.0
//
// Undrained soil in the solver (case V36a): a block compressed by a linear velocity field, against
// the closed forms of small strain. Every particle sees the same increments until its neighbours
// at the block's faces, where the stress jumps, have been heard of.
#include <gtest/gtest.h>

#include <cmath>

#include "verification/support/scene.hpp"

namespace scree::testing {
namespace {

constexpr double young = 1e7, poisson = 0.3, pore_bulk = 2.2e9 / 0.4, density = 2000;
constexpr double bulk = young / (3 * (1 - 2 * poisson)), shear = young / (2 * (1 + poisson));
constexpr double cell = 0.1;
const double wave_speed = std::sqrt((bulk + 4 * shear / 3 + pore_bulk) / density);

// Strains near 1e-7: terms of second order are 1e-7 of the stress, rounding of F 1e-9.
constexpr double tolerance = 1e-6;
constexpr double small_step = 1e-7 / 0.01;  // at rates of 0.01/s

SimulationSetup block(int dimension, const Matrix& gradient, const Method& method = {}) {
  SimulationSetup setup = make_setup(dimension, method, cell, {8, 8, 8});
  const auto points = lattice(Vector(0.2, 0.2, 0.2), Vector(0.6, 0.6, 0.6), cell / 2, dimension);
  BodySetup& body = add_jelly(setup, points, cell / 2, {young, poisson, density});
  body.undrained_bulk_modulus = pore_bulk;
  set_velocity(body, Vector::Zero(), gradient, Vector(0.4, 0.4, 0.4));
  set_steps(setup, 2, small_step);
  return setup;
}

struct Response {
  double pressure;        ///< pore pressure [Pa]
  double total, lateral;  ///< stresses xx, yy, compression positive [Pa]
  double effective;       ///< xx
  double mean;            ///< field `pressure`
};

/// After two steps at the particle nearest to the centre.
Response response(const SimulationSetup& setup) {
  const auto simulation = Simulation::create(setup);
  run(*simulation, setup.schedule);
  const auto snapshot =
      simulation->particles({"stress", "effective_stress", "pore_pressure", "pressure"});
  const Vector center(0.425, 0.425, setup.dimension == 3 ? 0.425 : 0);
  std::size_t p = 0;
  while ((Eigen::Map<const Vector>(&snapshot.position[3 * p]) - center).norm() > 0.01) ++p;
  const auto& stress = field(snapshot, "stress").values;
  return {field(snapshot, "pore_pressure").values[p], -stress[9 * p], -stress[9 * p + 4],
          -field(snapshot, "effective_stress").values[9 * p],
          field(snapshot, "pressure").values[p]};
}

TEST(Undrained, IsotropicCompressionGivesSkemptonsB) {
  const Response r = response(block(3, -0.01 * Matrix::Identity()));
  EXPECT_NEAR(r.pressure / r.total, pore_bulk / (pore_bulk + bulk), tolerance);
  EXPECT_NEAR(r.mean / r.total, 1, tolerance);
  EXPECT_NEAR(r.effective / (r.total - r.pressure), 1, 1e-9);  // rounding of the difference
}

TEST(Undrained, OedometricCompressionGivesBiotsFactor) {
  Matrix uniaxial = Matrix::Zero();
  uniaxial(0, 0) = -0.01;
  for (const TransferType transfer : {TransferType::mls, TransferType::apic}) {
    Method method;
    method.transfer = transfer;
    for (const int dimension : {2, 3}) {
      const Response r = response(block(dimension, uniaxial, method));
      EXPECT_NEAR(r.pressure / r.total, pore_bulk / (pore_bulk + bulk + 4 * shear / 3), tolerance);
      const double undrained = bulk + pore_bulk,
                   nu = (3 * undrained - 2 * shear) / (2 * (3 * undrained + shear));
      EXPECT_NEAR(r.lateral / r.total, nu / (1 - nu), tolerance);
    }
  }
}

TEST(Undrained, WaterRaisesTheWaveSpeedOfTheTimeStep) {
  SimulationSetup setup = block(2, Matrix::Zero());
  setup.step.reset();
  setup.schedule = Schedule(1, 0, 0, 0);
  const auto simulation = Simulation::create(setup);
  // To rounding: the whole second is divided into equal steps of at most cfl dx/c.
  EXPECT_NEAR(simulation->dt() / (setup.cfl * cell / wave_speed), 1, 1e-3);
}

/// After one step every particle has the same strain: energy of soil and water together is
/// (K + K_u) ln(J)^2/2 per volume.
TEST(Undrained, HistoryHasTheEnergyOfSoilAndWater) {
  SimulationSetup setup = block(3, -0.01 * Matrix::Identity());
  set_steps(setup, 1, small_step);
  const auto simulation = Simulation::create(setup);
  simulation->step();
  const double change = 3 * 0.01 * small_step, volume = 0.4 * 0.4 * 0.4;
  const double expected = 0.5 * (bulk + pore_bulk) * change * change * volume;
  EXPECT_NEAR(simulation->history().elastic_energy / expected, 1, tolerance);
}

}  // namespace
}  // namespace scree::testing
