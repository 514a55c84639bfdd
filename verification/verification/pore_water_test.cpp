// SPDX-License-Identifier: Apache-2.0
//
// Coupled pore water where the answer is known at once: undrained compression (case V36a),
// hydrostatic pressure, free bodies.
#include <gtest/gtest.h>

#include <cmath>

#include "verification/support/consolidation.hpp"

namespace scree::testing {
namespace {

constexpr double young = 1e7, poisson = 0.3, density = 2000, cell = 0.1;
constexpr double bulk = young / (3 * (1 - 2 * poisson)), shear = young / (2 * (1 + poisson));

PoreSetup pores() {
  PoreSetup p;
  p.porosity = 0.4;
  p.fluid_modulus = 2.2e9;
  p.grain_compliance = 1 / 40e9;
  p.biot = 0.9;
  return p;
}

/// A free block with a linear velocity field, sealed.
SimulationSetup block(int dimension, const Matrix& gradient, double dt, int steps,
                      const Method& method = {}) {
  SimulationSetup setup = make_setup(dimension, method, cell, {8, 8, 8});
  const auto points = lattice(Vector(0.2, 0.2, 0.2), Vector(0.6, 0.6, 0.6), cell / 2, dimension);
  BodySetup& body = add_jelly(setup, points, cell / 2, {young, poisson, density});
  body.pores = pores();
  set_velocity(body, Vector(0.2, -0.1, 0), gradient, Vector(0.4, 0.4, 0.4));
  setup.coupling.emplace();
  set_steps(setup, steps, dt);
  return setup;
}

TEST(CoupledWater, UndrainedCompressionGivesBiotsFactors) {
  const double inverse_M = storage_at(pores(), 0.4), alpha = 0.9;
  const double M = 1 / inverse_M;
  for (const bool isotropic : {true, false}) {
    Matrix gradient = Matrix::Zero();
    gradient(0, 0) = -0.01;
    if (isotropic) gradient = -0.01 * Matrix::Identity();
    const auto simulation = Simulation::create(block(3, gradient, 1e-6, 2));
    simulation->step();
    simulation->step();
    const auto snapshot = simulation->particles({"stress", "pore_pressure", "effective_stress"});
    const Vector center(0.425, 0.425, 0.425);
    std::size_t p = 0;
    while ((Eigen::Map<const Vector>(&snapshot.position[3 * p]) - center).norm() > 0.01) ++p;
    const double pressure = field(snapshot, "pore_pressure").values[p];
    const double total = -field(snapshot, "stress").values[9 * p];
    const double effective = -field(snapshot, "effective_stress").values[9 * p];
    const double modulus = isotropic ? bulk : bulk + 4 * shear / 3;
    // Strains of 2e-8; the free faces, 12 lengths of dt c away, have exp(-12) = 6e-6 of a say.
    EXPECT_NEAR(pressure / total, alpha * M / (alpha * alpha * M + modulus), 1e-5);
    EXPECT_NEAR(effective / (total - alpha * pressure), 1, 1e-9);
  }
}

/// Neither pressures nor the drain of a free body push it.
TEST(CoupledWater, FreeBodyKeepsItsMomentum) {
  for (const Method& method : all_methods()) {
    if (method.transfer == TransferType::flip) continue;
    Matrix gradient;
    gradient << -0.3, -1, 0, 1, 0.1, 0, 0, 0, 0;
    SimulationSetup setup = block(2, gradient, 1e-4, 20, method);
    setup.bodies[0].pores->mobility = 1e-8;
    const double mass = density * setup.bodies[0].particle_volume * 64;
    const Schedule schedule = setup.schedule;
    const auto simulation = Simulation::create(std::move(setup));
    run(*simulation, schedule);
    const HistoryRow row = simulation->history();
    double largest = 0;
    const auto snapshot = simulation->particles({"pore_pressure"});
    for (const double p : field(snapshot, "pore_pressure").values) {
      largest = std::max(largest, std::abs(p));
    }
    EXPECT_GT(largest, 100) << method;  // there is something to balance; pic damps the motion
    // Rounding of sums over nodes.
    EXPECT_NEAR(row.momentum[0] / (mass * 0.2), 1, 1e-12) << method;
    EXPECT_NEAR(row.momentum[1] / (mass * -0.1), 1, 1e-12) << method;
    EXPECT_LT(std::abs(row.fluid->error), 1e-5) << method;
  }
}

/// Water and soil under gravity: the pressure ends hydrostatic, the effective stress buoyant.
TEST(CoupledWater, ColumnUnderGravityEndsHydrostatic) {
  SoilColumn column;
  column.cells = 10;
  column.load = 0;
  column.density = density;
  column.pores.porosity = 0.4;
  column.set_consolidation(0.05 * column.wave_speed() * column.height);
  SimulationSetup setup = column_setup(column);
  setup.gravity = [](double) { return std::array<double, 3>{0, -10, 0}; };
  const double unit = column.height * column.height / column.consolidation();
  setup.schedule = Schedule(4 * unit, 0, 0, 0);
  const Schedule schedule = setup.schedule;
  const auto simulation = Simulation::create(std::move(setup));
  run(*simulation, schedule);
  const auto snapshot = simulation->particles({"pore_pressure", "effective_stress"});
  const double foot = 1000 * 10 * column.height, buoyant = (density - 1000) * 10;
  for (std::size_t p = 0; p < snapshot.id.size(); ++p) {
    const double depth = column.height - snapshot.position[3 * p + 1];
    // The rest of the consolidation is exp(-pi^2) = 5e-5, the drain's layer 2e-3/100 of the height.
    EXPECT_NEAR(field(snapshot, "pore_pressure").values[p] / foot, depth, 2e-3);
    EXPECT_NEAR(-field(snapshot, "effective_stress").values[9 * p + 4] / (buoyant * 1), depth,
                0.05);
  }
}

/// Next to a drain too, soil that lets nearly nothing through keeps the pressure of its load: the
/// drain's layer is as tight as the soil.
TEST(CoupledWater, TightSoilHoldsTheLoadAtADrain) {
  for (const int spacing : {1, 2}) {
    SoilColumn column;
    column.coupling.pressure_spacing = spacing;
    column.pores.porosity = 0.4;
    column.pores.fluid_modulus = 1e6 * column.youngs_modulus;
    column.set_consolidation(1e-9 * column.wave_speed() * column.height);
    SimulationSetup setup = column_setup(column);
    setup.schedule = Schedule(2 * column.height / column.wave_speed(), 0, 0, 0);
    const Schedule schedule = setup.schedule;
    const auto simulation = Simulation::create(std::move(setup));
    run(*simulation, schedule);
    const auto snapshot = simulation->particles({"pore_pressure"});
    for (const double p : field(snapshot, "pore_pressure").values) {
      // An independent one-dimensional code: 6e-3 and 7e-4, quadrature of three particles a cell.
      // With the load at the particles, not at their faces: 0.44 and 0.26.
      EXPECT_NEAR(p / column.load, 1, spacing == 1 ? 1.5e-2 : 5e-3) << spacing;
    }
  }
}

/// The lower half of a column's left side takes water in.
DrainageSetup inlet(const SoilColumn& column, const BodySetup& body, double rate) {
  DrainageSetup side;
  side.name = "side";
  side.type = DrainageType::flux;
  side.value = [rate](const double*, double) { return -rate; };
  const double spacing = column.cell() / column.particles;
  for (std::size_t p = 0; p < body.position.size() / 3; ++p) {
    if (body.position[3 * p] > spacing || body.position[3 * p + 1] > column.height / 2) continue;
    side.faces.push_back({std::int64_t(p), {-spacing, 0, 0}, {-0.5 * spacing, 0, 0}});
  }
  return side;
}

/// What left through each surface is what the pores lost, their volume measured on the particles
/// themselves; a given flux is met exactly.
TEST(CoupledWater, OutflowOfTheSurfacesIsWhatThePoresLose) {
  SoilColumn column;
  column.cells = 8;
  column.density = density;
  column.pores.porosity = 0.4;
  column.pores.fluid_modulus = 1e9 * column.youngs_modulus;
  column.set_consolidation(0.05 * column.wave_speed() * column.height);
  SimulationSetup setup = column_setup(column);
  const double spacing = column.cell() / column.particles, width = 2 * column.cell();
  const double rate = 1e-6;  // m/s
  setup.coupling->drainage.push_back(inlet(column, setup.bodies[0], rate));
  const double area = spacing * double(setup.coupling->drainage.back().faces.size());
  const double end = 0.3 * column.height * column.height / column.consolidation();
  setup.schedule = Schedule(end, 0, 0, 0);
  const Schedule schedule = setup.schedule;
  const auto simulation = Simulation::create(std::move(setup));
  const double start = simulation->history().fluid->mass;
  run(*simulation, schedule);
  const FluidBalance balance = *simulation->history().fluid;
  ASSERT_EQ(balance.surfaces.size(), 2u);
  // The faces shorten with the soil, by load/E at most.
  EXPECT_NEAR(balance.surfaces[1] / (-1000 * rate * area * end), 1,
              column.load / column.youngs_modulus);
  EXPECT_EQ(balance.surfaces[0] + balance.surfaces[1], balance.outflow);
  EXPECT_GT(balance.surfaces[0], 1000 * width * 0.3 * column.load / column.youngs_modulus);
  const auto snapshot = simulation->particles({"porosity", "volume"});
  double pores = 0;
  for (std::size_t p = 0; p < snapshot.id.size(); ++p) {
    pores += 1000 * field(snapshot, "porosity").values[p] * field(snapshot, "volume").values[p];
  }
  // Rounding of some thousand steps of the masses, against an outflow of 1e-4 of them; what
  // tr(dt grad v) misses of the change of J waits for the next step: squares of strains of 1e-4.
  EXPECT_NEAR((start - pores) / balance.outflow, 1, 1e-5);
  EXPECT_NEAR(balance.mass / pores, 1, 1e-12);
  EXPECT_LT(std::abs(balance.error), 1e-9);
}

/// Water that has no share in the stress leaves the soil as it is without water.
TEST(CoupledWater, WithoutAShareInTheStressTheSoilIsDry) {
  Matrix gradient;
  gradient << -0.3, -1, 0, 1, 0.1, 0, 0, 0, 0;
  Method method;
  method.path = PathType::split;
  SimulationSetup wet = block(2, gradient, 1e-4, 20, method);
  wet.bodies[0].pores->porosity = wet.bodies[0].pores->biot = 1e-12;
  SimulationSetup dry = block(2, gradient, 1e-4, 20, method);
  dry.bodies[0].pores.reset();
  dry.coupling.reset();
  const Schedule schedule = dry.schedule;
  const auto with = Simulation::create(std::move(wet)),
             without = Simulation::create(std::move(dry));
  run(*with, schedule);
  run(*without, schedule);
  const auto a = with->particles({"stress"}), b = without->particles({"stress"});
  for (std::size_t i = 0; i < a.position.size(); ++i) {
    // A share of 1e-12 in stresses of K_f/n x 1e-12 x strain, 2e-3 Pa: 1e-10 of the soil's.
    EXPECT_NEAR(a.position[i], b.position[i], 1e-10 * cell);
  }
}

}  // namespace
}  // namespace scree::testing
