// SPDX-License-Identifier: Apache-2.0
//
// Coupled pore water: the fused path equals the split one to rounding, and says where it cannot be.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "solver/base/error.hpp"
#include "verification/support/consolidation.hpp"
#include "verification/support/effort.hpp"

namespace scree::testing {
namespace {

enum class Soil { elastic, sand };
/// What the soil stands between along the first axis.
enum class Sides { walls, periodic };

struct Case {
  int dimension;
  KernelType kernel;
  Soil soil;
  Sides sides;
  Precision precision = Precision::double_;
  double epsilon() const { return precision == Precision::double_ ? 0x1p-52 : 0x1p-23; }
};
std::string to_string(const Case& c) {
  return "d" + std::to_string(c.dimension) +
         (c.kernel == KernelType::compact ? "_compact" : "_quadratic") +
         (c.soil == Soil::sand ? "_sand" : "_elastic") +
         (c.sides == Sides::periodic ? "_periodic" : "_walls") +
         (c.precision == Precision::single_ ? "_single" : "");
}
void PrintTo(const Case& c, std::ostream* out) { *out << to_string(c); }

constexpr double dx = 0.1, between = dx / 2;

BodySetup& add_soil(SimulationSetup& setup, const std::vector<Vector>& points, Soil soil) {
  if (soil == Soil::elastic) return add_jelly(setup, points, between, {2e6, 0.3, 2000});
  DruckerPrager::Input sand;
  sand.youngs_modulus = 2e6;
  sand.poissons_ratio = 0.3;
  sand.friction_angle = 0.5;
  return add_sand(setup, points, between, sand, 2000);
}

/// Soil that begins to settle on a slippery base under a weight that grows, drains at its top, and
/// slumps, or drifts through periodic faces by a cell and a half: particles and blocks change
/// sides. shift: of its place [cells].
SimulationSetup scene(const Case& c, PathType path, double shift = 0) {
  Method method;
  method.kernel = c.kernel;
  method.path = path;
  method.precision = c.precision;
  SimulationSetup setup = make_setup(c.dimension, method, dx, {12, 8, 4});
  setup.gravity = [](double t) { return std::array<double, 3>{1.0, -8 - 40 * t, 0}; };
  setup.faces[1][0] = FaceType::symmetry;
  setup.faces[2] = {FaceType::symmetry, FaceType::symmetry};
  const FaceType side = c.sides == Sides::periodic ? FaceType::periodic : FaceType::symmetry;
  setup.faces[0] = {side, side};
  const double start = c.sides == Sides::periodic ? 0.65 : 0.0, height = 0.4;
  const double left = start + shift * dx;
  const auto points =
      lattice(Vector(left, 0, 0), Vector(left + 0.5, height, 0.4), between, c.dimension);
  BodySetup& body = add_soil(setup, points, c.soil);
  body.pores.emplace();
  body.pores->porosity = 0.4;
  body.pores->mobility = 1e-6;
  body.pores->kozeny_carman = true;
  if (c.sides == Sides::periodic) set_velocity(body, Vector(3, 0, 0));
  setup.coupling.emplace();
  setup.coupling->tolerance = 450 * c.epsilon();
  setup.coupling->stride = 1;  // the split path has no longer ones
  setup.coupling->drainage.push_back(drained_top(points, height, between, c.dimension));
  setup.schedule = Schedule(0.05, 0, 0, 0);
  return setup;
}

struct Outcome {
  std::vector<double> position, velocity, pressure, seepage;
  FluidBalance water;
  std::int64_t steps = 0;
};

Outcome outcome(const Case& c, PathType path, double shift = 0) {
  SimulationSetup setup = scene(c, path, shift);
  const Schedule schedule = setup.schedule;
  const auto simulation = Simulation::create(std::move(setup));
  EXPECT_EQ(simulation->fused(), path == PathType::fused);
  run(*simulation, schedule);
  const auto snapshot = simulation->particles({"velocity", "pore_pressure", "seepage_velocity"});
  return {snapshot.position,
          field(snapshot, "velocity").values,
          field(snapshot, "pore_pressure").values,
          field(snapshot, "seepage_velocity").values,
          *simulation->history().fluid,
          simulation->step_count()};
}

double largest(const std::vector<double>& values) {
  double most = 0;
  for (const double v : values) most = std::max(most, std::abs(v));
  return most;
}

double apart(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return INFINITY;
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!(std::abs(a[i] - b[i]) <= most)) most = std::abs(a[i] - b[i]);
  }
  return most;
}

class CoupledPaths : public ::testing::TestWithParam<Case> {};

/// 50 steps of rounding in speeds near 3 m/s, in pressures whose solves stop at 450 epsilons of
/// their right-hand side, times a condition of 1e2, and in seepage, their difference over a cell.
/// Measured: a tenth of this and less.
void expect_same(const Outcome& a, const Outcome& b, double eps) {
  EXPECT_EQ(a.steps, b.steps);
  EXPECT_LT(apart(a.velocity, b.velocity), 5e3 * eps);
  EXPECT_LT(apart(a.pressure, b.pressure), 5e4 * eps * largest(b.pressure));
  EXPECT_LT(apart(a.seepage, b.seepage), 2e5 * eps * largest(b.seepage));
}

TEST_P(CoupledPaths, fused_equals_split_to_rounding) {
  const Case& c = GetParam();
  if (slow_build && c.dimension == 3) return;
  const Outcome fused = outcome(c, PathType::fused), split = outcome(c, PathType::split);
  const double eps = c.epsilon();
  EXPECT_GE(fused.steps, 40);
  EXPECT_GT(std::abs(fused.water.outflow), 1e-3);  // kg: so weights have changed
  expect_same(fused, split, eps);
  EXPECT_LT(apart(fused.position, split.position), 50 * eps);
}

/// Where a periodic face lies makes no difference.
TEST_P(CoupledPaths, bodies_pass_periodic_faces_as_they_move_elsewhere) {
  const Case& c = GetParam();
  if (c.sides != Sides::periodic || (slow_build && c.dimension == 3)) return;
  for (const PathType path : {PathType::fused, PathType::split}) {
    expect_same(outcome(c, path), outcome(c, path, -4), c.epsilon());
  }
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const int dimension : {2, 3}) {
    for (const KernelType kernel : {KernelType::compact, KernelType::quadratic}) {
      for (const Soil soil : {Soil::elastic, Soil::sand}) {
        for (const Sides sides : {Sides::walls, Sides::periodic}) {
          all.push_back({dimension, kernel, soil, sides});
        }
      }
    }
    all.push_back(
        {dimension, KernelType::compact, Soil::elastic, Sides::periodic, Precision::single_});
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(all, CoupledPaths, ::testing::ValuesIn(cases()),
                         [](const auto& info) { return to_string(info.param); });

SimulationSetup small_scene(PathType path) {
  return scene({2, KernelType::compact, Soil::elastic, Sides::walls}, path);
}

std::string refusal(SimulationSetup setup) {
  try {
    Simulation::create(std::move(setup));
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

TEST(CoupledPath, is_fused_unless_steps_may_be_halved) {
  EXPECT_TRUE(Simulation::create(small_scene(PathType::automatic))->fused());
  SimulationSetup halving = small_scene(PathType::automatic);
  halving.coupling->halvings = 1;
  EXPECT_FALSE(Simulation::create(halving)->fused());
  halving.path = PathType::fused;
  EXPECT_NE(refusal(halving).find("coupling.halvings = 0"), std::string::npos) << refusal(halving);
}

TEST(CoupledPath, is_split_where_the_path_without_water_is) {
  SimulationSetup pushed = small_scene(PathType::automatic);
  pushed.body_force = [](const double*, const double*, double) { return std::array<double, 3>{}; };
  EXPECT_FALSE(Simulation::create(pushed)->fused());
  pushed.path = PathType::fused;
  EXPECT_NE(refusal(pushed).find("body forces"), std::string::npos);
  SimulationSetup averaged = small_scene(PathType::automatic);
  averaged.volumetric_locking = VolumetricLocking::fbar;
  EXPECT_FALSE(Simulation::create(averaged)->fused());
  SimulationSetup apic = small_scene(PathType::automatic);
  apic.transfer = TransferType::apic;
  EXPECT_FALSE(Simulation::create(apic)->fused());
  apic.path = PathType::fused;
  EXPECT_NE(refusal(apic).find("transfer mls"), std::string::npos);
}

/// Runs that record nothing keep dt grad v and the external force alone.
TEST(CoupledPath, needs_less_memory_without_records) {
  SimulationSetup setup = small_scene(PathType::automatic);
  const auto recorded = Simulation::create(setup);
  setup.record = false;
  const auto bare = Simulation::create(setup);
  const double particles = double(bare->particle_count());
  const double saved = double(recorded->memory().particles - bare->memory().particles) / particles;
  EXPECT_GE(saved, 8 * (2 + 4 + 6));  // velocity, affine matrix, stress
  for (int n = 0; n < 5; ++n) {
    recorded->step();
    bare->step();
  }
  EXPECT_EQ(recorded->dt(), bare->dt());
}

}  // namespace
}  // namespace scree::testing
