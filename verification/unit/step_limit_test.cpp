// SPDX-License-Identifier: Apache-2.0
// What bounds the step, and the end of runs whose steps would take forever.
#include "solver/simulation/step_limit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "app/build_simulation.hpp"
#include "solver/base/error.hpp"

namespace scree {
namespace {

/// Weightless sand in a corner; the lines are added at the end.
SimulationSetup sand(const std::string& lines, const std::vector<std::string>& set = {}) {
  const std::string text = R"~([domain]
dimension = 2
lower = [0.0, 0.0]
upper = [0.4, 0.2]
cell_size = 0.02
[time]
end = 0.05
[material.sand]
model = "drucker_prager"
density = 1600
youngs_modulus = "2 MPa"
poissons_ratio = 0.3
friction_angle = "31 deg"
[body.column]
material = "sand"
shape = { type = "box", lower = [0.04, 0.04], upper = [0.08, 0.08] }
)~" + lines;
  Problems problems;
  const Deck deck = read_deck_text(text, "deck.toml", set, problems);
  EXPECT_TRUE(problems.empty()) << problems.text();
  return build_setup(deck);
}

/// Steps to a fault, and returns its sentence; nothing after `most` steps.
std::string fault_of(Simulation& simulation, int most) {
  try {
    for (int i = 0; i < most; ++i) simulation.step();
  } catch (const RunFault& fault) {
    return fault.what();
  }
  return "";
}

/// Its speed 1/(0.03 - t) makes each step a share dx/5 = 0.004 s v of the time that is left, so the
/// step has fallen to 1e-6 of the first after some ln(1e6)/0.004 = 3500 steps.
TEST(StepLimit, AStepThatShrinksForeverIsAFaultOfTheCollider) {
  const auto simulation = Simulation::create(sand(R"~([collider.wall]
shape = { type = "box", lower = [0.3, 0.0], upper = [0.32, 0.1] }
velocity = ["1/(0.03-t)", 0]
contact = "slip"
)~"));
  const double first = simulation->dt();
  const std::string fault = fault_of(*simulation, 10000);
  EXPECT_NE(fault.find("the time step has fallen from"), std::string::npos) << fault;
  EXPECT_NE(fault.find("because of collider wall, which moves at"), std::string::npos) << fault;
  EXPECT_LT(simulation->time(), 0.03);
  const StepLimit limit = simulation->step_limit();
  EXPECT_EQ(limit.first, first);
  EXPECT_LT(limit.shrinkage(), 1e-6);
  // dt = dx / (5 v); v of the step before the one that was planned is at most 1 % smaller.
  EXPECT_NEAR(limit.now * 5 * limit.speed / 0.02, 1, 1e-12);
}

TEST(StepLimit, NamesTheParticlesOfTheWaves) {
  const auto simulation = Simulation::create(sand(""));
  simulation->step();
  const StepLimit limit = simulation->step_limit();
  EXPECT_EQ(limit.cause, StepLimit::Cause::waves);
  EXPECT_EQ(limit.name, "sand");
  EXPECT_EQ(limit.shrinkage(), 1);                          // at rest
  EXPECT_NEAR(limit.now * limit.speed, 0.4 * 0.02, 1e-15);  // dt = cfl dx / c
  for (const int a : {0, 1}) EXPECT_NEAR(limit.place[std::size_t(a)], 0.06, 0.02 + 2 * 0.02);
}

TEST(StepLimit, NamesTheFastParticles) {
  // Above a quarter of the wave speed, times 5 cfl, the motion sets the step; sand has c = 41 m/s.
  const auto simulation = Simulation::create(sand("velocity = [100.0, 0.0]\n"));
  simulation->step();
  const StepLimit limit = simulation->step_limit();
  EXPECT_EQ(limit.cause, StepLimit::Cause::motion);
  EXPECT_EQ(limit.name, "sand");
  EXPECT_NEAR(limit.speed, 100, 1e-9);
}

TEST(StepLimit, OfAFixedStepIsTheDecks) {
  const auto simulation = Simulation::create(sand("", {"time.step=1e-5"}));
  simulation->step();
  EXPECT_EQ(simulation->step_limit().cause, StepLimit::Cause::fixed);
  EXPECT_EQ(simulation->step_limit().shrinkage(), 1);
}

TEST(StepLimit, Sentences) {
  StepLimit limit;
  limit.first = 3e-4;
  limit.now = 1e-10;
  limit.speed = 2e7;
  limit.dimension = 2;
  limit.place = {0.1, 0.25, 0};
  EXPECT_EQ(step_fault_text(7, 0.5, limit),
            "step 7: the run would not end: at t = 0.5 s the time step has fallen from 0.0003 s to "
            "1e-10 s because of the particles, where waves and motion reach 2e+07 m/s; squeeze the "
            "material less, or more slowly");
  limit.name = "sand";
  limit.cause = StepLimit::Cause::motion;
  EXPECT_EQ(cause_text(limit),
            "particles of sand near (0.1, 0.25) m, which move at 2e+07 m/s; lower the loads that "
            "drive them");
  EXPECT_EQ(StepLimit{}.shrinkage(), 1);
}

/// 100 m/s for 1 ms are five cells.
TEST(FaultText, OfAFixedStepSaysLowerTimeStep) {
  const auto simulation = Simulation::create(sand("velocity = [100.0, 0.0]\n", {"time.step=1e-3"}));
  const std::string fault = fault_of(*simulation, 10);
  EXPECT_NE(fault.find("lower time.step"), std::string::npos) << fault;
  EXPECT_EQ(fault.find("time.cfl"), std::string::npos) << fault;
}

TEST(Expressions, ThatBecomeUndefinedAreNamedInsteadOfAParticle) {
  const SimulationSetup falling = sand("[method]\ngravity = [0.0, \"-sqrt(0.02-t)\"]\n");
  EXPECT_EQ(falling.gravity(0.01)[1], -std::sqrt(0.02 - 0.01));
  const auto simulation = Simulation::create(falling);
  const std::string gravity = fault_of(*simulation, 10000);
  EXPECT_EQ(gravity.rfind("method.gravity: \"-sqrt(0.02-t)\" is not finite at t = 0.02", 0), 0u)
      << gravity;
  EXPECT_NEAR(simulation->time(), 0.02, simulation->dt());

  const SimulationSetup pushed = sand("[method]\nbody_force = [\"log(0.01-t)\", \"x\"]\n");
  const double X[3] = {0.05, 0.06, 0}, x[3] = {0.07, 0.08, 0};
  EXPECT_EQ(pushed.body_force(X, x, 0.0)[1], 0.07);
  try {
    pushed.body_force(X, x, 0.02);
    ADD_FAILURE() << "no fault";
  } catch (const RunFault& fault) {
    EXPECT_STREQ(fault.what(),
                 "method.body_force: \"log(0.01-t)\" is not finite at t = 0.02 s for the particle "
                 "at (0.07, 0.08) m, at the start at (0.05, 0.06) m");
  }
}

}  // namespace
}  // namespace scree
