// SPDX-License-Identifier: Apache-2.0
//
// Coupled pore water over many steps: order in time, stability, closed bodies, rest, jittered
// particles.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "solver/base/error.hpp"
#include "verification/cases/strip_load/exact.hpp"
#include "verification/support/consolidation.hpp"
#include "verification/support/random.hpp"

namespace scree::testing {
namespace {

std::vector<double> pressures(const Simulation& simulation) {
  const auto snapshot = simulation.particles({"pore_pressure"});
  return field(snapshot, "pore_pressure").values;
}

double difference(const std::vector<double>& a, const std::vector<double>& b) {
  double square = 0;
  for (std::size_t p = 0; p < a.size(); ++p) square += (a[p] - b[p]) * (a[p] - b[p]);
  return std::sqrt(square / double(a.size()));
}

SoilColumn short_column(int spacing, double consolidation) {
  SoilColumn column;
  column.cells = 10;
  column.coupling.pressure_spacing = spacing;
  column.pores.porosity = 0.4;
  column.pores.fluid_modulus = 1e6 * column.youngs_modulus;
  column.set_consolidation(consolidation * column.wave_speed() * column.height);
  return column;
}

TEST(PoreWaterSteps, HalvingTheStepHalvesTheError) {
  for (const int spacing : {1, 2}) {
    const SoilColumn column = short_column(spacing, 0.01);
    const double end = 0.1 * column.height * column.height / column.consolidation();
    std::vector<std::vector<double>> results;
    for (const int steps : {256, 512, 1024}) {  // the first: 0.39 of cell over wave speed
      SimulationSetup setup = column_setup(column);
      set_steps(setup, steps, end / steps);
      const Schedule schedule = setup.schedule;
      const auto simulation = Simulation::create(std::move(setup));
      run(*simulation, schedule);
      results.push_back(pressures(*simulation));
    }
    const double first = difference(results[0], results[1]);
    // Backward Euler is of first order: 2; terms of second order, a tenth of it at these steps.
    EXPECT_GT(first / difference(results[1], results[2]), 1.8) << spacing;
    EXPECT_LT(first / difference(results[1], results[2]), 2.6) << spacing;
    EXPECT_GT(first / column.load, 1e-5) << spacing;  // there is an error to halve
  }
}

/// Energy of a suddenly loaded column after 600 steps of `courant` cell over wave speed, over the
/// most that the load can give it; infinite where the run ends with a fault.
double energy_after_steps(const SoilColumn& column, double courant) {
  SimulationSetup setup = column_setup(column);
  set_steps(setup, 600, courant * column.cell() / column.wave_speed());
  const Schedule schedule = setup.schedule;
  const auto simulation = Simulation::create(std::move(setup));
  try {
    run(*simulation, schedule);
  } catch (const RunFault&) {
    return std::numeric_limits<double>::infinity();
  }
  const HistoryRow row = simulation->history();
  const double settlement = 2 * column.load * column.height / column.youngs_modulus;
  return (row.kinetic_energy + row.elastic_energy) / (column.load * settlement * 2 * column.cell());
}

/// The drained soil alone bounds the step, whatever the permeability.
TEST(PoreWaterSteps, StepsOfTheDrySoilAreStable) {
  for (const int spacing : {1, 2}) {
    for (const double consolidation : {1e3, 1.0, 1e-3, 1e-8}) {  // c_v over wave speed x height
      const double energy = energy_after_steps(short_column(spacing, consolidation), 0.6);
      // All of the load's work, and what the softer surface layer adds to the settlement.
      EXPECT_LT(energy, 1.1) << spacing << " " << consolidation;
      EXPECT_GT(energy, 1e-9) << spacing << " " << consolidation;
    }
  }
  // The limit of these columns is 0.76 dry: the test can tell.
  EXPECT_GT(energy_after_steps(short_column(1, 1e3), 1.2), 1e3);
}

/// Half a turn of a closed body.
HistoryRow spun_body(VolumetricLocking locking, int stride, double rate, double dt) {
  const double cell = 0.1;
  SimulationSetup setup = make_setup(2, {}, cell, {16, 16, 1});
  setup.volumetric_locking = locking;
  const auto points = lattice(Vector(0.4, 0.4, 0), Vector(1.2, 1.2, 0), cell / 3, 2);
  BodySetup& body = add_jelly(setup, points, cell / 3, {1e7, 0.3, 2000});
  body.pores.emplace();
  body.pores->porosity = 0.4;
  Matrix spin = Matrix::Zero();
  spin(0, 1) = -rate;
  spin(1, 0) = rate;
  set_velocity(body, Vector::Zero(), spin, Vector(0.8, 0.8, 0));
  setup.coupling.emplace();
  setup.coupling->stride = stride;
  set_steps(setup, 320, dt);
  const Schedule schedule = setup.schedule;
  const auto simulation = Simulation::create(std::move(setup));
  run(*simulation, schedule);
  return simulation->history();
}

/// The volume changes by what the water is compressed, no more; whatever the laws see of it.
TEST(PoreWaterSteps, ClosedBodyThatSpinsKeepsItsVolume) {
  const double rate = 20, dt = 5e-4;
  for (const VolumetricLocking locking : {VolumetricLocking::none, VolumetricLocking::fbar}) {
    const HistoryRow row = spun_body(locking, 1, rate, dt);
    EXPECT_GT(row.angular_momentum[2], 0.9 * 2000 * 0.64 * rate * 0.64 / 6);  // it did spin
    // What tr(dt grad v) misses of det(I + dt grad v), (rate dt)^2 of the volume a step, the next
    // step takes back: of the pores, that of one step is left, not of 320. The body is not quite
    // rigid: strains of rate^2 (0.4 m)^2 density/modulus, 1e-2.
    const double pending = (rate * dt) * (rate * dt) / 0.4;
    EXPECT_NEAR(row.fluid->error, pending, 1e-2 * pending) << int(locking);
    EXPECT_EQ(row.fluid->outflow, 0);
  }
  // With strides, here of one step, it is foreseen: steps miss the same one after the other.
  const HistoryRow row = spun_body(VolumetricLocking::none, 64, rate, dt);
  EXPECT_LT(std::abs(row.fluid->error), 1e-3 * (rate * dt) * (rate * dt) / 0.4);
}

/// Where the soil is compressed evenly the averages of its changes of volume are these themselves.
TEST(PoreWaterSteps, ConsolidationIsTheSameWithAveragedVolumes) {
  for (const int spacing : {1, 2}) {
    const SoilColumn column = short_column(spacing, 0.01);
    std::vector<std::vector<double>> results;
    for (const VolumetricLocking locking : {VolumetricLocking::none, VolumetricLocking::fbar}) {
      SimulationSetup setup = column_setup(column);
      setup.volumetric_locking = locking;
      const double end = 0.1 * column.height * column.height / column.consolidation();
      setup.schedule = Schedule(end, 0, 0, 0);
      const Schedule schedule = setup.schedule;
      const auto simulation = Simulation::create(std::move(setup));
      run(*simulation, schedule);
      results.push_back(pressures(*simulation));
      EXPECT_LT(std::abs(simulation->history().fluid->error), 1e-8) << spacing;
    }
    // The error of either on 10 cells against the series: 1.4e-3 and 4.9e-3 (docs/coupling.md).
    const double allowed = spacing == 1 ? 1.5e-3 : 5e-3;
    EXPECT_LT(difference(results[0], results[1]) / column.load, allowed) << spacing;
    EXPECT_GT(difference(results[0], results[1]) / column.load, 1e-9) << spacing;  // it acts
  }
}

/// Soil that fills a closed box under one pressure of its water stays as it is.
TEST(PoreWaterSteps, UniformPressureBetweenWallsIsAtRest) {
  for (const int spacing : {1, 2}) {
    const double cell = 0.1, pressure = 1e5;
    SimulationSetup setup = make_setup(2, {}, cell, {4, 4, 1});
    for (int a = 0; a < 2; ++a) {
      setup.faces[std::size_t(a)] = {FaceType::symmetry, FaceType::symmetry};
    }
    const auto points = lattice(Vector::Zero(), Vector(0.4, 0.4, 0), cell / 3, 2);
    BodySetup& body = add_jelly(setup, points, cell / 3, {1e7, 0.3, 2000});
    body.pores.emplace();
    body.pores->porosity = 0.4;
    body.pores->mobility = 1e-9;
    body.pore_pressure.assign(points.size(), pressure);
    setup.coupling.emplace();
    setup.coupling->pressure_spacing = spacing;
    setup.coupling->tolerance = 1e-13;
    set_steps(setup, 50, 5e-4);
    const Schedule schedule = setup.schedule;
    const auto simulation = Simulation::create(std::move(setup));
    run(*simulation, schedule);
    for (const double p : pressures(*simulation)) {
      EXPECT_NEAR(p / pressure, 1, 1e-11) << spacing;  // tolerance times a condition of 1e2
    }
    EXPECT_LT(simulation->history().max_speed, 1e-11) << spacing;
  }
}

/// A pressure that is not solved is never used.
TEST(PoreWaterSteps, SolveThatDoesNotConvergeEndsTheRun) {
  SoilColumn column = short_column(1, 0.01);
  column.coupling.preconditioner = "jacobi";
  column.coupling.solver_options = "-scree_p_ksp_max_it 2";
  const auto simulation = Simulation::create(column_setup(column));
  try {
    for (int i = 0; i < 10; ++i) simulation->step();
    ADD_FAILURE() << "no fault";
  } catch (const RunFault& fault) {
    const std::string text = fault.what();
    for (const char* part : {"pore pressure at t = ", "the solver stopped after 2 iterations",
                             "relative residual of ", "coupling.preconditioner"}) {
      EXPECT_NE(text.find(part), std::string::npos) << text;
    }
  }
}

/// Stiff water on springs of its own: the shorter the step, the fewer iterations.
SoilColumn springy_column(const std::string& options, int halvings) {
  SoilColumn column = short_column(1, 0.01);
  column.pores.fluid_modulus = 50 * column.youngs_modulus;
  column.coupling.preconditioner = "jacobi";
  column.coupling.solver_options = options;
  column.coupling.halvings = halvings;
  return column;
}

/// A step that was halved is the step of a run with that step: nothing is left of what was tried.
TEST(PoreWaterSteps, StepThatDoesNotConvergeIsHalved) {
  const auto free = Simulation::create(column_setup(springy_column("", 0)));
  const double whole = free->dt();
  free->step();
  const int enough = free->history().fluid->iterations;
  const std::string options = "-scree_p_ksp_max_it " + std::to_string(enough - 1);
  const auto halved = Simulation::create(column_setup(springy_column(options, 10)));
  halved->step();
  const std::int64_t halvings = halved->history().fluid->halvings;
  EXPECT_GE(halvings, 1);
  EXPECT_LT(halved->history().fluid->iterations, enough);
  EXPECT_EQ(halved->time(), whole / double(1 << halvings));
  SimulationSetup setup = column_setup(springy_column(options, 0));
  setup.step = halved->time();
  const auto small = Simulation::create(std::move(setup));
  small->step();
  EXPECT_EQ(small->time(), halved->time());
  EXPECT_EQ(pressures(*halved), pressures(*small));
  const auto places = [](const Simulation& simulation) {
    return simulation.particles({"velocity", "displacement"});
  };
  for (const char* name : {"velocity", "displacement"}) {
    EXPECT_EQ(field(places(*halved), name).values, field(places(*small), name).values) << name;
  }
  halved->step();  // goes on with whole steps
  EXPECT_LE(halved->time(), whole / double(1 << halvings) + whole);
}

TEST(PoreWaterSteps, HalvingsHaveAnEnd) {
  const auto simulation =
      Simulation::create(column_setup(springy_column("-scree_p_ksp_max_it 1", 2)));
  try {
    simulation->step();
    ADD_FAILURE() << "no fault";
  } catch (const RunFault& fault) {
    const std::string text = fault.what();
    for (const char* part : {"the solver stopped after 1 iterations", "relative residual of ",
                             "the step was halved 2 times"}) {
      EXPECT_NE(text.find(part), std::string::npos) << text;
    }
  }
  EXPECT_EQ(simulation->history().fluid->halvings, 2);
}

/// The load on the upper faces of particles on their lattice.
TractionSetup strip_of(const std::vector<Vector>& points,
                       const verify::cases::strip_load::Ground& ground, double between,
                       double load) {
  TractionSetup strip;
  strip.spec.name = "strip";
  strip.spec.pressure.text = std::to_string(load);
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (points[p][1] < ground.height - between || points[p][0] > ground.strip) continue;
    strip.patch.particle.push_back(std::int64_t(p));
    strip.patch.area_vector.insert(strip.patch.area_vector.end(), {0, between, 0});
    strip.patch.area.push_back(between);
  }
  return strip;
}

/// Undrained ground under a strip of load, particles off their lattice by 0.3 of their distance.
double roughness_over_exact(int spacing) {
  const double cell = 0.25, young = 1e7, poisson = 0.2, density = 2000, load = 1e3;
  const verify::cases::strip_load::Ground ground{4, 3, 1};
  SimulationSetup setup = make_setup(2, {}, cell, {16, 16, 1});
  setup.faces[0] = {FaceType::symmetry, FaceType::symmetry};
  setup.faces[1][0] = FaceType::symmetry;
  const double between = cell / 3;
  auto points = lattice(Vector::Zero(), Vector(4, 3, 0), between, 2);
  setup.tractions.push_back(strip_of(points, ground, between, load));
  Random random(5);
  for (Vector& x : points) x += random.vector(0.3 * between, 2);
  BodySetup& body = add_jelly(setup, points, between, {young, poisson, density});
  body.pores.emplace();
  body.pores->porosity = 0.4;
  body.pores->fluid_modulus = 1e6 * young;
  setup.coupling.emplace();
  setup.coupling->pressure_spacing = spacing;
  const double crossing = ground.width / std::sqrt(young / (2 * (1 + poisson)) / density);
  setup.damping = DampingType::mass;
  setup.damping_value = 1.4 * 3.14159 / crossing;
  setup.schedule = Schedule(8 * crossing, 0, 0, 0);
  const Schedule schedule = setup.schedule;
  const auto simulation = Simulation::create(std::move(setup));
  run(*simulation, schedule);
  verify::cases::strip_load::Bins measured(spacing * cell, ground), exact(spacing * cell, ground);
  const std::vector<double> p = pressures(*simulation);
  for (std::size_t i = 0; i < p.size(); ++i) {
    measured.add(points[i][0], points[i][1], p[i] / load);
    exact.add(points[i][0], points[i][1], ground.pressure(points[i][0], points[i][1]));
  }
  return measured.roughness() / exact.roughness();
}

TEST(PoreWaterSteps, JitteredGroundHasNoCheckerboard) {
  for (const int spacing : {1, 2}) {
    const double ratio = roughness_over_exact(spacing);
    EXPECT_LT(ratio, 1.5) << spacing;  // a checkerboard of 1 % of the load doubles it
    EXPECT_GT(ratio, 0.67) << spacing;
  }
}

}  // namespace
}  // namespace scree::testing
