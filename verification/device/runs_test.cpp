// SPDX-License-Identifier: Apache-2.0
//
// Whole short runs on the emulated device have the processor's history; faults, leavers, loads and
// restarts are the same.
#include <gtest/gtest.h>

#include "solver/base/error.hpp"
#include "solver/emulation/launch.hpp"
#include "solver/io/memory_archive.hpp"
#include "verification/device/pair_of_runs.hpp"
#include "verification/support/effort.hpp"

namespace scree::testing {
namespace {

constexpr double dx = 0.05;

// Two runs that differ by rounding drift apart: 1e-16 grows by less than a million over some
// hundred steps of these scenes.
constexpr double drift = 1e-9;

SimulationSetup sand_column() {
  SimulationSetup setup = make_setup(2, {}, dx, {24, 12, 1});
  setup.faces[0] = {FaceType::symmetry, FaceType::open};
  setup.faces[1] = {FaceType::friction, FaceType::open};
  setup.face_friction[1][0] = 0.5;
  setup.gravity = [](double) { return std::array<double, 3>{0, -9.81, 0}; };
  DruckerPrager::Input sand;
  sand.youngs_modulus = 1e6;
  sand.poissons_ratio = 0.25;
  sand.friction_angle = 0.6;
  add_sand(setup, lattice(Vector::Zero(), Vector(0.25, 0.4, 0), dx / 2, 2), dx / 2, sand, 1600);
  const double end = slow_build ? 0.02 : 0.15;
  setup.schedule = Schedule(end, end / 5, 0, 0);
  return setup;
}

SimulationSetup two_spheres(int dimension) {
  SimulationSetup setup = make_setup(dimension, {}, 0.1, {11, 9, 9});
  for (int b = 0; b < 2; ++b) {
    const Vector centre(0.35 + 0.4 * b, 0.45, dimension == 3 ? 0.45 : 0);
    const Vector half = Vector(0.2, 0.2, 0.2);
    const auto points = lattice(centre - half, centre + half, 0.05, dimension,
                                [&](const Vector& x) { return (x - centre).norm() < 0.19; });
    set_velocity(add_jelly(setup, points, 0.05, {1e5, 0.3, 1000}),
                 Vector(b == 0 ? 3 : -3, 0.2 * b, 0));
  }
  const double end = slow_build ? 0.005 : 0.03;
  setup.schedule = Schedule(end, end / 4, 0, 0);
  return setup;
}

TEST(DeviceRuns, sand_column) { expect_same_run(sand_column(), drift); }

TEST(DeviceRuns, two_spheres) {
  for (const int dimension : {2, 3}) {
    if (slow_build && dimension == 3) continue;
    expect_same_run(two_spheres(dimension), drift);
  }
}

TEST(DeviceRuns, colliders_at_rest_and_in_motion) {
  SimulationSetup setup = sand_column();
  ColliderSpec ramp;
  ramp.name = "ramp";
  ramp.shape.kind = ShapeKind::plane;
  ramp.shape.point = {0.3, 0, 0};
  ramp.shape.normal = {-1, 2, 0};
  ramp.contact = {ContactType::friction, 0.4};
  ColliderSpec pusher;
  pusher.name = "pusher";
  pusher.shape.kind = ShapeKind::sphere;
  pusher.shape.center = {0.1, 0.52, 0};
  pusher.shape.radius = 0.11;
  pusher.velocity[0].text = "0.2";
  pusher.velocity[1].text = "-1-10*t";
  pusher.contact = {ContactType::sticky, 0};
  setup.colliders = {ramp, pusher};
  expect_same_run(setup, drift);
}

TEST(DeviceRuns, particles_leave_through_open_faces) {
  SimulationSetup setup = two_spheres(2);
  for (BodySetup& body : setup.bodies) set_velocity(body, Vector(4, -2, 0));
  setup.schedule = Schedule(0.12, 0.02, 0, 0);
  const auto cpu = Simulation::create(setup);
  run(*cpu, setup.schedule);
  ASSERT_GT(cpu->removed_count(), 20);
  expect_same_run(setup, drift);
}

TEST(DeviceRuns, particles_cross_periodic_faces) {
  SimulationSetup setup = two_spheres(2);
  setup.faces[0] = {FaceType::periodic, FaceType::periodic};
  for (BodySetup& body : setup.bodies) set_velocity(body, Vector(5, 0.3, 0));
  setup.schedule = Schedule(0.1, 0.02, 0, 0);
  expect_same_run(setup, drift);
}

TEST(DeviceRuns, body_forces_and_tractions) {
  SimulationSetup setup = two_spheres(2);
  setup.body_force = [](const double* X, const double* x, double t) {
    return std::array<double, 3>{10 * (X[0] - 0.5), -5 * x[1], 100 * t};
  };
  TractionSetup load;
  load.spec.name = "press";
  load.spec.pressure.text = "100*t";
  for (std::int64_t p = 0; p < 4; ++p) {
    load.patch.particle.push_back(p);
    load.patch.area_vector.insert(load.patch.area_vector.end(), {0.05, 0, 0});
    load.patch.area.push_back(0.05);
  }
  setup.tractions.push_back(load);
  expect_same_run(setup, drift);
}

/// Presses on four particles of each of the bodies, and pulls at four of the first.
void add_loads(SimulationSetup& setup) {
  for (int k = 0; k < 3; ++k) {
    TractionSetup load;
    load.body = k % 2;
    load.spec.name = "load" + std::to_string(k);
    if (k < 2) load.spec.pressure.text = "2000*t*(1+x)";
    if (k == 2) {
      for (Formula& component : load.spec.value) component.text = "50*X-y";
    }
    for (std::int64_t p = 0; p < 4; ++p) {
      load.patch.particle.push_back(3 * p);
      load.patch.area_vector.insert(load.patch.area_vector.end(), {0.05, 0.01 * double(k), 0});
      load.patch.area.push_back(0.05);
    }
    setup.tractions.push_back(load);
  }
}

TEST(DeviceRuns, tractions) {
  for (const int dimension : {2, 3}) {
    if (slow_build && dimension == 3) continue;
    SimulationSetup setup = two_spheres(dimension);
    add_loads(setup);
    expect_same_run(setup, drift);
  }
}

/// Loaded particles are gone after some of these steps.
TEST(DeviceRuns, loaded_particles_leave) {
  SimulationSetup setup = two_spheres(2);
  setup.faces[0] = {FaceType::open, FaceType::open};
  for (BodySetup& body : setup.bodies) set_velocity(body, Vector(5, 0.3, 0));
  setup.schedule = Schedule(0.1, 0.02, 0, 0);
  add_loads(setup);
  expect_same_run(setup, drift);
}

/// A step brings the rows of loaded particles, 3 D + D^2 numbers each, and not all particles.
TEST(DeviceRuns, loads_copy_the_loaded_particles_alone) {
  constexpr int steps = 5;
  std::int64_t bytes[2];
  for (const bool loaded : {false, true}) {
    SimulationSetup setup = two_spheres(2);
    setup.path = PathType::split;
    set_steps(setup, steps, 1e-5);
    if (loaded) add_loads(setup);
    const auto simulation = emulate(setup);
    const std::int64_t before = emulation::downloaded();
    for (int i = 0; i < steps; ++i) simulation->step();
    bytes[loaded] = emulation::downloaded() - before;
  }
  constexpr std::int64_t particles = 8;  // four of each body
  EXPECT_EQ(bytes[1] - bytes[0], steps * particles * (3 * 2 + 4) * std::int64_t(sizeof(double)));
}

/// Saved and loaded, the emulated run goes on bit for bit: its sums have a fixed order.
void expect_bitwise_restart(const SimulationSetup& setup) {
  const auto whole = emulate(setup);
  MemoryArchive middle;
  bool saved = false;
  while (!setup.schedule.finished(whole->time())) {
    whole->step();
    if (!saved && setup.schedule.history_due(whole->time())) {
      whole->save(middle);
      saved = true;
    }
  }
  const auto rest = emulate(setup);
  rest->load(middle);
  run(*rest, setup.schedule);
  MemoryArchive a;
  MemoryArchive b;
  whole->save(a);
  rest->save(b);
  EXPECT_TRUE(a == b);
}

TEST(DeviceRuns, restart_is_bitwise) {
  SimulationSetup setup = two_spheres(2);
  setup.faces[1][0] = FaceType::slip;
  expect_bitwise_restart(setup);
  add_loads(setup);
  expect_bitwise_restart(setup);
}

MemoryArchive end_in_order(const SimulationSetup& setup, emulation::Order order) {
  emulation::set_order(order);
  const auto simulation = emulate(setup);
  run(*simulation, setup.schedule);
  emulation::set_order(emulation::Order::forward);
  MemoryArchive archive;
  simulation->save(archive);
  return archive;
}

/// Whatever the order of the threads is, and only where that was asked for.
TEST(DeviceRuns, deterministic_ones_have_the_same_bits) {
  for (const TransferType transfer : {TransferType::mls, TransferType::flip}) {
    SimulationSetup setup = two_spheres(2);
    setup.transfer = transfer;
    for (const bool deterministic : {true, false}) {
      setup.deterministic = deterministic;
      const MemoryArchive forward = end_in_order(setup, emulation::Order::forward);
      EXPECT_EQ(forward == end_in_order(setup, emulation::Order::backward), deterministic);
    }
  }
}

TEST(DeviceRuns, deterministic_ones_are_those_of_the_processor) {
  SimulationSetup column = sand_column();
  column.deterministic = true;
  expect_same_run(column, drift);
  SimulationSetup spheres = two_spheres(2);
  spheres.deterministic = true;
  spheres.damping = DampingType::local;
  spheres.damping_value = 0.1;
  expect_same_run(spheres, drift);
}

/// Momenta that fixed point cannot hold end in a fault, not in wrong numbers.
TEST(DeviceRuns, momenta_beyond_fixed_point_are_a_fault) {
  SimulationSetup setup = two_spheres(2);
  setup.deterministic = true;
  setup.step = 1e-4;
  set_velocity(setup.bodies[0], Vector(1e4 * 0.1 / 1e-4, 0, 0));
  std::string sentence;
  try {
    emulate(setup)->step();
  } catch (const RunFault& fault) {
    sentence = fault.what();
  }
  EXPECT_NE(sentence.find("finite"), std::string::npos) << sentence;  // not "moved too far"
}

/// Both say the same sentence. One particle, so that which of several is named is no question.
TEST(DeviceRuns, faults_are_reported_with_particle_and_place) {
  SimulationSetup setup = make_setup(2, {}, 0.1, {8, 8, 1});
  set_velocity(add_jelly(setup, {Vector(0.33, 0.41, 0)}, 0.05, {}), Vector(3, 1, 0));
  set_steps(setup, 3, 0.05);
  const auto message = [](Simulation& simulation) {
    try {
      for (int i = 0; i < 3; ++i) simulation.step();
    } catch (const RunFault& fault) {
      return std::string(fault.what());
    }
    return std::string("none");
  };
  const std::string sentence = message(*Simulation::create(setup));
  EXPECT_NE(sentence.find("particle 0 (jelly) at "), std::string::npos) << sentence;
  EXPECT_EQ(message(*emulate(setup)), sentence);
}

/// The need is told before anything is allocated, and is what the start then takes: never more, and
/// not much less (arrays that grow take an eighth more than asked for).
TEST(DeviceRuns, memory_is_told_before_it_is_taken) {
  for (const PathType path : {PathType::fused, PathType::split}) {
    SimulationSetup setup = two_spheres(2);
    setup.path = path;
    setup.schedule = Schedule(0.03, 0.03, 0, 0);  // long enough for a first sorting of particles
    MemoryNeed told;
    const auto simulation = create_on_device(
        setup, emulated::make_toolkit([&](const MemoryNeed& need) { told = need; }));
    run(*simulation, setup.schedule);
    EXPECT_EQ(told.particles, simulation->particle_count());
    EXPECT_EQ(told.free, std::int64_t(1) << 34);
    const MemoryReport taken = simulation->memory();
    EXPECT_LE(told.bytes, taken.grid + taken.other);
    EXPECT_GE(told.bytes, (taken.grid + taken.other) / 2);
  }
}

TEST(DeviceRuns, a_device_that_is_too_small_is_refused) {
  emulation::set_free_memory(100'000);
  std::string sentence;
  try {
    emulate(two_spheres(2));
  } catch (const UserError& error) {
    sentence = error.what();
  }
  emulation::set_free_memory(std::size_t(1) << 34);
  EXPECT_NE(sentence.find("GB of the device's memory"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("emulated has 0.00 GB free"), std::string::npos) << sentence;
}

/// Or all these comparisons would be of the processor with itself.
TEST(DeviceRuns, go_through_kernels) {
  SimulationSetup setup = two_spheres(2);
  set_steps(setup, 2, 1e-4);
  const std::int64_t before = emulation::launches();
  run(*emulate(setup), setup.schedule);
  // Of each step at least: forces, their sum, division, a fused pass a body, a summary a body.
  EXPECT_GE(emulation::launches() - before, 2 * 7);
}

TEST(DeviceRuns, laws_that_were_not_compiled_are_refused) {
  const auto toolkit = emulated::make_toolkit();
  const auto& parts = toolkit->parts<2, double>();
  EXPECT_THROW(parts.law("no_such_law", 0, 1), UserError);
}

TEST(DeviceRuns, grids_for_output_are_the_same) {
  const SimulationSetup setup = two_spheres(2);
  const auto cpu = Simulation::create(setup);
  const auto device = emulate(setup);
  run(*cpu, setup.schedule);
  run(*device, setup.schedule);
  const auto a = cpu->grid();
  const auto b = device->grid();
  ASSERT_EQ(a.size(), 2u);
  ASSERT_EQ(b.size(), 2u);
  for (std::size_t l = 0; l < 2; ++l) {
    for (std::size_t f = 0; f < 2; ++f) {
      double largest = 0;
      for (const double x : a[l].fields[f].values) largest = std::max(largest, std::abs(x));
      ASSERT_GT(largest, 0);
      for (std::size_t i = 0; i < a[l].fields[f].values.size(); ++i) {
        // A node with next to no mass has a velocity of next to no digits: 1e-6.
        ASSERT_NEAR(a[l].fields[f].values[i], b[l].fields[f].values[i], 1e-6 * largest);
      }
    }
  }
}

}  // namespace
}  // namespace scree::testing
