// SPDX-License-Identifier: Apache-2.0
//
// A laterally confined column settles under its own weight (case V13): fixed-corotated, 10 %
// strain, the nominal stress -rho g (H - X) and the displacement rho g/E (X^2/2 - H X) are exact.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "verification/reference/closed_forms.hpp"
#include "verification/support/scene.hpp"

namespace scree::testing {
namespace {

struct ColumnErrors {
  double stress;        ///< sum |sigma_p - sigma| V_p/(rho g H sum V_p)
  double displacement;  ///< of the topmost particles, relative to |u(H)|
};

ColumnErrors settle(KernelType kernel, int cells, int ppd) {
  const reference::SelfWeightColumn exact{10, 1000, 10, 1e6};
  const double dx = exact.height / cells, spacing = dx / ppd, T1 = exact.period();
  Method method;
  method.kernel = kernel;
  SimulationSetup setup = make_setup(2, method, dx, {2, cells + 2, 1});
  setup.faces[0] = {FaceType::symmetry, FaceType::symmetry};
  setup.faces[1][0] = FaceType::symmetry;
  setup.gravity = [T1](double t) {
    return std::array<double, 3>{0, -10 * std::min(t / (4 * T1), 1.0), 0};
  };
  setup.damping = DampingType::mass;
  setup.damping_value = 0.7 * 2 * (2 * std::numbers::pi / T1);  // of critical, lowest mode
  const auto points = lattice(Vector::Zero(), Vector(2 * dx, exact.height, 0), spacing, 2);
  add_jelly(setup, points, spacing, {1e6, 0.0, exact.density});
  setup.schedule = Schedule(10 * T1, 0, 0, 0);
  const Schedule schedule = setup.schedule;
  const auto simulation = Simulation::create(std::move(setup));
  run(*simulation, schedule);
  const HistoryRow row = simulation->history();
  EXPECT_LT(row.kinetic_energy, 1e-3 * row.elastic_energy) << "not at rest: no comparison";

  const auto snapshot = simulation->particles({"stress", "volume"});
  const State state = state_of(*simulation);
  const auto& stress = field(snapshot, "stress").values;
  const auto& volume = field(snapshot, "volume").values;
  ColumnErrors errors{0, 0};
  double total = 0;
  for (std::size_t p = 0; p < points.size(); ++p) {
    const double X = points[p][1];
    errors.stress += std::abs(stress[9 * p + 4] - exact.stress(X)) * volume[p];
    total += volume[p];
    if (X < exact.height - spacing) continue;
    const double off = state.x[p][1] - X - exact.displacement(X);
    errors.displacement =
        std::max(errors.displacement, std::abs(off / exact.displacement(exact.height)));
  }
  errors.stress /= exact.density * exact.gravity * exact.height * total;
  return errors;
}

// Values measured with an independent one-dimensional code, with a margin of 1.5.
TEST(SelfWeightColumn, compact_with_four_particles_a_direction) {
  const ColumnErrors e8 = settle(KernelType::compact, 8, 4);
  const ColumnErrors e16 = settle(KernelType::compact, 16, 4);
  const ColumnErrors e32 = settle(KernelType::compact, 32, 4);
  EXPECT_LT(e8.stress, 1.5 * 3.4e-3);
  EXPECT_LT(e16.stress, 1.5 * 2.4e-3);
  EXPECT_LT(e32.stress, 1.5 * 2.2e-3);
  EXPECT_LT(e8.displacement, 1.5 * 8.1e-4);
  EXPECT_LT(e16.displacement, 1.5 * 4e-4);
  EXPECT_LT(e32.displacement, 1.5 * 2.1e-4);
  EXPECT_GT(std::log2(e8.displacement / e32.displacement) / 2, 0.9);  // first order at the surface
}

TEST(SelfWeightColumn, compact_with_two_particles_a_direction) {
  EXPECT_LT(settle(KernelType::compact, 8, 2).stress, 1.5 * 1.5e-2);
  EXPECT_LT(settle(KernelType::compact, 16, 2).stress, 1.5 * 1.4e-2);
  EXPECT_LT(settle(KernelType::compact, 32, 2).stress, 1.5 * 1.1e-2);
}

TEST(SelfWeightColumn, quadratic) {
  EXPECT_LT(settle(KernelType::quadratic, 8, 2).stress, 1.5 * 8.8e-3);
  EXPECT_LT(settle(KernelType::quadratic, 16, 2).stress, 1.5 * 5.4e-3);
  EXPECT_LT(settle(KernelType::quadratic, 32, 2).stress, 1.5 * 4.5e-3);
  EXPECT_LT(settle(KernelType::quadratic, 8, 4).stress, 1.5 * 5.7e-3);
  EXPECT_LT(settle(KernelType::quadratic, 16, 4).stress, 1.5 * 2.9e-3);
  EXPECT_LT(settle(KernelType::quadratic, 32, 4).stress, 1.5 * 3.4e-3);
}

}  // namespace
}  // namespace scree::testing
