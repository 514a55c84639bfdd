// SPDX-License-Identifier: Apache-2.0
//
// Consolidation of a column that drains at its top (case V36b), against the modal series with
// inertia. Expected errors are those of an independent one-dimensional code.
#include <gtest/gtest.h>

#include <cmath>

#include "verification/support/consolidation.hpp"

namespace scree::testing {
namespace {

constexpr double epsilon = 0.01;  // cv/(c H)

SoilColumn soil(int cells, int spacing) {
  SoilColumn column;
  column.cells = cells;
  column.pores.porosity = 0.4;
  column.pores.fluid_modulus = 1e6 * column.youngs_modulus;  // as good as incompressible
  column.coupling.pressure_spacing = spacing;
  column.set_consolidation(epsilon * column.wave_speed() * column.height);
  return column;
}

struct Outcome {
  double error;    ///< root of the mean square of the particles' pressures, over the load
  double balance;  ///< of the water, over its initial mass
};

Outcome consolidate(const SoilColumn& column, double Tv) {
  const double unit = column.height * column.height / column.consolidation();
  SimulationSetup setup = column_setup(column);
  setup.schedule = Schedule(Tv * unit, 0, 0, 0);
  const Schedule schedule = setup.schedule;
  const auto simulation = Simulation::create(std::move(setup));
  run(*simulation, schedule);
  const auto snapshot = simulation->particles({"pore_pressure"});
  const auto& p = field(snapshot, "pore_pressure").values;
  double sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double z = 1 - snapshot.position[3 * i + 1] / column.height;
    const double off = p[i] / column.load - dynamic_terzaghi(z, Tv, epsilon);
    sum += off * off;
  }
  return {std::sqrt(sum / double(p.size())), simulation->history().fluid->error};
}

TEST(Terzaghi, spacing_of_one_cell) {
  const Outcome coarse = consolidate(soil(10, 1), 0.1);
  const Outcome fine = consolidate(soil(20, 1), 0.1);
  EXPECT_LT(fine.error, 1.5e-3);                    // 6.4e-4
  EXPECT_GT(coarse.error / fine.error, 2.2 / 1.2);  // 2.2, towards first order: the drain's layer
  // Strains of 1e-4: what J and tr(dt grad v) differ by is carried over.
  EXPECT_LT(std::abs(fine.balance), 1e-7);
}

TEST(Terzaghi, spacing_of_two_cells) {
  const double coarse = consolidate(soil(10, 2), 0.1).error;
  const double fine = consolidate(soil(20, 2), 0.1).error;
  EXPECT_LT(fine, 4e-3);  // 1.3e-3
  EXPECT_GT(coarse / fine, 3.5);
}

TEST(Terzaghi, later) {
  EXPECT_LT(consolidate(soil(20, 1), 0.5).error, 1.5e-3);
  EXPECT_LT(consolidate(soil(20, 2), 0.5).error, 4e-3);
}

TEST(Terzaghi, surface_that_cuts_a_cell) {
  for (const int extra : {1, 2}) {
    SoilColumn column = soil(20, 1);
    column.extra = extra;
    EXPECT_LT(consolidate(column, 0.1).error, 1.5e-3) << extra;
  }
}

}  // namespace
}  // namespace scree::testing
