// SPDX-License-Identifier: Apache-2.0
//
// One coupled step of random particles against the reference: sums over particles and conjugate
// gradients, neither matrix nor PETSc.
#include <gtest/gtest.h>

#include "verification/reference/pressure.hpp"
#include "verification/support/random.hpp"
#include "verification/support/scene.hpp"

namespace scree::testing {
namespace {

constexpr double cell = 0.1, step = 1e-3;

struct Scene {
  SimulationSetup setup;
  std::vector<reference::PorePoint> points;
};

PoreSetup soil_pores() {
  PoreSetup pores;
  pores.porosity = 0.4;
  pores.fluid_modulus = 1e7;
  pores.grain_compliance = 1e-9;
  pores.biot = 0.9;
  pores.mobility = 1e-7;
  pores.fluid_density = 1100;
  return pores;
}

/// Jittered particles in a free block, each with a velocity and a pressure of its own.
Scene random_scene(int dimension, const Method& method, int spacing) {
  Scene scene;
  SimulationSetup& setup = scene.setup;
  setup = make_setup(dimension, method, cell, {8, 8, 8});
  setup.gravity = [](double) { return std::array<double, 3>{1.5, -9.81, 0}; };
  const double between = cell / 2;
  auto places = lattice(Vector(0.2, 0.2, 0.2), Vector(0.5, 0.4, 0.4), between, dimension);
  Random random(7);
  for (Vector& x : places) {
    for (int a = 0; a < dimension; ++a) x[a] += 0.3 * between * random.uniform(-1, 1);
  }
  BodySetup& body = add_jelly(setup, places, between, {1e6, 0.2, 2000});
  body.pores = soil_pores();
  setup.coupling.emplace();
  setup.coupling->pressure_spacing = spacing;
  setup.coupling->tolerance = 1e-12;
  body.velocity.assign(3 * places.size(), 0.0);
  body.pore_pressure.assign(places.size(), 0.0);
  for (std::size_t p = 0; p < places.size(); ++p) {
    reference::PorePoint point;
    point.position = places[p];
    for (int a = 0; a < dimension; ++a) {
      body.velocity[3 * p + std::size_t(a)] = point.velocity[a] = random.uniform(-0.1, 0.1);
    }
    body.pore_pressure[p] = point.pressure = 1e3 * random.uniform(-1, 1);
    point.volume = body.particle_volume;
    point.mass = 2000 * body.particle_volume;
    point.storage = 0.4 / 1e7 + (0.9 - 0.4) * 1e-9;
    point.mobility = 1e-7;
    point.biot = 0.9;
    point.fluid_density = 1100;
    scene.points.push_back(point);
  }
  set_steps(setup, 1, step);
  return scene;
}

reference::PressureStep reference_step(const Scene& scene, int spacing) {
  const SimulationSetup& setup = scene.setup;
  const double offset = setup.kernel == KernelType::quadratic ? 0.5 : spacing == 1 ? 0.25 : 0.0;
  return {static_cast<reference::Kernel>(setup.kernel),
          setup.transfer == TransferType::mls,
          setup.dimension,
          cell,
          spacing,
          offset,
          scene.points};
}

struct Case {
  int dimension, spacing;
  Method method;
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.dimension << "d_spacing_" << c.spacing << "_" << c.method;
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const int dimension : {2, 3}) {
    for (const Method& method : all_methods()) {
      all.push_back({dimension, 2, method});
      if (method.kernel == KernelType::compact && method.affine())
        all.push_back({dimension, 1, method});
    }
  }
  return all;
}

class PressureStep : public ::testing::TestWithParam<Case> {};

TEST_P(PressureStep, equals_the_reference) {
  const Case& c = GetParam();
  const Scene scene = random_scene(c.dimension, c.method, c.spacing);
  auto exact = reference_step(scene, c.spacing);
  const Vector gravity(1.5, -9.81, 0);
  const std::vector<double> expected = exact.solve(step, gravity, 1e-13);
  const auto simulation = Simulation::create(scene.setup);
  simulation->step();
  const auto snapshot = simulation->particles({"pore_pressure"});
  const auto& pressure = field(snapshot, "pore_pressure").values;
  double largest = 0;
  for (const double p : expected) largest = std::max(largest, std::abs(p));
  ASSERT_GT(largest, 10);
  for (std::size_t p = 0; p < expected.size(); ++p) {
    // Residuals of 1e-12 times the condition number, about 1e3.
    EXPECT_NEAR(pressure[p], expected[p], 1e-8 * largest) << p;
  }
}

std::string case_name(const ::testing::TestParamInfo<Case>& info) {
  std::ostringstream name;
  name << info.param;
  return name.str();
}

INSTANTIATE_TEST_SUITE_P(all, PressureStep, ::testing::ValuesIn(cases()), case_name);

}  // namespace
}  // namespace scree::testing
