// SPDX-License-Identifier: Apache-2.0
//
// Coupled pore water: bitwise the same from a checkpoint, and for any number of threads.
#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <ostream>
#include <string>
#include <thread>
#include <vector>

#include "solver/io/memory_archive.hpp"
#include "verification/support/consolidation.hpp"
#include "verification/support/final_state.hpp"

namespace scree::testing {
namespace {

/// A slump that drains, presses on a collider and leaves through an open face.
SimulationSetup scene(int dimension, int spacing, bool periodic, VolumetricLocking locking) {
  const double dx = 0.1, between = dx / 2;
  SimulationSetup setup = make_setup(dimension, {}, dx, {12, 8, 4});
  setup.gravity = [](double) { return std::array<double, 3>{0, -9.81, 0}; };
  setup.faces[1][0] = FaceType::friction;
  setup.face_friction[1][0] = 0.3;
  const FaceType side = periodic ? FaceType::periodic : FaceType::symmetry;
  if (dimension == 3) setup.faces[2] = {side, side};
  const auto points = lattice(Vector(0.2, 0, 0), Vector(0.6, 0.4, 0.4), between, dimension);
  DruckerPrager::Input sand;
  sand.youngs_modulus = 2e6;
  sand.poissons_ratio = 0.3;
  sand.friction_angle = 0.5;
  BodySetup& body = add_sand(setup, points, between, sand, 2000);
  body.pores.emplace();
  body.pores->porosity = 0.4;
  body.pores->mobility = 1e-7;
  body.pores->kozeny_carman = true;
  ColliderSpec post;
  post.name = "post";
  post.shape.kind = ShapeKind::box;
  post.shape.lower = {0.6, 0, -1};
  post.shape.upper = {0.8, 0.1, 1};
  post.contact.type = ContactType::friction;
  post.contact.coefficient = 0.4;
  setup.colliders.push_back(post);
  setup.volumetric_locking = locking;
  setup.coupling.emplace();
  setup.coupling->pressure_spacing = spacing;
  setup.coupling->drainage.push_back(drained_top(points, 0.4, between, dimension));
  setup.schedule = Schedule(0.05, 5e-3, 0, 0);
  return setup;
}

struct Case {
  int dimension, spacing;
  bool periodic;
  PathType path = PathType::fused;
  VolumetricLocking locking = VolumetricLocking::none;
  KernelType kernel = KernelType::compact;
  SimulationSetup setup() const {
    SimulationSetup setup = scene(dimension, spacing, periodic, locking);
    setup.path = path;
    setup.kernel = kernel;
    return setup;
  }
  bool averages() const { return locking == VolumetricLocking::fbar; }
};
std::string name_of(const Case& c) {
  return "d" + std::to_string(c.dimension) + "_spacing" + std::to_string(c.spacing) +
         (c.kernel == KernelType::quadratic ? "_quadratic" : "") + (c.periodic ? "_periodic" : "") +
         (c.path == PathType::fused ? "_fused" : "_split") + (c.averages() ? "_fbar" : "");
}
/// For the tests' names, which are else its bytes.
void PrintTo(const Case& c, std::ostream* out) { *out << name_of(c); }
class CoupledRestart : public ::testing::TestWithParam<Case> {};

TEST_P(CoupledRestart, continues_bitwise) {
  const SimulationSetup setup = GetParam().setup();
  const auto whole = Simulation::create(setup), resumed = Simulation::create(setup);
  MemoryArchive middle, end, resumed_end;
  for (int n = 0; n < 7; ++n) whole->step();
  whole->save(middle);
  resumed->load(middle);
  run(*whole, setup.schedule);
  run(*resumed, setup.schedule);
  whole->save(end);
  resumed->save(resumed_end);
  EXPECT_TRUE(end == resumed_end);
}

TEST_P(CoupledRestart, threads_do_not_matter) {
  const SimulationSetup setup = GetParam().setup();
  EXPECT_TRUE(final_state(setup, 1) == final_state(setup, 3));
}

/// PETSc is not made for several threads: runs beside each other must take turns.
TEST_P(CoupledRestart, runs_beside_each_other_do_not_meet) {
  const SimulationSetup setup = GetParam().setup();
  const MemoryArchive alone = final_state(setup, 1);
  std::array<std::optional<MemoryArchive>, 3> ends;
  std::vector<std::thread> threads;
  for (auto& end : ends) threads.emplace_back([&] { end = final_state(setup, 1); });
  for (std::thread& thread : threads) thread.join();
  for (const auto& end : ends) EXPECT_TRUE(end && *end == alone);
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const PathType path : {PathType::fused, PathType::split}) {
    for (const Case& c :
         {Case{2, 1, false}, Case{2, 2, false}, Case{3, 2, true}, Case{3, 2, false}}) {
      all.push_back(c);
      all.back().path = path;
    }
  }
  for (const Case& c : {Case{2, 2, false}, Case{3, 2, true}}) {
    all.push_back(c);
    all.back().path = PathType::split;
    all.back().locking = VolumetricLocking::fbar;
  }
  all.push_back({2, 2, true});
  all.back().kernel = KernelType::quadratic;
  return all;
}

INSTANTIATE_TEST_SUITE_P(all, CoupledRestart, ::testing::ValuesIn(cases()),
                         [](const auto& info) { return name_of(info.param); });

}  // namespace
}  // namespace scree::testing
