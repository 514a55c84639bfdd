// SPDX-License-Identifier: Apache-2.0
//
// Runs that cannot go on end in one sentence that names step, particle and cause; nothing is
// clamped or dropped.
#include <gtest/gtest.h>

#include "materials/modified_cam_clay.hpp"
#include "solver/base/error.hpp"
#include "verification/support/scene.hpp"

namespace scree::testing {
namespace {

/// The sentence with which the run ends; "" if it does not.
std::string fault_of(SimulationSetup setup) {
  const Schedule schedule = setup.schedule;
  const auto simulation = Simulation::create(std::move(setup));
  try {
    run(*simulation, schedule);
  } catch (const RunFault& fault) {
    return fault.what();
  }
  return "";
}

SimulationSetup block(int dimension, const Method& method, const Vector& velocity,
                      const Matrix& gradient) {
  SimulationSetup setup = make_setup(dimension, method, 0.1, {16, 16, 16});
  const auto points = lattice(Vector(0.4, 0.4, 0.4), Vector(0.8, 0.8, 0.8), 0.05, dimension);
  set_velocity(add_jelly(setup, points, 0.05, {1e4, 0.3, 1000}, "pudding"), velocity, gradient,
               Vector(0.6, 0.6, 0.6));
  return setup;
}

class FaultsOfMethods : public ::testing::TestWithParam<Method> {};

TEST_P(FaultsOfMethods, motion_beyond_the_bound_names_the_particle) {
  for (int dimension : {2, 3}) {
    SimulationSetup setup = block(dimension, GetParam(), Vector(40, 0, 0), Matrix::Zero());
    set_steps(setup, 3, 2e-3);  // 0.8 cells a step
    const std::string sentence = fault_of(std::move(setup));
    EXPECT_NE(sentence.find("step 1"), std::string::npos) << sentence;
    EXPECT_NE(sentence.find("particle"), std::string::npos) << sentence;
    EXPECT_NE(sentence.find("pudding"), std::string::npos) << sentence;
    EXPECT_NE(sentence.find("0.8"), std::string::npos) << sentence;
  }
}

TEST_P(FaultsOfMethods, inverted_particle_is_reported) {
  if (GetParam().kernel == KernelType::linear) return;  // it takes more than one step here
  for (int dimension : {2, 3}) {
    Matrix collapse = Matrix::Zero();
    collapse(0, 0) = -600;  // det F = 1 - 600 dt < 0 in the first step, motion below the bound
    SimulationSetup setup = block(dimension, GetParam(), Vector::Zero(), collapse);
    setup.bodies.clear();
    add_jelly(setup, {Vector(0.601, 0.602, dimension == 3 ? 0.603 : 0)}, 0.05, {1e4, 0.3, 1000},
              "pudding");
    set_velocity(setup.bodies[0], Vector::Zero(), collapse, Vector(0.601, 0.602, 0.603));
    set_steps(setup, 3, 2e-3);
    const std::string sentence = fault_of(std::move(setup));
    if (GetParam().affine()) {
      EXPECT_NE(sentence.find("particle 0"), std::string::npos) << sentence;
      EXPECT_NE(sentence.find("pudding"), std::string::npos) << sentence;
    }
  }
}

/// Clay whose voids close: J is harmless, and the sentence says what is missing.
TEST(Fault, clay_without_voids_is_named) {
  const double spacing = 0.1 / 3;
  SimulationSetup setup = make_setup(2, {}, 0.1, {10, 10, 1});
  const auto points = lattice(Vector(0.3, 0.3, 0), Vector(0.7, 0.7, 0), spacing, 2);
  BodySetup& body = add_jelly(setup, points, spacing, {1, 0, 1800}, "clay");
  body.model = "modified_cam_clay";
  // v = 1.95 - 0.2 ln 100 = 1.029 at the start
  body.input = ModifiedCamClay::Input{1, 0.2, 0.04, 0.3, 0.95, 1e5, {}, 1.0};
  set_velocity(body, Vector::Zero(), -40 * Matrix::Identity(), Vector(0.5, 0.5, 0));
  setup.schedule = Schedule(0.5, 0, 0, 0);
  const std::string sentence = fault_of(std::move(setup));
  EXPECT_NE(sentence.find(" m has no voids left (volume ratio J = 0.9"), std::string::npos)
      << sentence;
  EXPECT_NE(sentence.find("; lower the loads, raise reference_void_ratio, or lower time.cfl"),
            std::string::npos)
      << sentence;
}

TEST(Fault, a_closed_wall_lets_nothing_through) {
  SimulationSetup setup = block(2, {}, Vector(-5, 0, 0), Matrix::Zero());
  setup.faces[0][0] = FaceType::separate;
  setup.schedule = Schedule(0.3, 0, 0, 0);
  const Schedule schedule = setup.schedule;
  const auto simulation = Simulation::create(std::move(setup));
  run(*simulation, schedule);
  EXPECT_EQ(simulation->removed_count(), 0);
  for (const Vector& x : state_of(*simulation).x) EXPECT_GT(x[0], 0);
}

TEST(Fault, open_faces_remove_and_count) {
  SimulationSetup setup = block(2, {}, Vector(-5, 0, 0), Matrix::Zero());
  setup.schedule = Schedule(0.3, 0, 0, 0);
  const Schedule schedule = setup.schedule;
  const auto simulation = Simulation::create(std::move(setup));
  const std::int64_t count = simulation->particle_count();
  run(*simulation, schedule);
  EXPECT_EQ(simulation->removed_count(), count);
  EXPECT_EQ(simulation->particle_count(), 0);
}

TEST(Fault, a_particle_outside_the_domain_is_the_users_mistake) {
  SimulationSetup setup = make_setup(2, {}, 0.1, {4, 4, 1});
  add_jelly(setup, {Vector(0.9, 0.2, 0)}, 0.05, {});
  setup.schedule = Schedule(1, 0, 0, 0);
  EXPECT_THROW(Simulation::create(std::move(setup)), UserError);
}

INSTANTIATE_TEST_SUITE_P(methods, FaultsOfMethods, ::testing::ValuesIn(all_methods()),
                         [](const auto& info) { return to_string(info.param); });

}  // namespace
}  // namespace scree::testing
