// SPDX-License-Identifier: Apache-2.0
//
// The same run on the processor and on the emulated device.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "solver/device/toolkits.hpp"
#include "solver/simulation/simulation_on_device.hpp"
#include "verification/support/scene.hpp"

namespace scree::testing {

inline std::unique_ptr<Simulation> emulate(SimulationSetup setup) {
  return create_on_device(std::move(setup), emulated::make_toolkit());
}

inline void expect_near_row(const HistoryRow& a, const HistoryRow& b, double tolerance,
                            const HistoryRow& scale) {
  EXPECT_EQ(a.step, b.step);
  EXPECT_EQ(a.particle_count, b.particle_count);
  const double momentum = scale.mass * std::max(scale.max_speed, 1e-300);
  const double energy = scale.kinetic_energy + scale.elastic_energy;
  EXPECT_NEAR(a.time, b.time, tolerance * std::max(a.time, 1e-300));
  EXPECT_NEAR(a.mass, b.mass, 1e-12 * a.mass);  // a product and a sum of few terms
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(a.momentum[i], b.momentum[i], tolerance * momentum);
    EXPECT_NEAR(a.angular_momentum[i], b.angular_momentum[i], tolerance * momentum);  // arms < 1 m
    EXPECT_NEAR(a.center[i], b.center[i], tolerance);
  }
  EXPECT_NEAR(a.kinetic_energy, b.kinetic_energy, tolerance * energy);
  EXPECT_NEAR(a.elastic_energy, b.elastic_energy, tolerance * energy);
  EXPECT_NEAR(a.max_speed, b.max_speed, tolerance * scale.max_speed);
}

/// Largest reaction of a collider over some rows, per component 0 .. 5.
inline double largest_reaction(const std::vector<HistoryRow>& rows, std::size_t collider,
                               std::size_t component) {
  double most = 0;
  for (const HistoryRow& row : rows) {
    most = std::max(most, std::abs(row.collider_force_torque[collider][component]));
  }
  return most;
}

/// The sums of work; `scale` has the largest energies.
inline void expect_same_work(const HistoryRow& a, const HistoryRow& b, double tolerance,
                             const HistoryRow& scale) {
  const double energy = scale.kinetic_energy + scale.elastic_energy;
  ASSERT_EQ(a.collider_work.size(), b.collider_work.size());
  for (std::size_t c = 0; c < a.collider_work.size(); ++c) {
    const double most = std::max(energy, std::abs(a.collider_work[c]));
    EXPECT_NEAR(a.collider_work[c], b.collider_work[c], tolerance * most);
  }
  ASSERT_EQ(a.external_work.has_value(), b.external_work.has_value());
  if (!a.external_work) return;
  const double most = std::max(energy, std::abs(*a.external_work));
  EXPECT_NEAR(*a.external_work, *b.external_work, tolerance * most);
}

/// Positions, velocities and stresses of all particles; stresses to the largest or to that of the
/// motion, density x speed^2 (a body that only flies has rounding for a stress).
inline void expect_same_particles(const Simulation& a, const Simulation& b, double tolerance,
                                  double speed, double density) {
  const ParticleSnapshot one = a.particles({"velocity", "stress"});
  const ParticleSnapshot other = b.particles({"velocity", "stress"});
  ASSERT_EQ(one.id, other.id);
  const auto expect_same = [](const std::vector<double>& x, const std::vector<double>& y,
                              double most, const std::string& what) {
    ASSERT_EQ(x.size(), y.size()) << what;
    double farthest = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double apart = std::abs(x[i] - y[i]);
      farthest = apart <= farthest ? farthest : apart;  // NaN stays
    }
    EXPECT_LE(farthest, most) << what;
  };
  expect_same(one.position, other.position, tolerance, "position");
  expect_same(field(one, "velocity").values, field(other, "velocity").values, tolerance * speed,
              "velocity");
  const std::vector<double>& stress = field(one, "stress").values;
  double largest = density * speed * speed;
  for (const double s : stress) largest = std::max(largest, std::abs(s));
  expect_same(stress, field(other, "stress").values, tolerance * largest, "stress");
}

/// Runs both and compares every history row, reactions included, and the final particles.
/// tolerance: of the scene's speeds, energies and forces; lengths are about 1 m.
inline void expect_same_run(const SimulationSetup& setup, double tolerance) {
  const auto cpu = Simulation::create(setup);
  const auto device = emulate(setup);
  const auto rows = run_with_history(*cpu, setup.schedule);
  const auto other = run_with_history(*device, setup.schedule);
  ASSERT_EQ(rows.size(), other.size());
  HistoryRow scale = rows[0];
  for (const HistoryRow& row : rows) {
    scale.max_speed = std::max(scale.max_speed, row.max_speed);
    scale.kinetic_energy = std::max(scale.kinetic_energy, row.kinetic_energy);
    scale.elastic_energy = std::max(scale.elastic_energy, row.elastic_energy);
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    SCOPED_TRACE("row " + std::to_string(i));
    expect_near_row(rows[i], other[i], tolerance, scale);
    expect_same_work(rows[i], other[i], tolerance, scale);
    for (std::size_t c = 0; c < rows[i].collider_force_torque.size(); ++c) {
      double most = 0;
      for (std::size_t k = 0; k < 6; ++k) most = std::max(most, largest_reaction(rows, c, k));
      for (std::size_t k = 0; k < 6; ++k) {
        EXPECT_NEAR(rows[i].collider_force_torque[c][k], other[i].collider_force_torque[c][k],
                    tolerance * most);
      }
    }
    if (::testing::Test::HasFailure()) return;
  }
  EXPECT_EQ(cpu->step_count(), device->step_count());
  EXPECT_EQ(cpu->removed_count(), device->removed_count());
  EXPECT_EQ(cpu->block_count(), device->block_count());
  double density = 0;
  for (const BodySetup& body : setup.bodies) density = std::max(density, body.density);
  expect_same_particles(*cpu, *device, tolerance, scale.max_speed, density);
}

}  // namespace scree::testing
