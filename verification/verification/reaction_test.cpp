// SPDX-License-Identifier: Apache-2.0
//
// The force on a collider is what the material exerts, whatever damping there is. A column that has
// come to rest on a floor weighs m g; one that the floor carries along at constant velocity v
// against mass damping of rate c pulls it back by m c v besides, and local damping, which acts on
// unbalanced forces only, by nothing.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "verification/support/scene.hpp"

namespace scree::testing {
namespace {

constexpr double dx = 0.1, g = 9.81, speed = 0.5;  // m, m/s^2, m/s
constexpr int cells = 8;                           // high; half as wide

struct Damped {
  DampingType type;
  double value;
  ContactType contact;
  TransferType transfer = TransferType::mls;
};

double mass(const Jelly& jelly) { return jelly.density * cells * dx * cells / 2 * dx; }
double period(const Jelly& jelly) { return 4 * cells * dx / jelly.wave_speed(); }

/// Floor of the domain's lower two cells, the column upon it.
SimulationSetup column(const Damped& damped, const Jelly& jelly, double floor_speed) {
  Method method;
  method.transfer = damped.transfer;
  SimulationSetup setup = make_setup(2, method, dx, {cells / 2, cells + 4, 1});
  setup.faces[0] = {FaceType::periodic, FaceType::periodic};
  setup.gravity = [](double) { return std::array<double, 3>{0, -g, 0}; };
  setup.damping = damped.type;
  setup.damping_value = damped.value;
  ColliderSpec floor;
  floor.name = "floor";
  floor.shape.lower = {-100, -1, 0};
  floor.shape.upper = {100, 2 * dx, 0};
  floor.velocity[0].text = std::to_string(floor_speed);
  floor.velocity[1].text = "0";
  floor.contact = {damped.contact, 0.5};
  setup.colliders.push_back(floor);
  const auto points =
      lattice(Vector(0, 2 * dx, 0), Vector(cells / 2 * dx, (2 + cells) * dx, 0), dx / 4, 2);
  BodySetup& body = add_jelly(setup, points, dx / 4, jelly);
  set_velocity(body, Vector(floor_speed, 0, 0));
  const double end = 10 * period(jelly);
  setup.schedule = Schedule(end, end, 0, 0);
  return setup;
}

/// Force on the floor at the end [N/m].
std::array<double, 2> force_on_floor(const Damped& damped, const Jelly& jelly, double floor_speed) {
  SimulationSetup setup = column(damped, jelly, floor_speed);
  const Schedule schedule = setup.schedule;
  const auto simulation = Simulation::create(std::move(setup));
  const HistoryRow row = run_with_history(*simulation, schedule).back();
  const std::array<double, 6>& on_floor = row.collider_force_torque.at(0);
  return {on_floor[0], on_floor[1]};
}

// 1e-3: what ten periods leave of the oscillation.
TEST(Reaction, OfAColumnAtRestIsItsWeight) {
  const Jelly jelly{1e6, 0.3, 1000};
  const double critical = 4 * std::numbers::pi / period(jelly);
  for (const Damped& damped :
       {Damped{DampingType::local, 0.5, ContactType::sticky},
        Damped{DampingType::local, 0.5, ContactType::slip},
        Damped{DampingType::local, 0.5, ContactType::separate},
        Damped{DampingType::local, 0.8, ContactType::friction},
        Damped{DampingType::local, 0.5, ContactType::sticky, TransferType::flip},
        Damped{DampingType::local, 0.5, ContactType::friction, TransferType::apic},
        Damped{DampingType::mass, 0.5 * critical, ContactType::sticky}}) {
    const auto force = force_on_floor(damped, jelly, 0);
    EXPECT_NEAR(force[1] / (mass(jelly) * g), -1, 1e-3)
        << int(damped.contact) << " " << damped.value;
    EXPECT_NEAR(force[0] / (mass(jelly) * g), 0, 1e-3)
        << int(damped.contact) << " " << damped.value;
  }
}

// 1e-2: the particles cross cells, and the quadrature of the grid changes with their places. (With
// three a direction the local drag is 2 %: it brakes every change of force against the motion.)
TEST(Reaction, OfAColumnCarriedAlongHasTheDragOfMassDampingOnly) {
  const Jelly jelly{1e6, 0.3, 1000};
  const double rate = 2 * std::numbers::pi / period(jelly);  // half of critical
  const double weight = mass(jelly) * g, drag = mass(jelly) * rate * speed;
  const auto viscous = force_on_floor({DampingType::mass, rate, ContactType::sticky}, jelly, speed);
  EXPECT_NEAR(viscous[0] / drag, -1, 1e-2);
  EXPECT_NEAR(viscous[1] / weight, -1, 1e-2);
  const auto local = force_on_floor({DampingType::local, 0.5, ContactType::sticky}, jelly, speed);
  EXPECT_NEAR(local[0] / weight, 0, 1e-2);
  EXPECT_NEAR(local[1] / weight, -1, 1e-2);
}

}  // namespace
}  // namespace scree::testing
