// SPDX-License-Identifier: Apache-2.0
// What `scree check` says about pore water.
#include "app/coupling_report.hpp"

#include <gtest/gtest.h>

#include "verification/unit/broken_deck.hpp"

namespace scree::testing_decks {
namespace {

std::vector<std::string> report_of(const std::string& keys) {
  Problems problems;
  const Deck deck = read_deck_text(R"(
[domain]
dimension = 2
lower = [0.0, 0.0]
upper = [0.1, 1.2]
cell_size = 0.05
[time]
end = 1.0
[coupling]
type = "biot"
[material.soil]
model = "fixed_corotated"
density = 2000
youngs_modulus = "10 MPa"
poissons_ratio = 0.0
porosity = 0.4
fluid_bulk_modulus = 1e300
)" + keys + R"(
[body.layer]
material = "soil"
shape = { type = "box", lower = [0.0, 0.0], upper = [0.1, 1.0] }
)",
                                   "deck.toml", {}, problems);
  EXPECT_EQ(problems.text(), "");
  return coupling_report(deck);
}

TEST(CouplingReport, PermeabilityConsolidationAndStep) {
  // k = 0.00981/(1000 x 9.81) = 1e-6, c_v = k E = 10 m^2/s, H^2/c_v = 0.1 s; the drained wave has
  // sqrt(E/rho) = 70.7 m/s, the step 0.4 x 0.05/70.7 s.
  const auto lines = report_of("hydraulic_conductivity = 0.00981");
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0],
            "layer: k 1e-06 m^2/(Pa s), c_v 10 m^2/s, consolidation time H^2/c_v 0.1 s (H 1 m), "
            "step at most 0.0002828 s (drained soil)");
}

TEST(CouplingReport, NoPermeability) {
  const auto lines = report_of("permeability = 0\nfluid_viscosity = 1e-3");
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0], "layer: k 0, undrained; step at most 0.0002828 s");
}

}  // namespace
}  // namespace scree::testing_decks
