// SPDX-License-Identifier: Apache-2.0
//
// Bodies that start with stress and carry pore water, and ground of clay: a run continued from a
// checkpoint equals the uninterrupted one bit for bit. Split and fused steps agree; a body without
// water beside one with.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "materials/initial_state.hpp"
#include "materials/modified_cam_clay.hpp"
#include "materials/registry.hpp"
#include "solver/io/memory_archive.hpp"
#include "verification/support/scene.hpp"

namespace scree::testing {
namespace {

DruckerPrager::Input sand_input() {
  DruckerPrager::Input in;
  in.youngs_modulus = 5e6;
  in.poissons_ratio = 0.3;
  in.friction_angle = 0.55;
  return in;
}

void start_with(BodySetup& body, const std::array<double, 3>& stress, int dimension) {
  const auto point = make_material_point(body.model, body.input, body.density, dimension);
  body.states = {*initial_state(*point, find_material_model(body.model)->fields, stress)};
  body.state_of.assign(body.position.size() / 3, 0);
}

/// Stressed, saturated sand that slumps beside a dry elastic block.
SimulationSetup scene(int dimension, const Method& method) {
  const double dx = 0.1, spacing = dx / 3;
  SimulationSetup setup = make_setup(dimension, method, dx, {14, 10, 6});
  setup.gravity = [](double) { return std::array<double, 3>{0, -9.81, 0}; };
  setup.faces[1][0] = FaceType::sticky;
  BodySetup& sand =
      add_sand(setup, lattice(Vector(0.2, 0, 0.1), Vector(0.5, 0.3, 0.3), spacing, dimension),
               spacing, sand_input(), 1800);
  sand.undrained_bulk_modulus = 2e7;
  start_with(sand, {-3e3, -5e3, -3e3}, dimension);
  add_jelly(setup, lattice(Vector(0.8, 0, 0.1), Vector(1.0, 0.2, 0.3), spacing, dimension), spacing,
            {1e6, 0.2, 1500});
  setup.schedule = Schedule(0.02, 2e-3, 0, 0);
  return setup;
}

/// Normally consolidated clay, each particle under its weight, that is cut free on its sides.
SimulationSetup clay_scene() {
  const double dx = 0.1, spacing = dx / 3, density = 1800;
  SimulationSetup setup = make_setup(2, {}, dx, {14, 10, 6});
  setup.gravity = [](double) { return std::array<double, 3>{0, -9.81, 0}; };
  setup.faces[1][0] = FaceType::sticky;
  BodySetup& clay = add_jelly(setup, lattice(Vector(0.2, 0, 0), Vector(0.8, 0.5, 0), spacing, 2),
                              spacing, {1, 0, density}, "clay");
  clay.model = "modified_cam_clay";
  clay.input = ModifiedCamClay::Input{1, 0.2, 0.04, 0.3, 2, 1e5, {}, 1.0};
  const MaterialEntry& law = *find_material_model(clay.model);
  const double k0 = law.rest_ratio(clay.input);
  for (std::size_t p = 1; p < clay.position.size(); p += 3) {
    const double vertical = -density * 9.81 * (0.5 - clay.position[p]);
    clay.state_of.push_back(std::int32_t(clay.states.size()));
    clay.states.push_back(*law.state_under(clay.input, {k0 * vertical, vertical, k0 * vertical}));
  }
  setup.schedule = Schedule(0.05, 5e-3, 0, 0);
  return setup;
}

/// A run in one go, and one that was continued from its state after seven steps.
struct TwoRuns {
  std::unique_ptr<Simulation> whole, resumed;
  MemoryArchive middle, end, resumed_end;
};

TwoRuns run_twice(const SimulationSetup& setup) {
  TwoRuns runs{Simulation::create(setup), Simulation::create(setup), {}, {}, {}};
  for (int n = 0; n < 7; ++n) runs.whole->step();
  runs.whole->save(runs.middle);
  runs.resumed->load(runs.middle);
  run(*runs.whole, setup.schedule);
  run(*runs.resumed, setup.schedule);
  runs.whole->save(runs.end);
  runs.resumed->save(runs.resumed_end);
  return runs;
}

class UndrainedRestart : public ::testing::TestWithParam<Method> {};

TEST_P(UndrainedRestart, continues_bit_for_bit) {
  for (const int dimension : {2, 3}) {
    const TwoRuns runs = run_twice(scene(dimension, GetParam()));
    EXPECT_TRUE(runs.end == runs.resumed_end) << dimension;
    EXPECT_EQ(runs.whole->particles({"effective_stress"}).fields[0].values[0],
              runs.resumed->particles({"effective_stress"}).fields[0].values[0]);
  }
}

INSTANTIATE_TEST_SUITE_P(
    methods, UndrainedRestart,
    ::testing::Values(
        Method{KernelType::compact, TransferType::mls, PathType::fused, Precision::double_},
        Method{KernelType::compact, TransferType::mls, PathType::fused, Precision::single_},
        Method{KernelType::compact, TransferType::mls, PathType::split, Precision::single_},
        Method{KernelType::quadratic, TransferType::apic, PathType::split, Precision::double_}),
    [](const auto& info) { return to_string(info.param); });

TEST(GroundRestart, clay_with_a_state_of_its_own_in_every_particle) {
  const TwoRuns runs = run_twice(clay_scene());
  EXPECT_TRUE(runs.end == runs.resumed_end);
  EXPECT_FALSE(runs.end == runs.middle);
}

struct Fields {
  std::vector<double> pressure, stress, effective;
};

Fields fields_after_run(const SimulationSetup& setup) {
  const auto simulation = Simulation::create(setup);
  run(*simulation, setup.schedule);
  const auto snapshot = simulation->particles({"pore_pressure", "stress", "effective_stress"});
  return {field(snapshot, "pore_pressure").values, field(snapshot, "stress").values,
          field(snapshot, "effective_stress").values};
}

TEST(Undrained, split_and_fused_steps_agree) {
  Method method;
  method.path = PathType::fused;
  const Fields fused = fields_after_run(scene(2, method));
  method.path = PathType::split;
  const Fields split = fields_after_run(scene(2, method));
  double most = 0, apart = 0;
  for (std::size_t p = 0; p < fused.pressure.size(); ++p) {
    if (std::isnan(fused.pressure[p])) continue;
    most = std::max(most, std::abs(fused.pressure[p]));
    apart = std::max(apart, std::abs(fused.pressure[p] - split.pressure[p]));
  }
  EXPECT_GT(most, 1e3);
  EXPECT_LT(apart, 1e-6 * most);  // 60 steps of rounding, grown by yielding sand
}

TEST(Undrained, a_body_without_water_has_no_such_fields) {
  const SimulationSetup setup = scene(2, {});
  const std::size_t wet = setup.bodies[0].position.size() / 3;
  const Fields fields = fields_after_run(setup);
  for (std::size_t p = 0; p < fields.pressure.size(); ++p) {
    EXPECT_EQ(std::isnan(fields.pressure[p]), p >= wet);
    for (std::size_t i = 0; i < 9; ++i) {
      EXPECT_EQ(std::isnan(fields.effective[9 * p + i]), p >= wet);
      EXPECT_FALSE(std::isnan(fields.stress[9 * p + i]));
    }
  }
}

TEST(Undrained, starts_from_the_given_stress_in_both_precisions) {
  for (const Precision precision : {Precision::double_, Precision::single_}) {
    Method method;
    method.precision = precision;
    SimulationSetup setup = scene(3, method);
    const auto snapshot = Simulation::create(setup)->particles({"stress", "pore_pressure"});
    // Single precision: the stretch is rounded by 6e-8, times the stiffness.
    const double tolerance = precision == Precision::double_ ? 1e-6 : 6e-8 * 2 * 5e6;
    EXPECT_NEAR(field(snapshot, "stress").values[0], -3e3, tolerance);
    EXPECT_NEAR(field(snapshot, "stress").values[4], -5e3, tolerance);
    EXPECT_EQ(field(snapshot, "pore_pressure").values[0], 0);
  }
}

TEST(Undrained, fluids_cannot_carry_pore_water) {
  SimulationSetup setup = make_setup(2, {}, 0.1, {4, 4, 4});
  add_fluid(setup, {Vector(0.2, 0.2, 0)}, 0.05, {1e5, 7, 0, 1}, 1000).undrained_bulk_modulus = 1e6;
  EXPECT_THROW(Simulation::create(setup), std::runtime_error);
}

}  // namespace
}  // namespace scree::testing
