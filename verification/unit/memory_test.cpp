// SPDX-License-Identifier: Apache-2.0
// What a simulation keeps in memory and moves in a step, by the program's own count: no timings.
#include <gtest/gtest.h>

#include "app/bench_case.hpp"
#include "solver/simulation/simulation.hpp"

namespace scree {
namespace {

std::unique_ptr<Simulation> stepped(SimulationSetup setup) {
  auto simulation = Simulation::create(std::move(setup));
  for (int i = 0; i < 3; ++i) simulation->step();
  return simulation;
}

TEST(Memory, EmptySpaceCostsNothing) {
  BenchOptions options;
  options.particles = 4096;
  const auto small = stepped(build_bench_case(options));
  SimulationSetup wide = build_bench_case(options);
  for (auto& cells : wide.cells) cells *= 100;  // a million times the space
  const auto large = stepped(std::move(wide));
  EXPECT_EQ(large->block_count(), small->block_count());
  EXPECT_EQ(large->memory().total(), small->memory().total());
  EXPECT_EQ(large->traffic().total(), small->traffic().total());
}

TEST(Memory, BodiesFarApartCostWhatTheyCostAlone) {
  BenchOptions options;
  options.particles = 4096;
  const auto alone = stepped(build_bench_case(options));
  SimulationSetup pair = build_bench_case(options);
  const double distance = 4096 * pair.cell_size;  // whole blocks, so that both lie alike in them
  BodySetup second = pair.bodies[0];
  for (std::size_t p = 0; p < second.position.size(); p += 3) second.position[p] += distance;
  pair.cells[0] += 4096;
  pair.bodies.push_back(std::move(second));
  const auto both = stepped(std::move(pair));
  EXPECT_EQ(both->block_count(), 2 * alone->block_count());
  EXPECT_EQ(both->memory().grid, 2 * alone->memory().grid);
  EXPECT_EQ(both->traffic().total(), 2 * alone->traffic().total());
}

/// The bounds of the performance page.
TEST(Memory, BytesOfAParticle) {
  for (const auto& [precision, bound] : {std::pair{"single", 120.0}, std::pair{"double", 220.0}}) {
    BenchOptions options;
    options.particles = 100'000;
    options.precision = precision;
    const auto simulation = stepped(build_bench_case(options));
    const double bytes =
        double(simulation->memory().total()) / double(simulation->particle_count());
    EXPECT_LE(bytes, bound) << precision;
    // Position, F and number cannot do with less.
    EXPECT_GE(bytes, options.precision == "single" ? 12 * 4 + 8 : 12 * 8 + 8) << precision;
  }
}

}  // namespace
}  // namespace scree
