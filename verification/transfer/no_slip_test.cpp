// SPDX-License-Identifier: Apache-2.0
//
// Faces that hold the material at the face itself: a layer equals that with its image turned
// around, a uniform stress is borne whole, and friction does not see where a periodic face lies.
#include <gtest/gtest.h>

#include <cmath>

#include "verification/support/effort.hpp"
#include "verification/support/random.hpp"
#include "verification/support/scene.hpp"

namespace scree::testing {
namespace {

constexpr double dx = 0.1;
const Jelly jelly{1e5, 0.3, 1000};

PoreSetup soil_pores() {
  PoreSetup pores;
  pores.porosity = 0.4;
  pores.fluid_modulus = 1e6;
  pores.mobility = 1e-6;
  return pores;
}

/// With a solution that is exact for the tests.
CouplingSetup exact_coupling() {
  CouplingSetup coupling;
  coupling.pressure_spacing = 1;
  coupling.tolerance = 1e-13;
  return coupling;
}

/// Rows of jelly, periodic along them, each with its own velocity: alone above a held face at
/// y = 0, or together with the rows turned by pi about the origin. All nodes of a lattice at the
/// same height have the same velocity, so that the turned one is the odd one.
State rows_of_jelly(int dimension, const Method& method, bool twin, double step = 1e-3,
                    bool wet = false) {
  const int layers = 4, below = twin ? 2 * layers : 0;
  SimulationSetup setup = make_setup(dimension, method, dx, {4, 2 * layers + below, 4},
                                     Vector(-2 * dx, -below * dx, -2 * dx));
  for (const int axis : {0, 2}) setup.faces[axis] = {FaceType::periodic, FaceType::periodic};
  if (!twin) setup.faces[1][0] = FaceType::sticky;
  setup.no_slip = NoSlip::face;
  setup.flip_blend = 0.95;
  const double spacing = dx / 2;
  const Vector half(2 * dx, 0, dimension == 3 ? 2 * dx : 0);
  const auto points = lattice(-half, half + Vector(0, layers * dx, 0), spacing, dimension);
  const double lift = 0.2 * dx;  // else the pores of the lowest row would reach beyond the face
  const auto add = [&](double sign) {
    Random random(73);
    std::vector<Vector> speed;
    for (int row = 0; row < 2 * layers; ++row) speed.push_back(random.vector(1, dimension));
    BodySetup& body = add_jelly(setup, points, spacing, jelly);
    if (wet) body.pores = soil_pores();
    body.position.clear();
    for (Vector x : points) {
      Vector v = sign * speed[std::size_t(x[1] / spacing)];
      if (wet) v[1] = 0, x[1] += lift;
      body.position.insert(body.position.end(), {sign * x[0], sign * x[1], sign * x[2]});
      body.velocity.insert(body.velocity.end(), {v[0], v[1], v[2]});
    }
  };
  add(1);
  if (twin) add(-1);
  if (wet) setup.coupling = exact_coupling();
  set_steps(setup, dimension == 2 ? effort(60) : 10, step);
  const Schedule schedule = setup.schedule;
  const auto simulation = Simulation::create(std::move(setup));
  run(*simulation, schedule);
  State state = state_of(*simulation);
  state.x.resize(points.size()), state.v.resize(points.size());
  return state;
}

class NoSlipRuns : public ::testing::TestWithParam<Method> {};

TEST_P(NoSlipRuns, a_held_face_equals_the_layer_with_its_image_turned_around) {
  if (GetParam().kernel == KernelType::linear)
    return;  // its edge particles blow up sooner or later
  for (int dimension : {2, 3}) {
    if (slow_build && dimension == 3) continue;
    const State wall = rows_of_jelly(dimension, GetParam(), false);
    const State twin = rows_of_jelly(dimension, GetParam(), true);
    EXPECT_LT(distance(twin.x, wall.x), 1e-12) << dimension;  // rounding, over tens of steps
    EXPECT_LT(distance(twin.v, wall.v), 1e-10) << dimension;  // velocities of 1 m/s
  }
}

TEST(NoSlipCoupled, wet_soil_on_a_held_face_equals_the_layer_with_its_image) {
  for (const PathType path : {PathType::fused, PathType::split}) {
    Method method;
    method.path = path;
    const State wall = rows_of_jelly(2, method, false, 2e-4, true);
    const State twin = rows_of_jelly(2, method, true, 2e-4, true);
    // What the pressure solve leaves; a symmetry plane and its mirror twin differ by 1e-8 and 2e-6.
    EXPECT_LT(distance(twin.x, wall.x), 1e-7) << method;
    EXPECT_LT(distance(twin.v, wall.v), 1e-5) << method;
    const State dry = rows_of_jelly(2, method, false, 2e-4, false);
    EXPECT_GT(distance(dry.v, wall.v), 0.1) << "the water did nothing";
  }
}

/// Displacement of a block of wet soil that slides on a face with friction.
double wet_slide(NoSlip no_slip) {
  SimulationSetup setup = make_setup(2, {}, dx, {20, 10, 1});
  setup.faces[1][0] = FaceType::friction;
  setup.face_friction[1][0] = 0.2;
  setup.no_slip = no_slip;
  setup.gravity = [](double t) {
    const double g = std::min(t / 0.02, 1.0);
    return std::array<double, 3>{8 * g, -9 * g, 0};
  };
  const auto points = lattice(Vector(4 * dx, 0, 0), Vector(10 * dx, 4 * dx, 0), dx / 2, 2);
  add_jelly(setup, points, dx / 2, {1e6, 0.3, 2000}).pores = soil_pores();
  setup.coupling = exact_coupling();
  setup.coupling->pressure_spacing = 2;
  setup.schedule = Schedule(0.15, 0, 0, 0);
  const Schedule schedule = setup.schedule;
  const auto simulation = Simulation::create(std::move(setup));
  const double start = simulation->history().center[0];
  run(*simulation, schedule);
  return simulation->history().center[0] - start;
}

// Where a wall slips both rules take Coulomb's share of the effective stress; without friction the
// block would move 8 t^2/2.
TEST(NoSlipCoupled, wet_soil_slides_the_same_with_both_rules) {
  if (slow_build) GTEST_SKIP() << "a thousand steps";
  const double node = wet_slide(NoSlip::node), face = wet_slide(NoSlip::face);
  EXPECT_NEAR(face / node, 1, 1e-2);  // the block shears a little at its base
  EXPECT_LT(face, 0.95 * 8 * 0.15 * 0.15 / 2);
  EXPECT_GT(face, 0.5 * 8 * 0.15 * 0.15 / 2);
}

/// Largest speed in the cell beside a face that holds, after one step of a layer with a uniform
/// shear stress and pressure on it, over stress dt/(density dx).
double speed_beside(FaceType face, NoSlip no_slip, int dimension, const Method& method) {
  SimulationSetup setup = make_setup(dimension, method, dx, {4, 8, 4});
  for (const int axis : {0, 2}) setup.faces[axis] = {FaceType::periodic, FaceType::periodic};
  setup.faces[1][1] = face;
  setup.face_friction[1][1] = 0.9;
  setup.no_slip = no_slip;
  const double spacing = dx / 2, shear = 0.01, dt = 1e-4;
  const Vector upper(4 * dx, 8 * dx, dimension == 3 ? 4 * dx : 0);
  const auto points = lattice(Vector(0, 3 * dx, 0), upper, spacing, dimension);
  BodySetup& body = add_jelly(setup, points, spacing, jelly);
  body.states = {{1, shear, 0, 0, 1 - shear, 0, 0, 0, 1}};  // F; tau_xy = 0.28 of tau_yy
  body.state_of.assign(points.size(), 0);
  set_steps(setup, 1, dt);
  const Schedule schedule = setup.schedule;
  const auto simulation = Simulation::create(std::move(setup));
  run(*simulation, schedule);
  const State state = state_of(*simulation);
  double largest = 0;
  for (std::size_t p = 0; p < state.x.size(); ++p) {
    if (state.x[p][1] > 7 * dx) largest = std::max(largest, state.v[p].norm());
  }
  return largest * jelly.density * dx / (dt * shear * jelly.youngs_modulus / 2.6);
}

TEST_P(NoSlipRuns, a_face_that_holds_bears_a_uniform_stress) {
  for (int dimension : {2, 3}) {
    for (FaceType face : {FaceType::sticky, FaceType::friction}) {
      // Sums of some tens of terms, magnified by the inverse moment matrix (< 20).
      EXPECT_LT(speed_beside(face, NoSlip::face, dimension, GetParam()), 1e-10) << dimension;
    }
    // By the rule of nodes a sticky face bears three quarters.
    if (GetParam().kernel != KernelType::compact) continue;
    EXPECT_GT(speed_beside(FaceType::sticky, NoSlip::node, dimension, GetParam()), 0.05);
  }
}

/// A block thrown askew at a wall with friction at x = 0; along the wall the domain is periodic and
/// its seam lies `shift` cells lower than the block's middle.
State thrown_block(const Method& method, int shift) {
  SimulationSetup setup = make_setup(2, method, dx, {8, 10, 1}, Vector(0, -shift * dx, 0));
  setup.faces[0][0] = FaceType::friction;
  setup.face_friction[0][0] = 0.3;
  setup.faces[1] = {FaceType::periodic, FaceType::periodic};
  setup.no_slip = NoSlip::face;
  setup.flip_blend = 0.95;
  auto points = lattice(Vector(0.5 * dx, -2 * dx, 0), Vector(4.5 * dx, 2 * dx, 0), dx / 2, 2);
  Random random(74);
  for (Vector& x : points) {
    x += random.vector(0.1 * dx / 2, 2);
    if (x[1] < -shift * dx) x[1] += 10 * dx;
  }
  BodySetup& body = add_jelly(setup, points, dx / 2, jelly);
  for (std::size_t p = 0; p < points.size(); ++p) {
    const double v = random.uniform(-1, 1);  // some stick, some slide
    body.velocity.insert(body.velocity.end(), {-1, v, 0});
  }
  set_steps(setup, effort(60), 1e-3);
  const Schedule schedule = setup.schedule;
  const auto simulation = Simulation::create(std::move(setup));
  run(*simulation, schedule);
  State state = state_of(*simulation);
  for (Vector& x : state.x) x[1] -= 10 * dx * std::floor(x[1] / (10 * dx) + 0.5);
  return state;
}

TEST_P(NoSlipRuns, friction_does_not_see_the_seam_of_periodic_faces) {
  if (GetParam().kernel == KernelType::linear) return;
  const State away = thrown_block(GetParam(), 5), across = thrown_block(GetParam(), 0);
  EXPECT_LT(distance(away.x, across.x), 1e-12);
  double slowest = -1;
  for (const Vector& v : across.v) slowest = std::max(slowest, v[0]);
  // It came with -1; slow builds take a few steps only.
  EXPECT_GT(slowest, slow_build ? -0.95 : -0.5) << "the block never felt the wall";
}

INSTANTIATE_TEST_SUITE_P(methods, NoSlipRuns, ::testing::ValuesIn(all_methods()),
                         [](const auto& info) { return to_string(info.param); });

}  // namespace
}  // namespace scree::testing
