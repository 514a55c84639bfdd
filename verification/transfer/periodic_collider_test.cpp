// SPDX-License-Identifier: Apache-2.0
//
// A collider at a periodic face is no other than one in the middle of the domain.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "verification/support/scene.hpp"

namespace scree::testing {
namespace {

constexpr double dx = 0.1;
constexpr int cells = 16, high = 4;

/// A ball that ploughs through a layer, along it and down, from `start` (cells). The layer fills
/// the periodic axes of the domain.
SimulationSetup ploughed(int dimension, const Method& method, double start) {
  SimulationSetup setup = make_setup(dimension, method, dx, {cells, high + 4, 4});
  for (const int axis : {0, 2}) setup.faces[axis] = {FaceType::periodic, FaceType::periodic};
  setup.faces[1][0] = FaceType::slip;
  ColliderSpec ball;
  ball.name = "ball";
  ball.shape.kind = ShapeKind::sphere;
  ball.shape.center = {start * dx, (high + 1) * dx, dimension == 3 ? 3.5 * dx : 0};
  ball.shape.radius = 1.5 * dx;
  for (Formula& component : ball.velocity) component.text = "0";
  ball.velocity[0].text = "4";
  ball.velocity[1].text = "-1";
  ball.contact = {ContactType::friction, 0.4};
  setup.colliders.push_back(ball);
  const Vector upper(cells * dx, high * dx, dimension == 3 ? 4 * dx : 0);
  add_jelly(setup, lattice(Vector::Zero(), upper, dx / 2, dimension), dx / 2, {});
  set_steps(setup, 120, 1e-3, true);  // 5 cells along, 1.2 down
  return setup;
}

std::vector<HistoryRow> rows_of(SimulationSetup setup) {
  const Schedule schedule = setup.schedule;
  const auto simulation = Simulation::create(std::move(setup));
  return run_with_history(*simulation, schedule);
}

/// Largest difference of force and torque on the ball over the largest of them.
double difference(int dimension, const Method& method) {
  const auto middle = rows_of(ploughed(dimension, method, 5));
  const auto beyond = rows_of(ploughed(dimension, method, 13));  // half the domain farther
  EXPECT_EQ(middle.size(), beyond.size());
  double largest = 0, scale = 0;
  for (std::size_t i = 0; i < std::min(middle.size(), beyond.size()); ++i) {
    const auto &a = middle[i].collider_force_torque.at(0),
               &b = beyond[i].collider_force_torque.at(0);
    for (std::size_t k = 0; k < a.size(); ++k) {
      largest = std::max(largest, std::abs(a[k] - b[k]));
      scale = std::max(scale, std::abs(a[k]));
    }
  }
  EXPECT_GT(scale, 0);
  return largest / scale;
}

// 1e-12: rounding of places in another part of the domain, after 120 steps (measured 4e-15).
TEST(PeriodicCollider, PassesTheFaceUnnoticed) {
  EXPECT_LT(difference(2, {}), 1e-12);
  EXPECT_LT(difference(2, {KernelType::quadratic, TransferType::flip}), 1e-12);
  EXPECT_LT(difference(3, {}), 1e-12);
}

}  // namespace
}  // namespace scree::testing
